// What the README says that a command prints, it prints.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

TEST(Readme, CommandsPrintTheHashesThatStandBesideThem) {
  const std::filesystem::path root(SWELL_SOURCE_DIR);
  std::string text = read_text(root / "README.md");
  text = std::regex_replace(text, std::regex("\\s+"), " ");
  const std::regex claim("`swell-render ([^`]*--hash[^`]*)` prints `(frame [^`]*)`");
  int claims = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), claim), end; i != end; ++i, ++claims) {
    Arguments arguments;
    std::istringstream words((*i)[1].str());
    for (std::string word; words >> word;)
      arguments.push_back(word.starts_with("scenes/") ? (root / word).string() : word);
    const Outcome outcome = run_render(arguments);
    EXPECT_EQ(outcome.out, (*i)[2].str() + "\n") << (*i)[0];
  }
  EXPECT_GE(claims, 1);
}

}  // namespace
}  // namespace swell::apps
