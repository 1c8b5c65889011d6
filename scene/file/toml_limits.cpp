#include "scene/file/toml_limits.h"

namespace swell::scene {
namespace {

// The position after the string that starts at `begin`, or the end. An unclosed one-line string
// ends with its line.
std::size_t string_end(std::string_view toml, std::size_t begin) {
  const char quote = toml[begin];
  const std::string_view rest = toml.substr(begin);
  const bool triple = rest.size() >= 3 && rest[1] == quote && rest[2] == quote;
  for (std::size_t i = begin + (triple ? 3 : 1); i < toml.size(); ++i) {
    if (toml[i] == '\\' && quote == '"')
      ++i;
    else if (!triple && (toml[i] == quote || toml[i] == '\n'))
      return toml[i] == quote ? i + 1 : i;
    else if (triple && toml.substr(i, 3) == rest.substr(0, 3))
      return i + 3;
  }
  return toml.size();
}

}  // namespace

std::uint32_t find_deep_nesting(std::string_view toml) {
  std::uint32_t line = 1;
  int dots = 0, brackets = 0;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    switch (toml[i]) {
      case '#':
        while (i + 1 < toml.size() && toml[i + 1] != '\n') ++i;
        break;
      case '"':
      case '\'': {
        const std::size_t end = string_end(toml, i);
        for (; i + 1 < end; ++i) line += toml[i] == '\n';
        break;
      }
      case '\n':
        ++line;
        dots = 0;
        break;
      case '=':
      case ',':
        dots = 0;
        break;
      case '[':
      case '{':
        dots = 0;
        if (++brackets > kMaxNesting) return line;
        break;
      case ']':
      case '}':
        dots = 0;
        if (brackets > 0) --brackets;
        break;
      case '.':
        if (++dots > kMaxNesting) return line;
        break;
    }
  }
  return 0;
}

}  // namespace swell::scene
