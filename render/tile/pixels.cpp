// Stages 4 to 7: what is visible, what water can look into, the colour of every pixel.
#include <algorithm>
#include <array>
#include <cmath>

#include "render/workspace.h"

namespace swell::render {
namespace {

raster::Draw draw_of(const Surface& surface, std::span<const glm::vec4> p_clip,
                     std::uint32_t first_primitive) {
  raster::Draw draw;
  draw.p_clip = p_clip;
  draw.indices = surface.mesh.indices;
  draw.first_primitive = first_primitive;
  return draw;
}

raster::Draw draw_of(const ObjectGeometry& objects, std::span<const glm::vec4> p_clip,
                     std::uint32_t first_primitive) {
  raster::Draw draw;
  draw.p_clip = p_clip;
  draw.indices = objects.indices;
  draw.first_primitive = first_primitive;
  return draw;
}

void find_visible_in_tile(const Frame& frame, int tile) {
  VisibilityBuffer& visibility = frame.ws.visibility;
  visibility.covered[tile] = -1;
  visibility.has_water[tile] = 0;
  if (!raster::tile_has_triangles(frame.ws.pass, tile)) return;
  const std::span<std::uint32_t> primitive = visibility.primitive_of(tile);
  visibility.covered[tile] =
      raster::draw_tile(frame.ws.pass, tile, visibility.depth_of(tile), primitive);
  const std::uint32_t water = water_triangles(frame);
  bool any = false;
  for (const std::uint32_t p : primitive) any |= p < water;
  visibility.has_water[tile] = any;
}

// The tiles of a lookup image that a window tile's water can look into.
struct TileRange {
  int x0, y0, x1, y1;  // half open
};

TileRange reachable_tiles(const Frame& frame, int tile, const View& lookup_view,
                          const raster::TileGrid& lookup_grid) {
  const raster::TileGrid& grid = frame.ws.visibility.grid;
  const float bound = frame.ws.context.max_distortion_px;
  const float scale_x =
      static_cast<float>(lookup_view.width_px) / static_cast<float>(frame.view.width_px);
  const float scale_y =
      static_cast<float>(lookup_view.height_px) / static_cast<float>(frame.view.height_px);
  // A bilinear sample reads one texel further each way.
  const auto range = [&](int index, float scale, int tiles) {
    const auto low = static_cast<float>(index * grid.tile_size_px) - bound;
    const float high = static_cast<float>((index + 1) * grid.tile_size_px) + bound;
    const auto size = static_cast<float>(lookup_grid.tile_size_px);
    return std::pair{
        std::clamp(static_cast<int>(std::floor((low * scale - 2.0f) / size)), 0, tiles - 1),
        std::clamp(static_cast<int>(std::floor((high * scale + 2.0f) / size)), 0, tiles - 1) + 1};
  };
  const auto [x0, x1] = range(tile % grid.tiles_x, scale_x, lookup_grid.tiles_x);
  const auto [y0, y1] = range(tile / grid.tiles_x, scale_y, lookup_grid.tiles_y);
  return {x0, y0, x1, y1};
}

View lookup_view(const Frame& frame) {
  View view = frame.view;
  const auto scaled = [&](int size) {
    return std::clamp(static_cast<int>(std::lround(size * frame.options.lookup_scale)), 1,
                      raster::kMaxViewport);
  };
  view.width_px = scaled(frame.view.width_px);
  view.height_px = scaled(frame.view.height_px);
  return view;
}

void size_lookup(const View& view, const raster::TileGrid& grid, LookupTarget& target) {
  const auto tiles = static_cast<std::size_t>(grid.count());
  const bool same = target.image.width == view.width_px && target.image.height == view.height_px &&
                    target.written.size() == tiles;
  if (!same) {
    texture::resize_image(view.width_px, view.height_px, target.image);
    target.written.assign(tiles, 0);
  }
  target.wanted.assign(tiles, 0);
}

void clear_tile(const ShadeContext& c, int tile, texture::RgbaImage& image) {
  const raster::PixelBox box = raster::tile_box(c.viewport, c.grid, tile);
  for (int y = box.y0_px; y < box.y0_px + box.height_px; ++y) {
    const auto row = image.texels.begin() + static_cast<std::ptrdiff_t>(y) * image.stride;
    std::fill_n(row + box.x0_px, box.width_px, 0u);
  }
}

void draw_lookup_tile(const Frame& frame, int tile, ThreadScratch& scratch, LookupTarget& target) {
  const std::size_t pixels = frame.ws.visibility.tile_pixels();
  const auto depth = std::span(scratch.depth).first(pixels);
  const auto primitive = std::span(scratch.primitive).first(pixels);
  const bool drawn = target.wanted[tile] && raster::tile_has_triangles(target.pass, tile) &&
                     raster::draw_tile(target.pass, tile, depth, primitive) > 0;
  if (drawn) {
    shade_lookup_tile(target.context, tile, depth, primitive, scratch.shade, target.image);
  } else if (target.written[tile]) {
    clear_tile(target.context, tile, target.image);
  }
  target.written[tile] = drawn;
}

void draw_lookup_image(Frame& frame, const View& view, ViewKind kind, LookupTarget& target) {
  const ObjectGeometry& objects = frame.ws.objects;
  const bool mirrored = kind == ViewKind::kReflection;
  std::array<raster::Draw, 2> draws;
  std::size_t draw_count = 0;
  if (frame.world.terrain) {
    draws[draw_count] = draw_of(frame.ws.land, target.p_clip, 0);
    draws[draw_count++].clip_distance = target.clip_distance;
  }
  draws[draw_count] =
      draw_of(objects, mirrored ? objects.mirrored : objects.squeezed, land_triangles(frame));
  draws[draw_count++].clip_distance = mirrored ? objects.above_water : objects.below_water;
  raster::prepare_pass(std::span(draws).first(draw_count), {view.width_px, view.height_px},
                       frame.options.tile_size_px, target.pass, frame.workers);
  fill_shade_context(frame, view, kind, target.context);
  frame.workers.for_each(target.wanted.size(), [&](std::size_t tile, int slot) {
    const WorkScope work(frame.ws.profile, Stage::kLookups, slot);
    draw_lookup_tile(frame, static_cast<int>(tile), *frame.ws.scratch[slot], target);
  });
  texture::fill_padding(target.image);
}

}  // namespace

std::uint32_t water_triangles(const Frame& frame) {
  return static_cast<std::uint32_t>(frame.ws.water.mesh.indices.size() / 3);
}

std::uint32_t land_triangles(const Frame& frame) {
  if (!frame.world.terrain) return 0;
  return static_cast<std::uint32_t>(frame.ws.land.mesh.indices.size() / 3);
}

void find_visible(Frame& frame) {
  Workspace::State& ws = frame.ws;
  const std::uint32_t water = water_triangles(frame);
  std::array<raster::Draw, 3> draws = {draw_of(ws.water, ws.water.p_clip, 0)};
  std::size_t draw_count = 1;
  if (frame.world.terrain) draws[draw_count++] = draw_of(ws.land, ws.land.p_clip, water);
  draws[draw_count++] = draw_of(ws.objects, ws.objects.p_clip, water + land_triangles(frame));
  raster::prepare_pass(std::span(draws).first(draw_count), frame.viewport(),
                       frame.options.tile_size_px, ws.pass, frame.workers);

  VisibilityBuffer& visibility = ws.visibility;
  visibility.grid = raster::tile_grid(frame.viewport(), frame.options.tile_size_px);
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  visibility.depth.resize(tiles * visibility.tile_pixels());
  visibility.primitive.resize(tiles * visibility.tile_pixels());
  visibility.covered.resize(tiles);
  visibility.has_water.resize(tiles);
  frame.workers.for_each(tiles, [&](std::size_t tile, int slot) {
    const WorkScope work(ws.profile, Stage::kVisibility, slot);
    find_visible_in_tile(frame, static_cast<int>(tile));
  });
}

void draw_lookup_images(Frame& frame) {
  Workspace::State& ws = frame.ws;
  fill_shade_context(frame, frame.view, ViewKind::kWindow, ws.context);
  const auto tiles = static_cast<std::size_t>(ws.visibility.grid.count());
  ws.tile_lookups.assign(tiles, {});
  if (!frame.world.terrain && ws.objects.primitives.empty()) return;

  const View view = lookup_view(frame);
  const raster::TileGrid grid =
      raster::tile_grid({view.width_px, view.height_px}, frame.options.tile_size_px);
  size_lookup(view, grid, ws.reflection);
  size_lookup(view, grid, ws.refraction);
  const auto for_reachable = [&](std::size_t tile, auto&& visit) {
    if (!ws.visibility.has_water[tile]) return;
    const TileRange r = reachable_tiles(frame, static_cast<int>(tile), view, grid);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) visit(static_cast<std::size_t>(y) * grid.tiles_x + x);
  };
  for (std::size_t tile = 0; tile < tiles; ++tile)
    for_reachable(tile,
                  [&](std::size_t t) { ws.reflection.wanted[t] = ws.refraction.wanted[t] = 1; });

  draw_lookup_image(frame, view, ViewKind::kReflection, ws.reflection);
  draw_lookup_image(frame, view, ViewKind::kRefraction, ws.refraction);

  for (std::size_t tile = 0; tile < tiles; ++tile)
    for_reachable(tile, [&](std::size_t t) {
      ws.tile_lookups[tile].reflection |= ws.reflection.written[t] != 0;
      ws.tile_lookups[tile].refraction |= ws.refraction.written[t] != 0;
    });
  const auto lookup_of = [&](const LookupTarget& target) {
    return LookupImage{
        &target.image, static_cast<float>(view.width_px) / static_cast<float>(frame.view.width_px),
        static_cast<float>(view.height_px) / static_cast<float>(frame.view.height_px)};
  };
  ws.context.reflection = lookup_of(ws.reflection);
  ws.context.refraction = lookup_of(ws.refraction);
}

void shade_pixels(Frame& frame, Target& target) {
  Workspace::State& ws = frame.ws;
  VisibilityBuffer& visibility = ws.visibility;
  const auto tiles = static_cast<std::size_t>(visibility.grid.count());
  ws.shaded.assign(tiles, 0);
  frame.workers.for_each(tiles, [&](std::size_t index, int slot) {
    const WorkScope work(ws.profile, Stage::kShade, slot);
    const auto tile = static_cast<int>(index);
    ShadeScratch& scratch = ws.scratch[slot]->shade;
    if (visibility.covered[tile] <= 0)
      shade_sky_tile(ws.context, tile, scratch, target.rgba, target.linear);
    else
      ws.shaded[index] =
          shade_tile(ws.context, tile, visibility.depth_of(tile), visibility.primitive_of(tile),
                     ws.tile_lookups[index], scratch, target.rgba, target.linear);
    if (frame.options.wireframe && visibility.covered[tile] > 0)
      draw_wireframe(frame, tile, target);
  });
}

}  // namespace swell::render
