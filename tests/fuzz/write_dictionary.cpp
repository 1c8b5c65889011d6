// Prints the keys of scene files, and the words that they allow, as a dictionary for libFuzzer.
#include <cctype>
#include <cstdio>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include "swell.h"

namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Those of letters, digits and dots; of "wind.speed_mps" the parts too.
void add_words(std::string_view text, std::set<std::string>& words) {
  std::string word;
  for (const char c : std::string(text) + " ") {
    if (is_letter(c)) {
      word += c;
    } else {
      if (word.size() > 2) words.insert(word);
      word.clear();
    }
  }
}

}  // namespace

int main() {
  std::set<std::string> words = {"[[form]]", "[[range]]", "[choice]", "\\x0a--set\\x0a",
                                 "= \\\"",   "1e308",     "5e-324",   "-0.0",
                                 "inf",      "nan"};
  for (std::size_t i = 0; i < swell_key_count(); ++i) {
    swell_key key{};
    key.size = sizeof key;
    if (swell_key_info(i, &key)) return 1;
    words.insert(std::string(key.name) + " = ");
    if (*key.table) words.insert("[[" + std::string(key.table) + "]]");
    add_words(key.name, words);
    add_words(key.allowed, words);
  }
  for (const std::string& word : words) std::printf("\"%s\"\n", word.c_str());
}
