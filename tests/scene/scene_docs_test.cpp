// docs/look_up/scene.md has the table of parameters as the code has it. To write the tables anew,
// run this program with SWELL_UPDATE_DOCS=1 in the environment.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

constexpr const char* kPath = SWELL_SOURCE_DIR "/docs/look_up/scene.md";
constexpr std::string_view kBegin = "<!-- keys: begin -->\n", kEnd = "<!-- keys: end -->\n";

template <class Object>
std::string row(const Parameter<Object>& parameter, std::string_view key, const Object& defaults) {
  const std::string value = toml_text(parameter, defaults);
  return fmt::format("`{}` | {} | {} | {}\n", key, value.empty() ? "none" : "`" + value + "`",
                     allowed_text(parameter), parameter.meaning);
}

std::string head(std::string_view title) {
  return fmt::format("\n### {}\n\nkey | default | allowed | meaning\n---|---|---|---\n", title);
}

std::string tables() {
  Scene defaults;
  defaults.name = "";
  defaults.terrain.emplace();
  std::string text, section = "none";
  for (const auto& parameter : scene_parameters()) {
    const std::size_t dot = parameter.key.find('.');
    const bool top = dot == std::string_view::npos;
    const std::string its_section(top ? "" : parameter.key.substr(0, dot));
    if (its_section != section) {
      section = its_section;
      text += head(top ? "Before the first table" : "[" + section + "]");
    }
    text += row(parameter, top ? parameter.key : parameter.key.substr(dot + 1), defaults);
  }
  text += head(fmt::format("[[{}]]", kSwellKey));
  for (const auto& parameter : swell_parameters())
    text += row(parameter, parameter.key, ocean::Swell{});
  text += head(fmt::format("[[{}]]", kSinesKey));
  for (const auto& parameter : sine_parameters())
    text += row(parameter, parameter.key, ocean::SineWave{});
  text += head(fmt::format("[[{}]]", kMapsKey));
  for (const auto& parameter : map_parameters())
    text += row(parameter, parameter.key, ocean::MapLayer{});
  text += head(fmt::format("[[{}]]", kCumulusKey));
  for (const auto& parameter : cumulus_parameters())
    text += row(parameter, parameter.key, Cumulus{});
  text += head(fmt::format("[[{}]]", kObjectsKey));
  for (const auto& parameter : object_parameters())
    text += row(parameter, parameter.key, FloatingObject{});
  text += head(fmt::format("[[{}]]", kDisturbancesKey));
  for (const auto& parameter : disturbance_parameters())
    text += row(parameter, parameter.key, ocean::Disturbance{});
  text += head(fmt::format("[[{}]]", kRiversKey));
  for (const auto& parameter : river_parameters())
    text += row(parameter, parameter.key, ocean::River{});
  text += head(fmt::format("[[{}]]", kLakesKey));
  for (const auto& parameter : lake_parameters())
    text += row(parameter, parameter.key, ocean::Lake{});
  text += head(fmt::format("[[{}]]", kTreesKey));
  for (const auto& parameter : tree_parameters())
    text += row(parameter, parameter.key, terrain::TreeStand{});
  text += head(fmt::format("[[{}]]", kPathKey));
  for (const auto& parameter : waypoint_parameters())
    text += row(parameter, parameter.key, Waypoint{});
  return text + "\n";
}

std::string read_docs() {
  std::ostringstream text;
  text << std::ifstream(kPath).rdbuf();
  return text.str();
}

TEST(SceneDocs, ListEveryKeyWithUnitDefaultRangeAndMeaning) {
  const std::string docs = read_docs();
  const std::size_t begin = docs.find(kBegin), end = docs.find(kEnd);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << kPath;
  const std::size_t first = begin + kBegin.size();
  if (std::getenv("SWELL_UPDATE_DOCS"))
    std::ofstream(kPath) << docs.substr(0, first) + tables() + docs.substr(end);
  else
    EXPECT_EQ(docs.substr(first, end - first), tables());
}

}  // namespace
}  // namespace swell::scene
