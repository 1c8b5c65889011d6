// Which trees of a piece of the forest a view draws.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "render/world/forest.h"

namespace swell::render {

// Trees of less height in the picture are not drawn [px].
inline constexpr float kLastTree_px = 2.0f;

// From where trees are seen.
struct TreeSight {
  std::array<glm::vec4, 5> planes;  // of the frustum, relative to the eye
  glm::vec3 origin_rel{0.0f};       // Trees::origin from the eye
  float px = 1.0f;                  // size of 1 m at a distance of 1 m
  float drop_per_m2 = 0.0f;         // how far a round earth sinks
  float mirror_rel_m = 0.0f;        // of a mirror image: its level over the eye
  bool is_mirrored = false;
  bool shows_all = false;  // also what lies outside the planes
};

// The part of trees that are drawn where they are so high; thinned_px: TreeColumns.
inline float part_of_trees(float height_px, float thinned_px) {
  const float t = height_px < thinned_px ? height_px / thinned_px : 1.0f;
  return t * t;
}

// Writes the numbers of those of trees [first, first + count) that are drawn to `chosen`, in
// order, and returns how many there are. `chosen` has room for count; what follows the last is not
// written, since others may write there. The same on every SIMD target.
std::uint32_t choose_trees(const TreeColumns& trees, std::uint32_t first, std::uint32_t count,
                           const TreeSight& sight, std::uint32_t* chosen);

}  // namespace swell::render
