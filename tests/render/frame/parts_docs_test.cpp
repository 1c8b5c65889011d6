// docs/understand/optics.md has a row for every part that can be left out, with a test that there
// is.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "render/frame/parts.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

const std::string& all_tests() {
  static const std::string text = [] {
    std::string all;
    for (const auto& file : fs::recursive_directory_iterator(SWELL_SOURCE_DIR "/tests/render"))
      if (file.path().extension() == ".cpp") all += read(file.path());
    return all;
  }();
  return text;
}

// "| `name` | ... | `Suite.Name` |" -> "Suite.Name"; empty without such a row.
std::string test_of_part(const std::string& docs, std::string_view name) {
  std::ostringstream begin_of_row;
  begin_of_row << "\n| `" << name << "` |";
  const std::size_t row = docs.find(begin_of_row.str());
  if (row == std::string::npos) return {};
  const std::string line = docs.substr(row + 1, docs.find('\n', row + 1) - row - 1);
  const std::size_t end = line.rfind('`'), begin = line.rfind('`', end - 1) + 1;
  return line.substr(begin, end - begin);
}

TEST(PartsInDocs, EachHasARowWithItsTest) {
  const std::string docs = read(SWELL_SOURCE_DIR "/docs/understand/optics.md");
  for (const std::string_view name : kPartNames) {
    const std::string test = test_of_part(docs, name);
    const std::size_t dot = test.find('.');
    ASSERT_NE(dot, std::string::npos) << name << ": " << test;
    std::ostringstream written;
    written << '(' << test.substr(0, dot) << ", " << test.substr(dot + 1) << ')';
    EXPECT_NE(all_tests().find(written.str()), std::string::npos) << name << ": " << test;
  }
}

}  // namespace
}  // namespace swell::render
