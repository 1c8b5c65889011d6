#include "render/picture/crossed_tile.h"

#include <algorithm>

#include "render/frame/target.h"
#include "render/view/crossing.h"

namespace swell::render {
namespace {

// Calls visit(pixel of the picture, pixel of the box, x_px, y_px).
template <class Visit>
void for_pixels(const raster::PixelBox& box, int width_px, const Visit& visit) {
  for (int y = 0; y < box.height_px; ++y)
    for (int x = 0; x < box.width_px; ++x) {
      const int x_px = box.x0_px + x, y_px = box.y0_px + y;
      visit(static_cast<std::size_t>(y_px) * width_px + x_px,
            static_cast<std::size_t>(y) * box.width_px + x, x_px, y_px);
    }
}

constexpr float kMeniscus_px = 2.0f;

// Half as bright in the middle of the line, as before from kMeniscus_px on.
float light_left(float rows_away) {
  const float t = std::clamp(rows_away / kMeniscus_px, 0.0f, 1.0f);
  return 0.45f + 0.55f * t * t * (3.0f - 2.0f * t);
}

std::uint32_t dimmed(std::uint32_t rgba, float part) {
  const auto channel = [&](int shift) {
    const auto value = static_cast<float>(rgba >> shift & 0xff);
    return static_cast<std::uint32_t>(value * part + 0.5f) << shift;
  };
  return (rgba & 0xff000000u) | channel(0) | channel(8) | channel(16);
}

}  // namespace

void keep_tile(const raster::PixelBox& box, const Target& target, CrossedScratch& scratch) {
  for_pixels(box, target.width_px, [&](std::size_t at, std::size_t kept, int, int) {
    scratch.rgba[kept] = target.rgba[at];
    if (!target.linear.empty())
      std::copy_n(target.linear.begin() + static_cast<std::ptrdiff_t>(3 * at), 3,
                  scratch.linear.begin() + static_cast<std::ptrdiff_t>(3 * kept));
  });
}

void put_back_dry(const Crossing& line, const raster::PixelBox& box, int tile_size_px,
                  const CrossedScratch& scratch, Target& target, ShadedLabels* labels) {
  for_pixels(box, target.width_px, [&](std::size_t at, std::size_t kept, int x_px, int y_px) {
    if (line.above(x_px, y_px) < 0.0f) return;
    target.rgba[at] = scratch.rgba[kept];
    if (!target.linear.empty())
      std::copy_n(scratch.linear.begin() + static_cast<std::ptrdiff_t>(3 * kept), 3,
                  target.linear.begin() + static_cast<std::ptrdiff_t>(3 * at));
    if (!labels) return;
    const std::size_t i =
        static_cast<std::size_t>(y_px - box.y0_px) * tile_size_px + (x_px - box.x0_px);
    labels->normal_x[i] = scratch.labels.normal_x[i];
    labels->normal_y[i] = scratch.labels.normal_y[i];
    labels->normal_z[i] = scratch.labels.normal_z[i];
    labels->foam_cover[i] = scratch.labels.foam_cover[i];
    labels->flags[i] = scratch.labels.flags[i];
  });
}

// By the line's cells, whatever tiles they lie in.
void draw_meniscus(const Crossing& line, const raster::PixelBox& box, Target& target) {
  constexpr int kCell = Crossing::kStep_px;
  for (int y0 = box.y0_px; y0 < box.y0_px + box.height_px; y0 += kCell)
    for (int x0 = box.x0_px; x0 < box.x0_px + box.width_px; x0 += kCell) {
      if (line.least_rows_away(x0, y0) >= kMeniscus_px) continue;
      const raster::PixelBox cell{x0, y0, std::min(kCell, box.x0_px + box.width_px - x0),
                                  std::min(kCell, box.y0_px + box.height_px - y0)};
      for_pixels(cell, target.width_px, [&](std::size_t at, std::size_t, int x_px, int y_px) {
        const float left = light_left(line.rows_away(x_px, y_px));
        if (left >= 1.0f) return;
        target.rgba[at] = dimmed(target.rgba[at], left);
        if (!target.linear.empty())
          for (std::size_t c = 0; c < 3; ++c) target.linear[3 * at + c] *= left;
      });
    }
}

}  // namespace swell::render
