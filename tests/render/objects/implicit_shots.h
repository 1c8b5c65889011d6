// An implicit surface drawn alone: depth and part of each pixel.
#pragma once

#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/view/objects_drawn.h"
#include "render/view/render_view.h"
#include "scene/file/implicit_file.h"

namespace swell::render {

struct ImplicitShot {
  View view;
  std::vector<float> depth_m;       // 0: nothing
  std::vector<std::uint32_t> part;  // raster::kNoPrimitive: nothing
  std::size_t count = 0;            // of pixels that show it

  glm::dvec3 ray(std::size_t pixel) const {
    const auto x = static_cast<double>(pixel % static_cast<std::size_t>(view.width_px)) + 0.5;
    const auto y = static_cast<double>(pixel / static_cast<std::size_t>(view.width_px)) + 0.5;
    const double x_ndc = 2.0 * x / view.width_px - 1.0, y_ndc = 1.0 - 2.0 * y / view.height_px;
    return glm::dvec3(view.forward) +
           glm::dvec3(view.right) * (x_ndc * view.tan_half_x + view.tan_middle_x) +
           glm::dvec3(view.up) * (y_ndc * view.tan_half_y + view.tan_middle_y);
  }
  // On the ground plane of the picture at depth 1.
  double pixel_area() const {
    return 4.0 * view.tan_half_x * view.tan_half_y / (view.width_px * view.height_px);
  }
};

inline ImplicitShot shoot(const scene::ImplicitSurface& implicit, const View& view,
                          double t_s = 0.0, bool squares = true, int tile_size_px = 64) {
  PosedImplicit posed;
  pose_implicit(implicit, t_s, posed);
  const glm::dvec3 size = implicit.high - implicit.low;
  const glm::vec3 base(0.5 * (implicit.low.x + implicit.high.x),
                       0.5 * (implicit.low.y + implicit.high.y), implicit.low.z);
  ObjectDraws draws;
  ObjectInstance instance;
  instance.right = {1.0 / size.x, 0.0, 0.0};
  instance.ahead = {0.0, 1.0 / size.y, 0.0};
  instance.up = {0.0, 0.0, 1.0 / size.z};
  instance.implicit = &posed;
  instance.implicit_size = glm::vec3(size);
  instance.implicit_base = base;
  instance.bottom_rel = glm::vec3(glm::dvec3(base) - view.eye_world);
  draws.instances.push_back(instance);
  const auto parts = static_cast<std::uint32_t>(implicit.parts.size());
  draws.parts.push_back({0, parts, 0, 0});
  RenderView shown;
  shown.camera = view;
  shown.primitives = PrimitiveRanges({0, 0, parts});
  find_implicits(draws, shown);
  shown.implicits.squares = squares;

  ImplicitShot shot;
  shot.view = view;
  const auto width = static_cast<std::size_t>(view.width_px);
  shot.depth_m.assign(width * static_cast<std::size_t>(view.height_px), 0.0f);
  shot.part.assign(shot.depth_m.size(), raster::kNoPrimitive);
  const raster::TileGrid grid = raster::tile_grid(shown.viewport(), tile_size_px);
  const auto side = static_cast<std::size_t>(tile_size_px);
  std::vector<float> z(side * side);
  std::vector<std::uint32_t> primitive(z.size());
  for (int tile = 0; tile < grid.count(); ++tile) {
    const raster::PixelBox box = raster::tile_box(shown.viewport(), grid, tile);
    if (draw_implicits(shown.implicits, box, tile_size_px, -1, z, primitive) < 0) continue;
    for (std::size_t y = 0; y < static_cast<std::size_t>(box.height_px); ++y)
      for (std::size_t x = 0; x < static_cast<std::size_t>(box.width_px); ++x) {
        const std::size_t to = (y + static_cast<std::size_t>(box.y0_px)) * width + x +
                               static_cast<std::size_t>(box.x0_px);
        if (primitive[y * side + x] == raster::kNoPrimitive) continue;
        shot.part[to] = primitive[y * side + x];
        shot.depth_m[to] = view.near_m / z[y * side + x];
        ++shot.count;
      }
  }
  return shot;
}

inline scene::ImplicitSurface implicit_of(const char* toml) {
  return scene::parse_implicit(toml, "form.toml");
}

// Looks at the origin along +y from a distance, at `height_m` of it from top to bottom.
inline View from_south(double distance_m, double height_m, int size_px) {
  const double fov = 2.0 * std::atan(0.5 * height_m / distance_m);
  return make_view({0.0, -distance_m, 0.0}, 0.0, 0.0, fov, 0.25f, size_px, size_px);
}

}  // namespace swell::render
