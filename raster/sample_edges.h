// Edge functions for the samples of a tile's pixels: what the second pass shares.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "raster/setup.h"

namespace swell::raster {

// The pixels of a tile, numbered from its corner, whose samples the triangle may cover. `box` is
// the tile's part of the viewport.
inline PixelRect sample_rect_in_tile(const SetupTriangle& t, SampleExtent extent,
                                     const PixelBox& box) {
  const PixelRect rect = pixels_between(bounds_of(t), extent);
  return {std::max(rect.x0 - box.x0_px, 0), std::max(rect.y0 - box.y0_px, 0),
          std::min(rect.x1 - box.x0_px, box.width_px - 1),
          std::min(rect.y1 - box.y0_px, box.height_px - 1)};
}

// True if the triangle is so small that its edge functions fit 32 bits in the pixels of its
// sample_rect_in_tile: |E| <= 2 * 2^13 * 2^14.
inline bool is_small(const SetupTriangle& t) {
  constexpr std::int32_t kSmallFx8 = 32 * kPixelFx8;
  const BoundsFx8 bounds = bounds_of(t);
  return bounds.x1 - bounds.x0 <= kSmallFx8 && bounds.y1 - bounds.y0 <= kSmallFx8;
}

// An edge function over a rectangle of pixels: E at the upper left corner of the first one, its
// steps of one pixel (256 a and 256 b exactly), and its largest value above E at a pixel's corner
// in the square that holds the pixel's samples. If the edge changes sign in the rectangle,
// |E| / 256 <= 65 (|a| + |b|) < 2^30 in all of it.
struct SampleEdge {
  std::int64_t at_corner, reach;
  std::int32_t a, b;
};

// The edges over `rect` (of sample_rect_in_tile, not empty); one that all samples in it are inside
// of becomes 0. False if all samples are outside of an edge.
inline bool set_up_sample_edges(const SetupTriangle& t, SampleExtent extent, const PixelBox& box,
                                const PixelRect& rect, std::array<SampleEdge, 3>& out) {
  const auto [low, high] = extent;
  for (int i = 0; i < 3; ++i) {
    const Edge edge = edge_of(t, i);
    const std::int64_t a = edge.a, b = edge.b;
    const std::int64_t at_corner =
        edge.at((box.x0_px + rect.x0) * kPixelFx8, (box.y0_px + rect.y0) * kPixelFx8);
    const std::int32_t far_x = (rect.x1 - rect.x0) * kPixelFx8 + high;
    const std::int32_t far_y = (rect.y1 - rect.y0) * kPixelFx8 + high;
    const std::int64_t highest = at_corner + a * (a > 0 ? far_x : low) + b * (b > 0 ? far_y : low);
    const std::int64_t lowest = at_corner + a * (a > 0 ? low : far_x) + b * (b > 0 ? low : far_y);
    if (highest < 0) return false;
    const std::int64_t reach = a * (a > 0 ? high : low) + b * (b > 0 ? high : low);
    out[i] = lowest < 0 ? SampleEdge{at_corner, reach, edge.a, edge.b} : SampleEdge{};
  }
  return true;
}

// Bits first to last, inclusive, both in [0, 63].
inline std::uint64_t bits_between(std::int32_t first, std::int32_t last) {
  return (~std::uint64_t{0} << first) & (~std::uint64_t{0} >> (63 - last));
}

}  // namespace swell::raster
