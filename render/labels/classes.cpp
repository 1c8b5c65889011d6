#include "render/labels/classes.h"

#include <algorithm>

#include "render/labels/label_channels.h"

namespace swell::render {

std::vector<std::string> class_names(const scene::Scene& scene) {
  std::vector<std::string> names(kFirstOwnClass);
  names[kSkyClass] = "sky";
  names[kWaterClass] = "water";
  names[kTerrainClass] = "terrain";
  names[kObjectClass] = "object";
  names[kFoamClass] = "foam";
  for (const scene::FloatingObject& object : scene.objects) {
    const std::string_view name = scene::object_class(object);
    if (!class_of(names, name)) names.emplace_back(name);
  }
  if (!scene.trees.empty() && !class_of(names, kTreeClassName)) names.emplace_back(kTreeClassName);
  return names;
}

std::optional<std::uint32_t> class_of(std::span<const std::string> names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - names.begin());
}

std::vector<std::uint32_t> object_classes(const scene::Scene& scene) {
  const std::vector<std::string> names = class_names(scene);
  std::vector<std::uint32_t> classes;
  for (const scene::FloatingObject& object : scene.objects)
    classes.push_back(*class_of(names, scene::object_class(object)));
  return classes;
}

}  // namespace swell::render
