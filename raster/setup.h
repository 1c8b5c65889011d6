// Step 3 of a pass: what a tile needs to know of a triangle, in one cache line.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "raster/pass.h"
#include "raster/sample_pattern.h"
#include "raster/vertices.h"

namespace swell::raster {

// Vertices in canonical order: the one with the smallest (y, x) first, then so that the inside
// lies on the positive side of each edge. Any rotation of a triangle sets up to the same bits.
struct alignas(64) SetupTriangle {
  std::int32_t x_fx8[3], y_fx8[3];
  // z = fma(dz_dx, x - x_ref, fma(dz_dy, y - y_ref, z_min)) with x, y in px at pixel centres,
  // limited to [z_min, z_max]. The reference is the farthest vertex, where floats are finest.
  std::int32_t x_ref_fx8, y_ref_fx8;
  float z_min, z_max, dz_dx, dz_dy;
  std::uint32_t primitive;
  // Pixels whose centres the bounding box holds, within the viewport. Inclusive; none if min > max,
  // of a triangle kept for its samples.
  std::int16_t min_x, min_y, max_x, max_y;
};
static_assert(sizeof(SetupTriangle) == 64);

enum class SetupResult { kReady, kDegenerate, kFacing, kOutside, kBetweenPixels };

// What a triangle must pass to be set up.
struct SetupRules {
  Cull cull;
  Viewport viewport;
  int samples;  // of is_sample_count
};

// Sets up the triangle of three vertices that need no clipping.
SetupResult set_up_triangle(const WindowVertex& v0, const WindowVertex& v1, const WindowVertex& v2,
                            const SetupRules& rules, std::uint32_t primitive, SetupTriangle& out);

// A triangle's bounding box in the window, inclusive.
struct BoundsFx8 {
  std::int32_t x0, y0, x1, y1;
};

inline BoundsFx8 bounds_of(const SetupTriangle& t) {
  // The first vertex has the smallest y.
  return {std::min(std::min(t.x_fx8[0], t.x_fx8[1]), t.x_fx8[2]), t.y_fx8[0],
          std::max(std::max(t.x_fx8[0], t.x_fx8[1]), t.x_fx8[2]), std::max(t.y_fx8[1], t.y_fx8[2])};
}

// Inclusive; none if x0 > x1 or y0 > y1.
struct PixelRect {
  std::int32_t x0, y0, x1, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

// The pixels that have a point of their sample square in `bounds`, in the viewport or not.
inline PixelRect pixels_between(const BoundsFx8& bounds, SampleExtent extent) {
  return {(bounds.x0 - extent.high_fx8 + kPixelFx8 - 1) >> kFractionBits,
          (bounds.y0 - extent.high_fx8 + kPixelFx8 - 1) >> kFractionBits,
          (bounds.x1 - extent.low_fx8) >> kFractionBits,
          (bounds.y1 - extent.low_fx8) >> kFractionBits};
}

inline PixelRect limit_to(Viewport viewport, const PixelRect& rect) {
  return {std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, viewport.width_px - 1),
          std::min(rect.y1, viewport.height_px - 1)};
}

// Edge i runs from vertex i to vertex i + 1. A pixel centre (x, y) is inside if for all i
//   E(x, y) = a (x - x_i) + b (y - y_i) + bias >= 0   (fx8 coordinates, so 16 fraction bits),
// exactly. bias is 0 for top and left edges, which own their points, and -1 for the others.
struct Edge {
  std::int32_t a, b;  // 24 bits and sign
  std::int32_t x_fx8, y_fx8, bias;

  std::int64_t at(std::int32_t px_fx8, std::int32_t py_fx8) const {
    return std::int64_t{a} * (px_fx8 - x_fx8) + std::int64_t{b} * (py_fx8 - y_fx8) + bias;
  }
};

inline Edge edge_of(const SetupTriangle& t, int i) {
  const int j = i == 2 ? 0 : i + 1;
  const std::int32_t dx = t.x_fx8[j] - t.x_fx8[i];
  const std::int32_t dy = t.y_fx8[j] - t.y_fx8[i];
  const bool top_left = dy < 0 || (dy == 0 && dx > 0);
  return {-dy, dx, t.x_fx8[i], t.y_fx8[i], top_left ? 0 : -1};
}

}  // namespace swell::raster
