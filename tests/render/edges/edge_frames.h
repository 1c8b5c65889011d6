// Frames with smooth edges, for their tests: small pictures and the parts of their pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/shot.h"

namespace swell::render {

// What a pixel's centre shows.
struct Centre {
  float z = 0.0f;
  std::uint32_t primitive = raster::kNoPrimitive;
};

// Draws one frame after another of a world.
class EdgeRenderer : public Shot {
 public:
  explicit EdgeRenderer(const World& world, double t_s = 0.0, int threads = 2)
      : Shot(threads), world_(world), t_s_(t_s) {
    options.water_triangles = options.terrain_triangles = 4000;
    options.edge_samples = 0;
    options.shading = scene::ShadingRate::kFull;  // so that a pixel depends on no other
  }

  const FrameStatistics& draw(const View& seen, int edge_samples) {
    options.edge_samples = edge_samples;
    Shot::draw(world_, seen, t_s_, options);
    return statistics;
  }

  // Returns what the centre of each pixel of the picture shows.
  std::vector<Centre> centres() const {
    const VisibilityBuffer& buffer = state().visibility;
    std::vector<Centre> centres(pixel_count());
    for_each_pixel([&](int tile, std::size_t in_tile, std::size_t pixel) {
      if (buffer.covered[static_cast<std::size_t>(tile)] >= 0)
        centres[pixel] = {buffer.depth_of(tile)[in_tile], buffer.primitive_of(tile)[in_tile]};
    });
    return centres;
  }

  // Returns the fragments of each pixel of the picture, in the order in which the tiles hold them.
  std::vector<std::vector<EdgeFragment>> fragments() const {
    std::vector<std::vector<EdgeFragment>> of_pixel(pixel_count());
    const raster::TileGrid& grid = state().visibility.grid;
    for (int tile = 0; tile < grid.count(); ++tile) {
      const raster::PixelBox box = raster::tile_box(state().window.viewport(), grid, tile);
      for (const EdgeFragment& f : state().edges.of_tile[static_cast<std::size_t>(tile)]) {
        const int x_px = box.x0_px + f.pixel % grid.tile_size_px;
        const int y_px = box.y0_px + f.pixel / grid.tile_size_px;
        of_pixel.at(static_cast<std::size_t>(y_px * target.width_px + x_px)).push_back(f);
      }
    }
    return of_pixel;
  }

  // Returns 0 for the sky, 1 the water, 2 the land, 3 an object, 4 a tree, 5 a river.
  int kind_of(std::uint32_t primitive) const {
    for (const SurfaceKind kind : kAllSurfaces)
      if (state().window.primitives.holds(kind, primitive)) return 1 + static_cast<int>(kind);
    return 0;
  }

  // Returns kind_of(), but for every object its own number from 3 on. Not for trees and rivers.
  std::ptrdiff_t surface_of(std::uint32_t primitive) const {
    const ObjectDraws& objects = state().meshes.objects.in_window();
    if (kind_of(primitive) < 3) return kind_of(primitive);
    const std::uint32_t n = primitive - state().window.primitives.begin(SurfaceKind::kObjects);
    return 3 + (objects.primitives[n].object - objects.instances.data());
  }

  FrameOptions options;

 private:
  std::size_t pixel_count() const { return target.rgba.size(); }

  template <class Visit>
  void for_each_pixel(const Visit& visit) const {
    const raster::TileGrid& grid = state().visibility.grid;
    for (int tile = 0; tile < grid.count(); ++tile) {
      const raster::PixelBox box = raster::tile_box(state().window.viewport(), grid, tile);
      for (int y = 0; y < box.height_px; ++y)
        for (int x = 0; x < box.width_px; ++x)
          visit(tile, static_cast<std::size_t>(y * grid.tile_size_px + x),
                static_cast<std::size_t>((box.y0_px + y) * target.width_px + box.x0_px + x));
    }
  }

  const World& world_;
  double t_s_;
};

}  // namespace swell::render
