#include "render/view/visibility.h"

#include <algorithm>

#include "math/large_array.h"
#include "render/frame/profile.h"
#include "render/view/cast_land.h"
#include "render/view/meshes.h"

namespace swell::render {
namespace {

int count_of(const PrimitiveRanges& ranges, SurfaceKind kind,
             std::span<const std::uint32_t> primitives) {
  const std::uint32_t begin = ranges.begin(kind), size = ranges.end(kind) - begin;
  std::uint32_t count = 0;
  for (const std::uint32_t p : primitives) count += static_cast<std::uint32_t>(p - begin < size);
  return static_cast<int>(count);
}

// The images that water in a tile may look into. `samples`: water in parts of pixels counts, too.
std::uint8_t images_of(const Meshes& meshes, const RenderView& window, int tile, bool samples,
                       int water_pixels, std::span<const std::uint32_t> primitives) {
  const auto may_show = [&](SurfaceKind kind) {
    const std::uint32_t begin = window.primitives.begin(kind), end = window.primitives.end(kind);
    return begin < end && raster::tile_has_triangles(window.pass, tile, begin, end);
  };
  std::uint32_t images = 0;
  if (water_pixels > 0 || (samples && may_show(SurfaceKind::kWater)))
    images = kSeaFloor | kSeaMirror;
  if (!may_show(SurfaceKind::kRivers)) return static_cast<std::uint8_t>(images);
  if (samples) return kSeaFloor | kSeaMirror | kRiverMirrors;
  const std::uint32_t first = window.primitives.begin(SurfaceKind::kRivers);
  const std::span<const std::uint8_t> looks_into = meshes.rivers.looks_into;
  for (const std::uint32_t p : primitives)
    if (p - first < looks_into.size()) images |= looks_into[p - first];
  return static_cast<std::uint8_t>(images);
}

// What later stages ask of a tile's water, once all of it is there. `samples`: as for images_of().
void note_water(const Meshes& meshes, const RenderView& window, int tile, bool samples,
                VisibilityBuffer& visibility) {
  const bool is_empty = visibility.covered[tile] < 0;
  const std::span<const std::uint32_t> primitive = visibility.primitive_of(tile);
  int& water = visibility.water_pixels[tile];
  water = is_empty ? 0 : count_of(window.primitives, SurfaceKind::kWater, primitive);
  visibility.looks_into[tile] =
      is_empty ? 0 : images_of(meshes, window, tile, samples, water, primitive);
}

}  // namespace

void find_visible(const Meshes& meshes, int tile_size_px, int edge_samples, RenderView& window,
                  VisibilityBuffer& visibility, const StageRun& run) {
  prepare_view_pass(meshes, tile_size_px, edge_samples, window, run.workers);
  visibility.grid = raster::tile_grid(window.viewport(), tile_size_px);
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  resize_large(visibility.depth, tiles * visibility.tile_pixels());
  resize_large(visibility.primitive, tiles * visibility.tile_pixels());
  visibility.covered.resize(tiles);
  visibility.water_pixels.resize(tiles);
  visibility.looks_into.resize(tiles);
  run.for_each(tiles, [&](std::size_t i, int) {
    const int tile = static_cast<int>(i);
    visibility.covered[tile] = raster::tile_has_triangles(window.pass, tile)
                                   ? raster::draw_tile(window.pass, tile, visibility.depth_of(tile),
                                                       visibility.primitive_of(tile))
                                   : -1;
    if (!has_rays(window)) note_water(meshes, window, tile, edge_samples != 0, visibility);
  });
}

bool has_rays(const RenderView& window) {
  return window.land != nullptr || !window.implicits.implicits.empty();
}

void find_by_rays(const Meshes& meshes, int edge_samples, const RenderView& window,
                  VisibilityBuffer& visibility, const StageRun& run) {
  run.for_each(visibility.covered.size(), [&](std::size_t i, int) {
    const int tile = static_cast<int>(i);
    const std::span<float> depth = visibility.depth_of(tile);
    const std::span<std::uint32_t> primitive = visibility.primitive_of(tile);
    int& covered = visibility.covered[tile];
    if (window.land)
      covered = cast_land(window, visibility.grid, tile, covered < 0, depth, primitive);
    covered =
        draw_implicits(window.implicits, raster::tile_box(window.viewport(), visibility.grid, tile),
                       visibility.grid.tile_size_px, covered, depth, primitive);
    note_water(meshes, window, tile, edge_samples != 0, visibility);
  });
}

}  // namespace swell::render
