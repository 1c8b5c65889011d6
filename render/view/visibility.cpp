#include "render/view/visibility.h"

#include <algorithm>

namespace swell::render {
namespace {

int count_of(const PrimitiveRanges& ranges, SurfaceKind kind,
             std::span<const std::uint32_t> primitives) {
  const std::uint32_t begin = ranges.begin(kind), size = ranges.end(kind) - begin;
  std::uint32_t count = 0;
  for (const std::uint32_t p : primitives) count += static_cast<std::uint32_t>(p - begin < size);
  return static_cast<int>(count);
}

void find_visible_in_tile(const RenderView& window, int tile, bool samples,
                          VisibilityBuffer& visibility) {
  visibility.covered[tile] = -1;
  visibility.water_pixels[tile] = 0;
  visibility.may_show_water[tile] = 0;
  if (!raster::tile_has_triangles(window.pass, tile)) return;
  const std::span<std::uint32_t> primitive = visibility.primitive_of(tile);
  visibility.covered[tile] =
      raster::draw_tile(window.pass, tile, visibility.depth_of(tile), primitive);
  visibility.water_pixels[tile] = count_of(window.primitives, SurfaceKind::kWater, primitive);
  visibility.may_show_water[tile] =
      visibility.water_pixels[tile] > 0 ||
      (samples &&
       raster::tile_has_triangles(window.pass, tile, window.primitives.begin(SurfaceKind::kWater),
                                  window.primitives.end(SurfaceKind::kWater)));
}

}  // namespace

void find_visible(const Meshes& meshes, int tile_size_px, int edge_samples, RenderView& window,
                  VisibilityBuffer& visibility, const StageRun& run) {
  prepare_view_pass(meshes, tile_size_px, edge_samples, window, run.workers);
  visibility.grid = raster::tile_grid(window.viewport(), tile_size_px);
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  visibility.depth.resize(tiles * visibility.tile_pixels());
  visibility.primitive.resize(tiles * visibility.tile_pixels());
  visibility.covered.resize(tiles);
  visibility.water_pixels.resize(tiles);
  visibility.may_show_water.resize(tiles);
  run.for_each(tiles, [&](std::size_t tile, int) {
    find_visible_in_tile(window, static_cast<int>(tile), edge_samples != 0, visibility);
  });
}

}  // namespace swell::render
