#include "render/picture/shade_picture.h"

#include "render/frame/profile.h"
#include "render/frame/target.h"
#include "render/picture/crossed_tile.h"
#include "render/picture/label_tile.h"
#include "render/picture/thread_scratch.h"
#include "render/shade/shade_tile.h"
#include "render/view/crossing.h"

namespace swell::render {
namespace {

// Which pixels of a tile begin in water.
void mark_in_water(const PictureInputs& in, int tile, Begins begins,
                   std::array<std::uint8_t, kMaxTilePixels>& in_water) {
  in_water.fill(begins == Begins::kInWater);
  if (begins != Begins::kInBoth) return;
  const raster::PixelBox box = raster::tile_box(in.window.viewport(), in.visibility.grid, tile);
  for (int y = 0; y < box.height_px; ++y)
    for (int x = 0; x < box.width_px; ++x)
      in_water[static_cast<std::size_t>(y) * in.visibility.grid.tile_size_px + x] =
          in.wet->line.above(box.x0_px + x, box.y0_px + y) < 0.0f;
}

void label_tile(const PictureInputs& in, int tile, Begins begins, ThreadScratch& scratch,
                Labels& labels) {
  mark_in_water(in, tile, begins, scratch.in_water);
  LabelTile pixels{.number = tile};
  if (in.visibility.covered[tile] > 0)
    pixels = {tile, in.visibility.depth_of(tile), in.visibility.primitive_of(tile),
              in.labels->tables.from_shading ? &scratch.labels : nullptr};
  pixels.in_water = scratch.in_water;
  fill_label_tile(*in.labels, pixels, labels);
}

// What a tile's rays begin in.
Begins begins_in(const PictureInputs& in, int tile) {
  if (!in.wet) return in.shading.media.submerged ? Begins::kInWater : Begins::kInAir;
  return in.wet->line.begins(raster::tile_box(in.window.viewport(), in.visibility.grid, tile));
}

// Shades a tile as from one side of the surface.
ShadedPixels shade_side(const PictureInputs& in, int tile, const Shading& shading,
                        const std::vector<TilePlanarMaps>& planar_maps, ThreadScratch& scratch,
                        Target& target) {
  const auto index = static_cast<std::size_t>(tile);
  const std::span<const EdgeFragment> fragments = in.edges.of_tile[index];
  if (in.visibility.covered[index] <= 0 && fragments.empty()) {
    shade_sky_tile(shading, tile, scratch.shade, target.rgba, target.linear);
    return {};
  }
  const bool labels_shading = in.labels && in.labels->tables.from_shading;
  return shade_tile(shading,
                    {tile, in.visibility.depth_of(tile), in.visibility.primitive_of(tile),
                     fragments, planar_maps[index]},
                    scratch.shade, target.rgba, target.linear,
                    labels_shading ? &scratch.labels : nullptr);
}

ShadedPixels shade_sides(const PictureInputs& in, int tile, Begins begins, ThreadScratch& scratch,
                         Target& target) {
  if (!in.wet || begins == Begins::kInAir)
    return shade_side(in, tile, in.shading, in.planar_maps, scratch, target);
  const auto shade_wet = [&] {
    return shade_side(in, tile, in.wet->shading, in.wet->planar_maps, scratch, target);
  };
  if (begins == Begins::kInWater) return shade_wet();
  if (!scratch.crossed) scratch.crossed = std::make_unique<CrossedScratch>();
  shade_side(in, tile, in.shading, in.planar_maps, scratch, target);
  const raster::PixelBox box = raster::tile_box(in.window.viewport(), in.visibility.grid, tile);
  const bool labels_shading = in.labels && in.labels->tables.from_shading;
  keep_tile(box, target, *scratch.crossed);
  if (labels_shading) scratch.crossed->labels = scratch.labels;
  const ShadedPixels shaded = shade_wet();
  put_back_dry(in.wet->line, box, in.visibility.grid.tile_size_px, *scratch.crossed, target,
               labels_shading ? &scratch.labels : nullptr);
  return shaded;
}

}  // namespace

void shade_picture(const PictureInputs& in, ScratchList scratch, std::vector<ShadedPixels>& shaded,
                   Target& target, const StageRun& run) {
  const VisibilityBuffer& visibility = in.visibility;
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  shaded.assign(tiles, {});
  run.for_each(tiles, [&](std::size_t index, int thread) {
    const auto tile = static_cast<int>(index);
    ThreadScratch& memory = *scratch[thread];
    find_edges(in.window, visibility, tile, memory.edges, in.edges);
    const Begins begins = begins_in(in, tile);
    shaded[index] = shade_sides(in, tile, begins, memory, target);
    if (in.wet && in.wet->meniscus)
      draw_meniscus(in.wet->line, raster::tile_box(in.window.viewport(), visibility.grid, tile),
                    target);
    if (in.labels) label_tile(in, tile, begins, memory, target.labels);
    if (in.wireframe && visibility.covered[tile] > 0) draw_wireframe(in, tile, target);
  });
}

}  // namespace swell::render
