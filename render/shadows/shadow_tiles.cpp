#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "render/shadows/object_shadows.h"
#include "render/shadows/shadow_reach.h"
#include "render/view/render_view.h"
#include "render/view/surfaces.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// A part of the window, in pixels.
struct WindowBox {
  glm::vec2 low{kInfinity<float>}, high{-kInfinity<float>};
  bool all = false;  // of the window
};

void add_flat_point(const View& camera, glm::vec3 p_rel, WindowBox& box) {
  const glm::vec4 clip = camera.clip_from_rel * glm::vec4(p_rel, 1.0f);
  if (clip.w <= camera.near_m) {
    box.all = true;
    return;
  }
  const glm::vec2 ndc(clip.x / clip.w, -clip.y / clip.w);
  const glm::vec2 size(camera.width_px, camera.height_px);
  const glm::vec2 at = (0.5f * ndc + 0.5f) * size;
  box.low = glm::min(box.low, at);
  box.high = glm::max(box.high, at);
}

// Wherever between p_rel and drop_m below it a point is drawn.
void add_point(const View& camera, glm::vec3 p_rel, float drop_m, WindowBox& box) {
  add_flat_point(camera, p_rel, box);
  add_flat_point(camera, p_rel - glm::vec3(0.0f, 0.0f, drop_m), box);
}

// The corners of a box around all that light may reach below the water, where it goes on aside by
// `slant` a metre of depth.
std::array<glm::vec3, 8> reached_below(const Corners& corners, glm::vec2 slant, float level,
                                       float wave_m) {
  glm::vec3 low(kInfinity<float>), high(-kInfinity<float>);
  for (int i = 0; i < corners.count; ++i)
    low = glm::min(low, corners.p[i]), high = glm::max(high, corners.p[i]);
  const glm::vec3 way(-(kDeepestShadow_m + wave_m) * slant, 0.0f);
  const glm::vec3 deepest(low.x, low.y, std::min(low.z, level - kDeepestShadow_m));
  low = glm::min(deepest, deepest + way);
  high = glm::max(glm::vec3(high.x, high.y, std::max(high.z, level + wave_m)), high + way);
  std::array<glm::vec3, 8> box;
  for (int i = 0; i < 8; ++i)
    box[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
  return box;
}

// Where a view shows what lies between the corners. In a mirror or under water things appear
// between heights that bound map_point()'s, whose level is that of the sea or of any hull.
WindowBox window_box(const Corners& corners, const LightInWater& light, const RenderView& view,
                     float lowest_rel_m) {
  WindowBox box;
  box.all = light.eye_submerged;
  const float drop_m = most_drop_m(corners, view.drop_per_m2);
  const float level = -static_cast<float>(view.camera.eye_world.z), wave_m = level - lowest_rel_m;
  if (view.kind == ViewKind::kRefraction) {
    for (const glm::vec3& p : reached_below(corners, light.slant, level, wave_m))
      add_point(view.camera, p, drop_m, box);
    return box;
  }
  for (int i = 0; i < corners.count && !box.all; ++i) {
    const glm::vec3 p = corners.p[i];
    if (view.kind == ViewKind::kWindow) {
      add_point(view.camera, p, drop_m, box);
      continue;
    }
    for (const float by : {-2.0f * wave_m, 2.0f * wave_m})
      add_point(view.camera, {p.x, p.y, 2.0f * level - p.z + by}, drop_m, box);
  }
  return box;
}

// A pixel or two wider: shadows are as soft as a pixel at least.
PixelSpan pixels_of(const WindowBox& box) {
  if (box.all) return {-kInfinity<float>, -kInfinity<float>, kInfinity<float>, kInfinity<float>};
  return {box.low.x - 2.0f, box.low.y - 2.0f, box.high.x + 2.0f, box.high.y + 2.0f};
}

TileSpan tiles_of(const PixelSpan& pixels, const raster::TileGrid& grid) {
  const auto tile = [&](float px, int tiles) {
    const float at = px / static_cast<float>(grid.tile_size_px);
    return static_cast<int>(std::clamp(std::floor(at), -1.0f, static_cast<float>(tiles)));
  };
  return {std::max(tile(pixels.x0, grid.tiles_x), 0), std::max(tile(pixels.y0, grid.tiles_y), 0),
          std::min(tile(pixels.x1, grid.tiles_x) + 1, grid.tiles_x),
          std::min(tile(pixels.y1, grid.tiles_y) + 1, grid.tiles_y)};
}

}  // namespace

void list_casters(const ObjectShadows& shadows, const LightInWater& light, const RenderView& view,
                  const raster::TileGrid& grid, TileCasters& of_tile) {
  of_tile.first.clear();
  of_tile.caster.clear();
  if (shadows.casters.empty() || view.primitives.count() == 0) return;
  of_tile.first.assign(static_cast<std::size_t>(grid.count()) + 1, 0);
  of_tile.pixels.clear();
  of_tile.sea_pixels.clear();
  of_tile.tiles.clear();
  for (const ShadowCaster& caster : shadows.casters) {
    const auto shown = [&](const Corners& corners) {
      return pixels_of(window_box(corners, light, view, shadows.lowest_rel_m));
    };
    of_tile.pixels.push_back(shown(corners_of(caster, shadows)));
    of_tile.sea_pixels.push_back(shown(corners_of(caster, shadows, shadows.sea_below_rel_m)));
    of_tile.tiles.push_back(tiles_of(of_tile.pixels.back(), grid));
  }
  const auto for_tiles = [&](const TileSpan& box, auto&& visit) {
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) visit(static_cast<std::size_t>(y) * grid.tiles_x + x);
  };
  // Counts, then places: in order of the casters' numbers.
  for (const TileSpan& box : of_tile.tiles)
    for_tiles(box, [&](std::size_t tile) { ++of_tile.first[tile + 1]; });
  for (std::size_t i = 1; i < of_tile.first.size(); ++i) of_tile.first[i] += of_tile.first[i - 1];
  of_tile.caster.resize(of_tile.first.back());
  for (std::size_t i = 0; i < shadows.casters.size(); ++i)
    for_tiles(of_tile.tiles[i], [&](std::size_t tile) {
      of_tile.caster[of_tile.first[tile]++] = static_cast<std::uint16_t>(i);
    });
  for (std::size_t i = of_tile.first.size() - 1; i > 0; --i)
    of_tile.first[i] = of_tile.first[i - 1];
  of_tile.first[0] = 0;
}

}  // namespace swell::render
