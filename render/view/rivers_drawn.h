// The rivers and lakes of a frame, and the images that their water looks into.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace swell::render {

// The images that water may look into.
enum LooksInto : std::uint8_t { kSeaFloor = 1, kSeaMirror = 2, kRiverMirror = 4 };

// The rivers and lakes that a window may show.
struct RiverMesh {
  std::vector<std::uint32_t> indices;    // 3 per triangle
  std::vector<glm::vec3> p_rel;          // per vertex, relative to the eye
  std::vector<float> sea_share;          // per vertex: of the sea's waves, which displace() adds
  std::vector<std::uint8_t> looks_into;  // per triangle: bits of LooksInto
  // The level of what lies nearest to the eye but for water that the sea's mirror serves; an image
  // mirrored in it is drawn. None: too little of it is in view.
  std::optional<float> mirror_level_m;
  float mirror_share = 0.0f;  // how much of that image shows: less where little is in view
};

// Water of rivers and lakes shows an image that is mirrored in another level all the same: all of
// it up to half a metre off, nothing from two metres on.
inline constexpr float kMirrorFull_m = 0.5f, kMirrorGone_m = 2.0f;

// How fast water loses the image of another level, and how much is left of one so far off.
inline constexpr float kMirrorFall_per_m = 1.0f / (kMirrorGone_m - kMirrorFull_m);
inline float mirror_share(float off_m) {
  return std::clamp((kMirrorGone_m - std::abs(off_m)) * kMirrorFall_per_m, 0.0f, 1.0f);
}

}  // namespace swell::render
