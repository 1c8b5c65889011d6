// The numbers of classes in labelled pictures, and their names: for code, files and documents.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace swell::render {

inline constexpr std::string_view kTreeClassName = "tree";

// The name of every class of the scene, in the order of their numbers: those that each scene has
// (sky, water, terrain, object, foam), then those that its objects name, as they first come, then
// that of trees if it has some.
std::vector<std::string> class_names(const scene::Scene& scene);

// The number of a class among such names; nothing for a name that is none.
std::optional<std::uint32_t> class_of(std::span<const std::string> names, std::string_view name);

// The class of each object of the scene.
std::vector<std::uint32_t> object_classes(const scene::Scene& scene);

}  // namespace swell::render
