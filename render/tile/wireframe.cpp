// Triangle edges over the finished picture, tinted by level of detail: to look at, not for speed.
#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/interpolate.h"
#include "render/tile/shade_picture.h"

namespace swell::render {
namespace {

constexpr float kLineWidth_px = 1.0f;

// Neighbouring levels get clearly different colours; R in the low byte.
std::uint32_t level_colour(int level) {
  constexpr std::uint32_t kColours[] = {0x3030ffu, 0x30a0ffu, 0x30ffffu, 0x40ff40u,
                                        0xffff40u, 0xff8040u, 0xff40c0u, 0xffffffu};
  return kColours[level % std::size(kColours)];
}

std::uint32_t blend(std::uint32_t under, std::uint32_t over, float amount) {
  std::uint32_t result = 0xff000000u;
  for (int shift = 0; shift < 24; shift += 8) {
    const auto a = static_cast<float>(under >> shift & 0xffu);
    const auto b = static_cast<float>(over >> shift & 0xffu);
    result |= static_cast<std::uint32_t>(a + amount * (b - a) + 0.5f) << shift;
  }
  return result;
}

// The triangle that a primitive number of the window's pass means.
struct Triangle {
  std::array<glm::vec4, 3> p_clip;
  int level;
};

Triangle triangle_at(std::span<const glm::vec4> p_clip, std::span<const std::uint32_t> indices,
                     std::size_t n, int level) {
  return {{p_clip[indices[3 * n]], p_clip[indices[3 * n + 1]], p_clip[indices[3 * n + 2]]}, level};
}

Triangle triangle_of(const PictureInputs& in, std::uint32_t primitive) {
  constexpr int kWhite = 7;
  const PrimitiveRanges& ranges = in.window.primitives;
  const Meshes& meshes = in.meshes;
  SurfaceKind kind = SurfaceKind::kWater;
  for (const SurfaceKind k : kAllSurfaces)
    if (ranges.holds(k, primitive)) kind = k;
  const std::size_t n = primitive - ranges.begin(kind);
  const int level = kind == SurfaceKind::kWater     ? meshes.water.mesh.level[n]
                    : kind == SurfaceKind::kTerrain ? meshes.land.mesh.level[n]
                                                    : kWhite;
  return triangle_at(in.window.vertices_of(kind).p_clip, meshes.indices(kind), n, level);
}

// An implicit surface has none, nor has land that is found by rays.
bool has_triangle(const PictureInputs& in, std::uint32_t primitive) {
  const PrimitiveRanges& ranges = in.window.primitives;
  if (ranges.holds(SurfaceKind::kTerrain, primitive)) return !in.window.land;
  if (!ranges.holds(SurfaceKind::kObjects, primitive)) return true;
  const std::uint32_t n = primitive - ranges.begin(SurfaceKind::kObjects);
  return !in.meshes.objects.in_window().primitives[n].object->implicit;
}

}  // namespace

void draw_wireframe(const PictureInputs& in, int tile, Target& target) {
  const VisibilityBuffer& visibility = in.visibility;
  const raster::Viewport viewport = in.window.viewport();
  const raster::PixelBox box = raster::tile_box(viewport, visibility.grid, tile);
  const std::span<const std::uint32_t> primitive = visibility.primitive_of(tile);
  std::uint32_t current = raster::kNoPrimitive;
  std::optional<raster::TriangleInterpolator> interpolator;
  std::uint32_t colour = 0;
  for (int y = 0; y < box.height_px; ++y) {
    for (int x = 0; x < box.width_px; ++x) {
      const std::uint32_t p =
          primitive[static_cast<std::size_t>(y) * visibility.grid.tile_size_px + x];
      if (p == raster::kNoPrimitive || !has_triangle(in, p)) continue;
      if (p != current) {
        const Triangle triangle = triangle_of(in, p);
        interpolator.emplace(triangle.p_clip, viewport);
        colour = level_colour(triangle.level);
        current = p;
      }
      const auto& edge = interpolator->at(box.x0_px + x, box.y0_px + y).edge_distance_px;
      const float nearest = std::min({std::abs(edge[0]), std::abs(edge[1]), std::abs(edge[2])});
      const float line = std::clamp(kLineWidth_px - nearest, 0.0f, 1.0f);
      std::uint32_t& pixel =
          target.rgba[static_cast<std::size_t>(box.y0_px + y) * target.width_px + box.x0_px + x];
      pixel = blend(pixel, colour, 0.15f + 0.65f * line);
    }
  }
}

}  // namespace swell::render
