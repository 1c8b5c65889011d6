#include "raster/setup.h"

#include <algorithm>
#include <utility>

namespace swell::raster {
namespace {

bool above(const WindowVertex& a, const WindowVertex& b) {
  return a.y_fx8 != b.y_fx8 ? a.y_fx8 < b.y_fx8 : a.x_fx8 < b.x_fx8;
}

// The plane z(x, y) through the three vertices, whose doubled area is area_fx16 > 0.
void set_up_depth(const std::array<const WindowVertex*, 3>& v, std::int64_t area_fx16,
                  SetupTriangle& out) {
  // Gradients by Cramer's rule; 256 turns "per 1/256 px" into "per px".
  const double dz1 = double{v[1]->depth} - v[0]->depth;
  const double dz2 = double{v[2]->depth} - v[0]->depth;
  const double dx1 = v[1]->x_fx8 - v[0]->x_fx8, dy1 = v[1]->y_fx8 - v[0]->y_fx8;
  const double dx2 = v[2]->x_fx8 - v[0]->x_fx8, dy2 = v[2]->y_fx8 - v[0]->y_fx8;
  const double scale = kPixelFx8 / static_cast<double>(area_fx16);
  out.dz_dx = static_cast<float>((dz1 * dy2 - dz2 * dy1) * scale);
  out.dz_dy = static_cast<float>((dz2 * dx1 - dz1 * dx2) * scale);

  // Of equally far vertices the first.
  const WindowVertex* far = v[0];
  if (v[1]->depth < far->depth) far = v[1];
  if (v[2]->depth < far->depth) far = v[2];
  out.x_ref_fx8 = far->x_fx8;
  out.y_ref_fx8 = far->y_fx8;
  out.z_min = far->depth;
  out.z_max = std::max({v[0]->depth, v[1]->depth, v[2]->depth});
}

// The pixels whose centres lie in [min_fx8, max_fx8] and in [0, size_px): {first, last}.
std::pair<std::int32_t, std::int32_t> centres_between(std::int32_t min_fx8, std::int32_t max_fx8,
                                                      int size_px) {
  const std::int32_t first = (min_fx8 - kHalfPixelFx8 + kPixelFx8 - 1) >> kFractionBits;
  const std::int32_t last = (max_fx8 - kHalfPixelFx8) >> kFractionBits;
  return {std::max(first, 0), std::min(last, size_px - 1)};
}

bool box_misses_viewport(std::int32_t min_x, std::int32_t max_x, std::int32_t min_y,
                         std::int32_t max_y, Viewport viewport) {
  return max_x <= 0 || max_y <= 0 || min_x >= viewport.width_px * kPixelFx8 ||
         min_y >= viewport.height_px * kPixelFx8;
}

}  // namespace

SetupResult set_up_triangle(const WindowVertex& v0, const WindowVertex& v1, const WindowVertex& v2,
                            Cull cull, Viewport viewport, std::uint32_t primitive,
                            SetupTriangle& out) {
  // Area and facing. Positive is clockwise on the screen, as y points down.
  std::array<const WindowVertex*, 3> v{&v0, &v1, &v2};
  std::int64_t area_fx16 = std::int64_t{v1.x_fx8 - v0.x_fx8} * (v2.y_fx8 - v0.y_fx8) -
                           std::int64_t{v2.x_fx8 - v0.x_fx8} * (v1.y_fx8 - v0.y_fx8);
  if (area_fx16 == 0) return SetupResult::kDegenerate;
  if (cull == (area_fx16 > 0 ? Cull::kClockwise : Cull::kCounterClockwise)) {
    return SetupResult::kFacing;
  }

  // Bounding box.
  const auto [min_x, max_x] = std::minmax({v0.x_fx8, v1.x_fx8, v2.x_fx8});
  const auto [min_y, max_y] = std::minmax({v0.y_fx8, v1.y_fx8, v2.y_fx8});
  const auto [first_x, last_x] = centres_between(min_x, max_x, viewport.width_px);
  const auto [first_y, last_y] = centres_between(min_y, max_y, viewport.height_px);
  if (first_x > last_x || first_y > last_y) {
    return box_misses_viewport(min_x, max_x, min_y, max_y, viewport) ? SetupResult::kOutside
                                                                     : SetupResult::kBetweenPixels;
  }
  out.min_x = static_cast<std::int16_t>(first_x);
  out.max_x = static_cast<std::int16_t>(last_x);
  out.min_y = static_cast<std::int16_t>(first_y);
  out.max_y = static_cast<std::int16_t>(last_y);

  // Canonical order.
  if (area_fx16 < 0) {
    std::swap(v[1], v[2]);
    area_fx16 = -area_fx16;
  }
  if (above(*v[1], *v[0]) && above(*v[1], *v[2])) {
    v = {v[1], v[2], v[0]};
  } else if (above(*v[2], *v[0])) {
    v = {v[2], v[0], v[1]};
  }
  for (int i = 0; i < 3; ++i) {
    out.x_fx8[i] = v[i]->x_fx8;
    out.y_fx8[i] = v[i]->y_fx8;
  }
  set_up_depth(v, area_fx16, out);
  out.primitive = primitive;
  return SetupResult::kReady;
}

}  // namespace swell::raster
