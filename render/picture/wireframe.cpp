// Triangle edges over the finished picture, tinted by level of detail: to look at, not for speed.
#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/interpolate.h"
#include "render/frame/target.h"
#include "render/picture/shade_picture.h"

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

// None: what rays find has no triangles.
std::optional<Triangle> triangle_of(const RenderView& window, std::uint32_t primitive) {
  constexpr int kWhite = 7;
  for (const SurfaceKind kind : kAllSurfaces) {
    if (!window.primitives.holds(kind, primitive)) continue;
    const DrawRecord& record = window.draws[kind];
    const std::uint32_t n = primitive - window.primitives.begin(kind);
    if (record.is_cast || (!record.parts.empty() && record.part_of(n).is_cast)) break;
    const std::span<const glm::vec4> p_clip = window.vertices_of(kind).p_clip;
    const auto corner = [&](std::size_t k) {
      return p_clip[record.indices[std::size_t{3} * n + k]];
    };
    return Triangle{{corner(0), corner(1), corner(2)},
                    record.level.empty() ? kWhite : record.level[n]};
  }
  return std::nullopt;
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
      if (p != current) {
        current = p;
        interpolator.reset();
        if (const auto triangle = triangle_of(in.window, p)) {
          interpolator.emplace(triangle->p_clip, viewport);
          colour = level_colour(triangle->level);
        }
      }
      if (!interpolator) continue;
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
