// docs/labels.md has the table of labels as the code has it. To write the table anew, run this
// program with SWELL_UPDATE_DOCS=1 in the environment.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "render/labels/label_channels.h"

namespace swell::render {
namespace {

constexpr const char* kPath = SWELL_SOURCE_DIR "/docs/labels.md";
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

}  // namespace
}  // namespace swell::render
