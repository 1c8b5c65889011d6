// The rivers and lakes of a frame, and the images that their water looks into.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::render {

// Levels of rivers and lakes that have a mirror at a time, besides the sea's.
inline constexpr std::size_t kMostRiverMirrors = 3;

// The images that water may look into; kRiverMirror << k is that of RiverMesh::mirrors()[k].
enum LooksInto : std::uint8_t { kSeaFloor = 1, kSeaMirror = 2, kRiverMirror = 4 };
inline constexpr std::uint8_t kRiverMirrors = kRiverMirror * ((1u << kMostRiverMirrors) - 1u);

// An image is mirrored in this level.
struct RiverMirror {
  float level_m = 0.0f;
  float share = 0.0f;  // how much of the image shows: less where little of its water is in view
};

// The rivers and lakes that a window may show.
struct RiverMesh {
  std::vector<std::uint32_t> indices;    // 3 per triangle
  std::vector<glm::vec3> p_rel;          // per vertex, relative to the eye
  std::vector<float> sea_share;          // per vertex: of the sea's waves, which displace() adds
  std::vector<std::uint8_t> looks_into;  // per triangle: bits of LooksInto
  // But for water that the sea's mirror serves: the level of what lies nearest to the eye, then
  // those of lakes that it does not serve, the one that fills most of the picture first. None: too
  // little is in view.
  std::array<RiverMirror, kMostRiverMirrors> mirror{};
  std::size_t mirror_count = 0;
  std::span<const RiverMirror> mirrors() const { return std::span(mirror).first(mirror_count); }
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
