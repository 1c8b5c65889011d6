// The surfaces that a frame draws, and which primitive numbers are whose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "math/enum_table.h"

namespace swell::render {

// In the order of their primitive numbers.
// kWater: the sea; kRivers: rivers and lakes.
enum class SurfaceKind : std::uint8_t { kWater, kTerrain, kObjects, kTrees, kRivers };
inline constexpr std::size_t kSurfaceKinds = kEnumerators<SurfaceKind>;
inline constexpr auto kAllSurfaces = all_enumerators<SurfaceKind>();

// Which picture of them a view is.
enum class ViewKind : std::uint8_t {
  kWindow,      // as seen
  kReflection,  // the eye's side of the water's level, mirrored in it
  kRefraction,  // the other side, as it appears through the surface
};
inline constexpr std::size_t kViewKinds = kEnumerators<ViewKind>;
inline constexpr auto kAllViewKinds = all_enumerators<ViewKind>();

// What the stages of a frame know of a kind of surface beside its triangles.
struct SurfaceTraits {
  bool is_water = false;          // shows in the window only: it looks into the other pictures
  bool keeps_clip_margin = true;  // images keep a margin of what lies beyond the water's level
  bool varies_slowly = false;     // a pixel may be filled in from those beside it
  // The kind that it is one with where edges are looked for, but for DrawRecord::like_land.
  SurfaceKind edges_as;
};
inline constexpr auto kSurfaceTraits = enum_table<SurfaceKind, SurfaceTraits>({
    {SurfaceKind::kWater,
     {.is_water = true, .varies_slowly = true, .edges_as = SurfaceKind::kWater}},
    {SurfaceKind::kTerrain,
     {.keeps_clip_margin = false, .varies_slowly = true, .edges_as = SurfaceKind::kTerrain}},
    {SurfaceKind::kObjects, {.edges_as = SurfaceKind::kObjects}},
    {SurfaceKind::kTrees, {.edges_as = SurfaceKind::kTerrain}},
    {SurfaceKind::kRivers,
     {.is_water = true, .varies_slowly = true, .edges_as = SurfaceKind::kRivers}},
});

constexpr bool shows(ViewKind view, SurfaceKind surface) {
  return view == ViewKind::kWindow || !kSurfaceTraits[surface].is_water;
}

// Which of a surface's triangles and vertices are one thing.
struct DrawPart {
  std::uint32_t first_triangle = 0, triangles = 0;
  std::uint32_t first_vertex = 0, vertices = 0;
  bool is_cast = false;  // found by rays: its triangles but stand for its parts
};

// The triangles of a kind that its material places (materials/list.h).
struct PlacedSurface {
  std::vector<std::uint32_t> indices;  // 3 per triangle
  std::vector<glm::vec3> p_rel;        // per vertex, relative to the eye
};

// The one table of primitive numbers: the triangles of each surface have consecutive ones, surface
// after surface. raster::kNoPrimitive lies in no range.
class PrimitiveRanges {
 public:
  PrimitiveRanges() = default;
  // From the number of triangles of each surface.
  explicit PrimitiveRanges(const std::array<std::uint32_t, kSurfaceKinds>& triangles) {
    for (std::size_t k = 0; k < kSurfaceKinds; ++k) begin_[k + 1] = begin_[k] + triangles[k];
  }

  std::uint32_t begin(SurfaceKind kind) const { return begin_[static_cast<std::size_t>(kind)]; }
  std::uint32_t end(SurfaceKind kind) const { return begin_[static_cast<std::size_t>(kind) + 1]; }
  bool empty(SurfaceKind kind) const { return begin(kind) == end(kind); }
  bool holds(SurfaceKind kind, std::uint32_t primitive) const {
    return primitive - begin(kind) < end(kind) - begin(kind);
  }
  std::uint32_t count() const { return begin_.back(); }

 private:
  std::array<std::uint32_t, kSurfaceKinds + 1> begin_{};
};

}  // namespace swell::render
