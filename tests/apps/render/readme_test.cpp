// What the README says that a command prints, it prints; functions that documents name are there.
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

TEST(Documents, FunctionsThatTheFramesPageNamesAreThere) {
  const std::filesystem::path root(SWELL_SOURCE_DIR);
  std::string sources;
  for (const char* folder : {"lod", "ocean", "raster", "render", "scene", "shapes", "sky"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        sources += read_text(entry.path());
  const std::string page = read_text(root / "docs/understand/frame.md");
  const std::regex call("`(?:\\w+::)*(\\w+)\\([^`]*\\)`");
  int calls = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), call), end; i != end; ++i, ++calls)
    EXPECT_NE(sources.find((*i)[1].str() + "("), std::string::npos) << (*i)[0];
  EXPECT_GT(calls, 20);
}

}  // namespace
}  // namespace swell::apps
