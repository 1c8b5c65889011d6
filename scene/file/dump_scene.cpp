#include <fmt/core.h>

#include <algorithm>

#include "math/parallel.h"
#include "scene/file/parameters.h"
#include "scene/scene.h"

namespace swell::scene {
namespace {

template <class Object>
std::string line_of(const Parameter<Object>& parameter, const Object& object) {
  const std::size_t dot = parameter.key.rfind('.');
  const std::string_view key =
      dot == std::string_view::npos ? parameter.key : parameter.key.substr(dot + 1);
  const std::string value = toml_text(parameter, object);
  return value.empty() ? "" : fmt::format("{} = {}\n", key, value);
}

std::string_view section_of(std::string_view key) {
  const std::size_t dot = key.find('.');
  return dot == std::string_view::npos ? std::string_view() : key.substr(0, dot);
}

template <class Object>
std::string tables_text(std::string_view key, const std::vector<Parameter<Object>>& parameters,
                        const std::vector<Object>& objects) {
  std::string text;
  for (const Object& object : objects) {
    text += fmt::format("\n[[{}]]\n", key);
    for (const auto& parameter : parameters) text += line_of(parameter, object);
  }
  return text;
}

// Whether a file may not have the key, because another one of the scene's takes its place.
bool is_replaced(std::string_view key, const Scene& scene,
                 const std::vector<Parameter<Scene>>& parameters) {
  if (key == "wind.speed_mps") return scene.douglas || scene.beaufort;
  return std::ranges::any_of(kReplacements, [&](const Replacement& r) {
    return r.replaced == key &&
           std::ranges::find(parameters, r.key, &Parameter<Scene>::key)->is_set(scene);
  });
}

}  // namespace

std::string dump_scene(const Scene& scene) {
  const ScopedFloatEnvironment ieee;
  std::string text;
  std::string_view section;
  const std::vector<Parameter<Scene>> parameters = scene_parameters();
  for (const auto& parameter : parameters) {
    const std::string_view its_section = section_of(parameter.key);
    if (its_section == "terrain" && !scene.terrain) continue;
    if (its_section != section) {
      section = its_section;
      text += fmt::format("\n[{}]\n", section);
    }
    const std::string line = line_of(parameter, scene);
    if (!line.empty() && is_replaced(parameter.key, scene, parameters)) text += "# ";
    text += line;
    if (parameter.key == "water.type" && scene.water.type != WaterType::kNone)
      text += fmt::format("# A white disc is lost to sight at {:.3g} m (Secchi depth).\n",
                          secchi_depth_m(optics_of(scene.water.type)));
  }
  return text + tables_text(kSwellKey, swell_parameters(), scene.sea.swells) +
         tables_text(kSinesKey, sine_parameters(), scene.sea.sines) +
         tables_text(kMapsKey, map_parameters(), scene.sea.maps) +
         tables_text(kCumulusKey, cumulus_parameters(), scene.clouds.cumulus) +
         tables_text(kPathKey, waypoint_parameters(), scene.camera.path) +
         tables_text(kObjectsKey, object_parameters(), scene.objects) +
         tables_text(kDisturbancesKey, disturbance_parameters(), scene.disturbances) +
         tables_text(kRiversKey, river_parameters(), scene.rivers) +
         tables_text(kLakesKey, lake_parameters(), scene.lakes) +
         tables_text(kTreesKey, tree_parameters(), scene.trees);
}

}  // namespace swell::scene
