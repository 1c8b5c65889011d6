// docs/look_up/labels.md has the table of labels as the code has it, and maps to known numbers
// alone. To write the table anew, run this program with SWELL_UPDATE_DOCS=1 in the environment.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "render/labels/classes.h"
#include "render/labels/label_channels.h"

namespace swell::render {
namespace {

constexpr const char* kPath = SWELL_SOURCE_DIR "/docs/look_up/labels.md";
constexpr std::string_view kBegin = "<!-- labels: begin -->\n", kEnd = "<!-- labels: end -->\n";

std::string table() {
  std::string text =
      "\n| label | planes | type | unit | meaning | of the sky | where it does not apply |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const LabelInfo& info : label_table()) {
    std::string planes;
    for (std::size_t c = 0; c < info.plane_count(); ++c)
      planes += fmt::format("{}`{}`", c > 0 ? " " : "", info.planes[c]);
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", info.name, planes,
                        info.is_integer ? "uint32" : "float32", info.unit, info.meaning,
                        info.of_sky, info.elsewhere);
  }
  return text + "\n";
}

std::string read_docs() {
  std::ostringstream text;
  text << std::ifstream(kPath).rdbuf();
  return text.str();
}

TEST(LabelDocs, ListEveryLabelWithPlanesTypeUnitAndMeaning) {
  const std::string docs = read_docs();
  const std::size_t begin = docs.find(kBegin), end = docs.find(kEnd);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << kPath;
  const std::size_t first = begin + kBegin.size();
  if (std::getenv("SWELL_UPDATE_DOCS"))
    std::ofstream(kPath) << docs.substr(0, first) + table() + docs.substr(end);
  else
    EXPECT_EQ(docs.substr(first, end - first), table());
}

// Cells of a row of a table, without the spaces around them.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream stream(row.substr(2));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const std::size_t last = cell.find_last_not_of(' '), first = cell.find_first_not_of(' ');
    if (last != std::string::npos) cells.push_back(cell.substr(first, last + 1 - first));
  }
  return cells;
}

// Source: MaSTr1325 and LaRS, the numbers that their labels use.
TEST(LabelDocs, MapsToOtherDataSetsHoldOnlyTheirNumbers) {
  const std::set<std::string> mastr = {"0", "1", "2", "4"}, lars = {"0", "1", "2", "255"};
  const std::set<std::string> panoptic = {"1",  "3",  "5",  "11", "12", "13",
                                          "14", "15", "16", "17", "19", "none"};
  std::istringstream docs(read_docs());
  std::string line;
  while (std::getline(docs, line) && !line.starts_with("| class | MaSTr1325")) continue;
  std::getline(docs, line);  // |---|
  std::vector<std::string> names;
  while (std::getline(docs, line) && line.starts_with("| ")) {
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_EQ(cells.size(), 4u) << line;
    names.push_back(cells[0]);
    EXPECT_TRUE(mastr.contains(cells[1])) << line;
    EXPECT_TRUE(lars.contains(cells[2])) << line;
    EXPECT_TRUE(panoptic.contains(cells[3])) << line;
  }
  for (const std::string& name : class_names({}))
    EXPECT_EQ(std::ranges::count(names, name), 1) << "of each class that every scene has";
}

}  // namespace
}  // namespace swell::render
