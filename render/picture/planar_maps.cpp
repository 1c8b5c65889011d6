#include "render/picture/planar_maps.h"

#include <algorithm>
#include <cmath>

#include "render/frame/parts.h"
#include "render/frame/profile.h"
#include "render/picture/thread_scratch.h"
#include "render/shade/shade_tile.h"
#include "render/view/cast_land.h"
#include "render/view/draw_record.h"
#include "render/view/meshes.h"

namespace swell::render {
namespace {

// The tiles of a planar map that a window tile's water can look into.
struct TileRange {
  int x0, y0, x1, y1;  // half open
};

// Size of the planar maps over that of the window.
glm::vec2 scale_of(const View& map, const View& window) {
  return {static_cast<float>(map.width_px) / static_cast<float>(window.width_px),
          static_cast<float>(map.height_px) / static_cast<float>(window.height_px)};
}

TileRange reachable_tiles(const View& window, const raster::TileGrid& grid, int tile,
                          glm::vec2 lookup_scale, const raster::TileGrid& planar_grid) {
  const float bound = max_distortion_px(window);
  // A sample of the softest level reads one and a half of its blocks further each way.
  constexpr float kReach = 2.0f + 1.5f * (1 << (texture::kMostRgbaLevels - 1));
  const auto range = [&](int index, float scale, int tiles) {
    const auto low = static_cast<float>(index * grid.tile_size_px) - bound;
    const float high = static_cast<float>((index + 1) * grid.tile_size_px) + bound;
    const auto size = static_cast<float>(planar_grid.tile_size_px);
    return std::pair{
        std::clamp(static_cast<int>(std::floor((low * scale - kReach) / size)), 0, tiles - 1),
        std::clamp(static_cast<int>(std::floor((high * scale + kReach) / size)), 0, tiles - 1) + 1};
  };
  const auto [x0, x1] = range(tile % grid.tiles_x, lookup_scale.x, planar_grid.tiles_x);
  const auto [y0, y1] = range(tile / grid.tiles_x, lookup_scale.y, planar_grid.tiles_y);
  return {x0, y0, x1, y1};
}

void size_target(const raster::TileGrid& grid, int levels, PlanarTarget& target) {
  const View& view = target.view.camera;
  const auto tiles = static_cast<std::size_t>(grid.count());
  // Up and down are to the sides of a camera that lies on its side.
  const bool is_upright = std::abs(view.up.z) >= std::abs(view.right.z);
  const auto axis = is_upright ? texture::BlurAxis::kY : texture::BlurAxis::kX;
  const bool same = target.image.width == view.width_px && target.image.height == view.height_px &&
                    target.written.size() == tiles && target.image.levels == levels &&
                    target.image.blur_axis == axis;
  if (!same) {
    texture::resize_image(view.width_px, view.height_px, target.image, levels, axis);
    target.written.assign(tiles, 0);
  }
  target.wanted.assign(tiles, 0);
  target.tile_rows.assign(static_cast<std::size_t>(grid.tiles_y) * columns_of(target.image), {});
}

const std::uint32_t* rows_of(const PlanarTarget& target) {
  return target.shown_rows.empty() ? nullptr : target.shown_rows.data();
}

void clear_tile(const Shading& s, int tile, texture::RgbaImage& image) {
  const raster::PixelBox box = raster::tile_box(s.viewport, s.grid, tile);
  for (int y = box.y0_px; y < box.y0_px + box.height_px; ++y) {
    const auto row = image.texels.begin() + static_cast<std::ptrdiff_t>(y) * image.stride;
    std::fill_n(row + box.x0_px, box.width_px, 0u);
  }
}

void draw_planar_tile(int tile, ThreadScratch& scratch, PlanarTarget& target) {
  const auto side = static_cast<std::size_t>(target.shading.grid.tile_size_px);
  const auto depth = std::span(scratch.depth).first(side * side);
  const auto primitive = std::span(scratch.primitive).first(side * side);
  const raster::Pass& pass = target.view.pass;
  int covered = -1;
  if (target.wanted[tile]) {
    if (raster::tile_has_triangles(pass, tile))
      covered = raster::draw_tile(pass, tile, depth, primitive);
    if (target.view.land)
      covered = cast_land(target.view, target.shading.grid, tile, covered < 0, depth, primitive);
    covered = draw_implicits(target.view.implicits,
                             raster::tile_box(target.shading.viewport, target.shading.grid, tile),
                             target.shading.grid.tile_size_px, covered, depth, primitive);
  }
  const bool drawn = covered > 0;
  if (drawn) {
    find_tile_rows(target.image, target.shading.grid, tile, primitive, target.tile_rows);
    shade_planar_tile(target.shading, tile, depth, primitive, scratch.shade, target.image);
  } else if (target.written[tile]) {
    clear_tile(target.shading, tile, target.image);
  }
  if (drawn || target.written[tile]) {
    const raster::PixelBox box =
        raster::tile_box(target.shading.viewport, target.shading.grid, tile);
    texture::soften_block(box.x0_px, box.y0_px, box.x0_px + box.width_px, box.y0_px + box.height_px,
                          target.image);
  }
  target.written[tile] = drawn;
}

void draw_planar_map(const Meshes& meshes, const MaterialInputs& inputs, int tile_size_px,
                     ScratchList scratch, PlanarTarget& target, const StageRun& run) {
  prepare_view_pass(meshes, tile_size_px, 0, target.view, run.workers);
  fill_shading(inputs, target.view, tile_size_px, target.shading);
  run.for_each(target.wanted.size(), [&](std::size_t tile, int thread) {
    draw_planar_tile(static_cast<int>(tile), *scratch[thread], target);
  });
  texture::fill_padding(target.image);
  find_shown_rows(target.image, target.tile_rows, target.shown_rows);
}

// Sizes a river's mirror and finds its tiles that water may look into; returns whether there are
// any. looks: the bit of LooksInto.
bool find_wanted(const RenderView& window, const VisibilityBuffer& visibility, std::uint8_t looks,
                 const MaterialInputs& inputs, PlanarTarget& mirror) {
  const raster::TileGrid grid =
      raster::tile_grid(mirror.view.viewport(), visibility.grid.tile_size_px);
  const glm::vec2 scale = scale_of(mirror.view.camera, window.camera);
  size_target(grid, inputs.without.has(Part::kImageBlur) ? 1 : texture::kMostRgbaLevels, mirror);
  bool any = false;
  for (int tile = 0; tile < visibility.grid.count(); ++tile) {
    if (!(visibility.looks_into[tile] & looks)) continue;
    const TileRange r = reachable_tiles(window.camera, visibility.grid, tile, scale, grid);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        mirror.wanted[static_cast<std::size_t>(y) * grid.tiles_x + x] = 1;
    any = true;
  }
  return any;
}

}  // namespace

View planar_camera(const View& window, double scale) {
  View view = window;
  const auto scaled = [&](int size) {
    return std::clamp(static_cast<int>(std::lround(size * scale)), 1, raster::kMaxViewport);
  };
  view.width_px = scaled(window.width_px);
  view.height_px = scaled(window.height_px);
  return view;
}

void draw_river_mirrors(const Meshes& meshes, const RenderView& window,
                        const VisibilityBuffer& visibility, ScratchList scratch,
                        MaterialInputs& inputs, RiverMirrors& mirrors, const StageRun& run) {
  mirrors.images.clear();
  if (inputs.without.has(Part::kReflection)) return;
  for (std::size_t k = 0; k < meshes.rivers.mirror_count; ++k) {
    PlanarTarget& target = mirrors.targets[k];
    const auto looks = static_cast<std::uint8_t>(kRiverMirror << k);
    if (!find_wanted(window, visibility, looks, inputs, target)) continue;
    draw_planar_map(meshes, inputs, visibility.grid.tile_size_px, scratch, target, run);
    const glm::vec2 scale = scale_of(target.view.camera, window.camera);
    const RiverMirror& level = meshes.rivers.mirror[k];
    mirrors.images.push_back(
        {{&target.image, scale.x, scale.y, rows_of(target)}, level.level_m, level.share});
  }
  inputs.river_images = mirrors.images;
}

void draw_planar_maps(const Meshes& meshes, const RenderView& window,
                      const VisibilityBuffer& visibility, ScratchList scratch,
                      MaterialInputs& inputs, PlanarMaps& images, const StageRun& run) {
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  images.of_tile.assign(tiles, {});
  const bool any = window.land || std::ranges::any_of(kAllSurfaces, [&](SurfaceKind s) {
                     return shows(ViewKind::kReflection, s) &&
                            !(draw_record(meshes, s, ViewKind::kReflection).indices.empty() &&
                              draw_record(meshes, s, ViewKind::kRefraction).indices.empty());
                   });
  if (!any || inputs.without.has(Part::kWater)) return;

  // Which tiles of the images water can look into.
  PlanarTarget &reflection = images.reflection, &refraction = images.refraction;
  const int tile_size_px = visibility.grid.tile_size_px;
  const View& camera = reflection.view.camera;
  const raster::TileGrid grid = raster::tile_grid(reflection.view.viewport(), tile_size_px);
  const glm::vec2 scale = scale_of(camera, window.camera);
  const int softer = inputs.without.has(Part::kImageBlur) ? 1 : texture::kMostRgbaLevels;
  size_target(grid, softer, reflection);
  size_target(grid, inputs.media.submerged ? softer : 1, refraction);  // from above it is sharp
  const auto for_reachable = [&](std::size_t tile, auto&& visit) {
    if (!(visibility.looks_into[tile] & (kSeaFloor | kSeaMirror))) return;
    const TileRange r =
        reachable_tiles(window.camera, visibility.grid, static_cast<int>(tile), scale, grid);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) visit(static_cast<std::size_t>(y) * grid.tiles_x + x);
  };
  const std::uint8_t mirrors = !inputs.without.has(Part::kReflection);
  const std::uint8_t refracts = !inputs.without.has(Part::kRefraction);
  for (std::size_t tile = 0; tile < tiles; ++tile)
    for_reachable(tile, [&](std::size_t t) {
      const std::uint8_t into = visibility.looks_into[tile];
      reflection.wanted[t] |= mirrors && into & kSeaMirror;
      refraction.wanted[t] |= refracts && into & kSeaFloor;
    });

  draw_planar_map(meshes, inputs, tile_size_px, scratch, reflection, run);
  draw_planar_map(meshes, inputs, tile_size_px, scratch, refraction, run);

  // What the window's tiles see of them.
  for (std::size_t tile = 0; tile < tiles; ++tile)
    for_reachable(tile, [&](std::size_t t) {
      images.of_tile[tile].reflection |= reflection.written[t] != 0;
      images.of_tile[tile].refraction |= refraction.written[t] != 0;
    });
  inputs.reflection = {&reflection.image, scale.x, scale.y, rows_of(reflection)};
  inputs.refraction = {&refraction.image, scale.x, scale.y, rows_of(refraction)};
}

}  // namespace swell::render
