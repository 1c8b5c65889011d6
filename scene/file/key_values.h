// What a scene says under some of its keys, for things that are kept by what they are made of.
#pragma once

#include <span>
#include <string_view>

#include "math/value_hash.h"
#include "scene/scene.h"

namespace swell::scene {

// Adds the values of these keys as the scene holds them: "sky" is all of [sky], "river" all
// [[river]], "detail.terrain_method" itself; "-sea.earth" leaves it out of "sea". Files go by their
// paths. Aborts where no key is meant.
void add_key_values(const Scene& scene, std::span<const std::string_view> keys, ValueBytes& to);

}  // namespace swell::scene
