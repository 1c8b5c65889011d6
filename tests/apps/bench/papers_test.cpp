// swell-bench papers: every figure and table has a row that is not empty, and every number of the
// papers' stands beside ours and agrees with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

const std::string kScenes = SWELL_SOURCE_DIR "/scenes";

TEST(Papers, ShowEveryFigureAndTableAndAgreeWithTheirNumbers) {
  const ScratchFolder folder;
  const std::string out = folder.file("page");
  std::filesystem::create_directory(out);
  const Outcome outcome =
      run_bench({"papers", "--out", out, "--scenes", kScenes, "--size", "160x90"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("DIFFERS"), std::string::npos) << outcome.out;

  // By paper: the sea's 13 figures, the optics' 10 and 2 tables, the maps' 7, the functions' 4.
  std::size_t papers = 0, rows = 0, numbers = 0, empty = 0;
  bool has_none = false;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const bool is_number = line.starts_with("    ");
    if (!is_number) empty += has_none;
    has_none = !is_number && line.find(": 0 pictures") != std::string::npos;
    papers += !line.starts_with(" ");
    rows += line.starts_with("  ") && !is_number;
    numbers += is_number;
  }
  EXPECT_EQ(papers, 4u);
  EXPECT_EQ(rows, 11u + 12u + 7u + 4u);  // figures 4 and 5, and 8 and 10, of the sea are one each
  EXPECT_EQ(empty + has_none, 0u);
  EXPECT_GT(numbers, 40u);

  const std::string page = read_text((std::filesystem::path(out) / "papers.html").string());
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<img src=\""); at != std::string::npos;
       at = page.find("<img src=\"", at + 1)) {
    const std::size_t from = at + 10, to = page.find('"', from);
    const auto file = std::filesystem::path(out) / page.substr(from, to - from);
    EXPECT_TRUE(std::filesystem::exists(file) && std::filesystem::file_size(file) > 500) << file;
    ++pictures;
  }
  EXPECT_GE(pictures, 40u);
}

TEST(Papers, RefuseBadArguments) {
  for (const Arguments& bad : {Arguments{"papers"}, Arguments{"papers", "--out", "nowhere/at/all"},
                               Arguments{"papers", "--out", ".", "--size", "0x1"},
                               Arguments{"papers", "--out", ".", "--scenes", "nowhere"}}) {
    const Outcome outcome = run_bench(bad);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_TRUE(is_one_error_line(outcome.err)) << outcome.err;
  }
}

}  // namespace
}  // namespace swell::apps
