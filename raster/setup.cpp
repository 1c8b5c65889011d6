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

  // The reference is the farthest vertex, of equally far ones the first.
  const WindowVertex* far = v[0];
  if (v[1]->depth < far->depth) far = v[1];
  if (v[2]->depth < far->depth) far = v[2];
  out.x_ref_fx8 = far->x_fx8;
  out.y_ref_fx8 = far->y_fx8;
  out.z_min = far->depth;
  out.z_max = std::max({v[0]->depth, v[1]->depth, v[2]->depth});
}

bool misses_viewport(const BoundsFx8& bounds, Viewport viewport) {
  return bounds.x1 <= 0 || bounds.y1 <= 0 || bounds.x0 >= viewport.width_px * kPixelFx8 ||
         bounds.y0 >= viewport.height_px * kPixelFx8;
}

// Why a triangle whose bounds hold no pixel centre is left out; kReady if it is kept because they
// may hold a sample.
SetupResult result_without_centres(const BoundsFx8& bounds, const SetupRules& rules) {
  if (misses_viewport(bounds, rules.viewport)) return SetupResult::kOutside;
  const PixelRect rect = pixels_between(bounds, sample_extent(rules.samples));
  return limit_to(rules.viewport, rect).empty() ? SetupResult::kBetweenPixels : SetupResult::kReady;
}

}  // namespace

SetupResult set_up_triangle(const WindowVertex& v0, const WindowVertex& v1, const WindowVertex& v2,
                            const SetupRules& rules, std::uint32_t primitive, SetupTriangle& out) {
  // Area and facing. Positive is clockwise on the screen, as y points down.
  std::array<const WindowVertex*, 3> v{&v0, &v1, &v2};
  std::int64_t area_fx16 = std::int64_t{v1.x_fx8 - v0.x_fx8} * (v2.y_fx8 - v0.y_fx8) -
                           std::int64_t{v2.x_fx8 - v0.x_fx8} * (v1.y_fx8 - v0.y_fx8);
  if (area_fx16 == 0) return SetupResult::kDegenerate;
  if (rules.cull == (area_fx16 > 0 ? Cull::kClockwise : Cull::kCounterClockwise)) {
    return SetupResult::kFacing;
  }

  // Bounding box.
  const auto [min_x, max_x] = std::minmax({v0.x_fx8, v1.x_fx8, v2.x_fx8});
  const auto [min_y, max_y] = std::minmax({v0.y_fx8, v1.y_fx8, v2.y_fx8});
  const BoundsFx8 bounds{min_x, min_y, max_x, max_y};
  const PixelRect rect = limit_to(rules.viewport, pixels_between(bounds, sample_extent(0)));
  if (rect.empty()) {
    const SetupResult result = result_without_centres(bounds, rules);
    if (result != SetupResult::kReady) return result;
  }
  out.min_x = static_cast<std::int16_t>(rect.x0);
  out.max_x = static_cast<std::int16_t>(rect.x1);
  out.min_y = static_cast<std::int16_t>(rect.y0);
  out.max_y = static_cast<std::int16_t>(rect.y1);

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
