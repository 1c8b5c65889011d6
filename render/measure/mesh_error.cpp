#include "render/measure/mesh_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "math/check.h"
#include "raster/pass.h"

namespace swell::render {
namespace {

constexpr double kLast_m = 32768.0;
constexpr int kRaysPerColumn = 2;
constexpr int kTileSize_px = 64;

glm::dvec4 to_clip(const View& view, glm::dvec3 p_world) {
  return glm::dmat4(view.clip_from_rel) * glm::dvec4(p_world - view.eye_world, 1.0);
}

glm::dvec2 to_window(const View& view, glm::dvec4 p_clip) {
  const glm::dvec2 ndc = glm::dvec2(p_clip) / p_clip.w;
  return {(0.5 + 0.5 * ndc.x) * view.width_px, (0.5 - 0.5 * ndc.y) * view.height_px};
}

// The part of an edge in front of the near plane, in the window.
struct WindowEdge {
  glm::dvec2 a, b;
};
std::optional<WindowEdge> edge_in_window(const View& view, glm::dvec4 a, glm::dvec4 b) {
  const double near_m = static_cast<double>(view.near_m);
  if (a.w < near_m && b.w < near_m) return std::nullopt;
  if (a.w < near_m) a += (b - a) * ((near_m - a.w) / (b.w - a.w));
  if (b.w < near_m) b += (a - b) * ((near_m - b.w) / (a.w - b.w));
  return WindowEdge{to_window(view, a), to_window(view, b)};
}

// Raises the line over the columns' middles that the edge passes to the edge.
void raise(const WindowEdge& edge, std::span<double> y_px) {
  const auto [a, b] = edge.a.x <= edge.b.x ? edge : WindowEdge{edge.b, edge.a};
  const double last = static_cast<double>(y_px.size()) - 1.0;
  const double from = std::max(std::ceil(a.x - 0.5), 0.0), to = std::min(b.x - 0.5, last);
  for (double column = from; column <= to; ++column) {
    const double t = b.x > a.x ? (column + 0.5 - a.x) / (b.x - a.x) : 0.0;
    double& top = y_px[static_cast<std::size_t>(column)];
    top = std::min(top, a.y + t * (b.y - a.y));
  }
}

// The point that hides all others along a level direction, and a point of the horizon.
struct Skyline {
  glm::dvec3 waves, flat;
};
Skyline skyline_along(const View& view, const ocean::WaterSurface& surface, glm::dvec2 direction) {
  constexpr std::size_t kChunk = 256;
  const glm::dvec2 eye(view.eye_world);
  const glm::dvec3 horizon(eye + kLast_m * direction, view.eye_world.z);
  Skyline result{horizon, horizon};
  double steepest = 0.0;
  std::array<glm::dvec2, kChunk> p;
  std::array<double, kChunk> distance_m;
  std::array<float, kChunk> height_m;
  for (double r = 1.0; r < kLast_m;) {
    std::size_t n = 0;
    for (; n < kChunk && r < kLast_m; ++n, r += std::max(0.25, r * 1e-3)) {
      distance_m[n] = r;
      p[n] = eye + r * direction;
    }
    surface.heights(std::span(p).first(n), std::span(height_m).first(n));
    for (std::size_t i = 0; i < n; ++i) {
      const double slope = (static_cast<double>(height_m[i]) - view.eye_world.z) / distance_m[i];
      if (slope <= steepest) continue;
      steepest = slope;
      result.waves = {p[i], height_m[i]};
    }
  }
  return result;
}

void find_skyline(const ocean::WaterSurface& surface, SeaReference& sea, Workers& workers) {
  // Rays through the columns, and one column more on either side.
  const View& view = sea.view;
  const glm::dvec2 right = glm::normalize(glm::dvec2(view.right));
  const glm::dvec2 ahead(-right.y, right.x);
  const int count = kRaysPerColumn * (view.width_px + 2) + 1;
  std::vector<Skyline> rays(static_cast<std::size_t>(count));
  workers.for_each(rays.size(), [&](std::size_t k, int) {
    const double x_px = static_cast<double>(k) / kRaysPerColumn - 1.0;
    const double across =
        (2.0 * x_px / view.width_px - 1.0) * static_cast<double>(view.tan_half_x) +
        static_cast<double>(view.tan_middle_x);
    // A pitched view has the horizon at a level view's distance times cos(pitch) along its axis.
    const double cos_pitch = glm::length(glm::dvec2(view.forward));
    rays[k] = skyline_along(view, surface, glm::normalize(ahead + right * (across * cos_pitch)));
  });

  const auto join = [&](glm::dvec3 Skyline::*point, std::vector<double>& y_px) {
    y_px.assign(static_cast<std::size_t>(view.width_px), static_cast<double>(view.height_px));
    for (std::size_t k = 0; k + 1 < rays.size(); ++k) {
      const auto edge =
          edge_in_window(view, to_clip(view, rays[k].*point), to_clip(view, rays[k + 1].*point));
      if (edge) raise(*edge, y_px);
    }
  };
  join(&Skyline::waves, sea.horizon_y_px);
  join(&Skyline::flat, sea.flat_y_px);
}

// Which triangle lies over each pixel's place on the mean level; kNoPrimitive: none.
std::vector<std::uint32_t> triangles_on_mean_level(const View& view,
                                                   std::span<const glm::dvec2> vertices,
                                                   const lod::Mesh& mesh, Workers& workers) {
  std::vector<glm::vec4> p_clip;
  p_clip.reserve(vertices.size());
  for (const glm::dvec2& v : vertices) p_clip.emplace_back(to_clip(view, {v, 0.0}));
  const raster::Draw draw{.p_clip = p_clip, .indices = mesh.indices};
  const raster::Viewport viewport{view.width_px, view.height_px};
  raster::Pass pass;
  raster::prepare_pass({&draw, 1}, viewport, kTileSize_px, pass, workers);

  std::vector<std::uint32_t> result(static_cast<std::size_t>(view.width_px) * view.height_px);
  std::vector<float> depth(kTileSize_px * kTileSize_px);
  std::vector<std::uint32_t> primitive(depth.size());
  const raster::TileGrid grid = raster::tile_grid(viewport, kTileSize_px);
  for (int tile = 0; tile < grid.count(); ++tile) {
    raster::draw_tile(pass, tile, depth, primitive);
    const raster::PixelBox box = raster::tile_box(viewport, grid, tile);
    for (int y = 0; y < box.height_px; ++y)
      std::copy_n(primitive.begin() + y * kTileSize_px, box.width_px,
                  result.begin() + std::ptrdiff_t{box.y0_px + y} * view.width_px + box.x0_px);
  }
  return result;
}

// The height at p of the plane through three points.
double height_at(const std::array<glm::dvec3, 3>& v, glm::dvec2 p) {
  const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
  return v[0].z - (n.x * (p.x - v[0].x) + n.y * (p.y - v[0].y)) / n.z;
}

}  // namespace

SeaReference look_at_sea(const View& view, const ocean::WaterSurface& surface,
                         const ocean::SeaArea& area, int pixel_step, Workers& workers) {
  SWELL_CHECK(view.eye_world.z > 0.0 && view.right.z == 0.0f, "eye z={} right z={}",
              view.eye_world.z, view.right.z);
  SWELL_CHECK(pixel_step >= 1, "pixel_step={}", pixel_step);
  const glm::dvec2 limits_m = area.limits_m();
  SeaReference sea;
  sea.view = view;
  for (int y = pixel_step / 2; y < view.height_px; y += pixel_step) {
    for (int x = pixel_step / 2; x < view.width_px; x += pixel_step) {
      const glm::dvec3 ray(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      if (ray.z >= 0.0) continue;
      const glm::dvec2 p(view.eye_world - ray * (view.eye_world.z / ray.z));
      const glm::dvec2 from_centre = glm::abs(p - area.centre_m);
      if (from_centre.x > 0.5 * limits_m.x || from_centre.y > 0.5 * limits_m.y) continue;
      sea.pixel.emplace_back(x, y);
      sea.p_world.push_back(p);
    }
  }
  sea.height_m.resize(sea.p_world.size());
  surface.heights(sea.p_world, sea.height_m);
  find_skyline(surface, sea, workers);
  return sea;
}

MeshError measure_mesh_error(const SeaReference& sea, const lod::Domain& domain,
                             const lod::Mesh& mesh, std::span<const float> height_m,
                             Workers& workers) {
  SWELL_CHECK(height_m.size() == mesh.lattice.size(), "{} heights, {} vertices", height_m.size(),
              mesh.lattice.size());
  const View& view = sea.view;
  std::vector<glm::dvec2> vertices;
  vertices.reserve(mesh.lattice.size());
  for (const glm::ivec2& p : mesh.lattice) vertices.push_back(domain.point(p));
  const auto corner = [&](std::size_t index) {
    const std::uint32_t v = mesh.indices[index];
    return glm::dvec3(vertices[v], height_m[v]);
  };

  // Heights.
  MeshError error;
  const std::vector<std::uint32_t> triangles =
      triangles_on_mean_level(view, vertices, mesh, workers);
  for (std::size_t i = 0; i < sea.p_world.size(); ++i) {
    const glm::ivec2 pixel = sea.pixel[i];
    const std::size_t t = triangles[static_cast<std::size_t>(pixel.y) * view.width_px + pixel.x];
    if (t == raster::kNoPrimitive) continue;
    const glm::dvec2 p = sea.p_world[i];
    const double z = height_at({corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)}, p);
    const glm::dvec4 drawn = to_clip(view, {p, z}), true_one = to_clip(view, {p, sea.height_m[i]});
    const double near_m = static_cast<double>(view.near_m);
    if (drawn.w < near_m || true_one.w < near_m) continue;
    error.height_px.push_back(glm::distance(to_window(view, drawn), to_window(view, true_one)));
  }

  // Silhouette.
  std::vector<double> top_px = sea.flat_y_px;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const glm::dvec4 a = to_clip(view, corner(i));
    const glm::dvec4 b = to_clip(view, corner(i % 3 == 2 ? i - 2 : i + 1));
    if (const auto edge = edge_in_window(view, a, b)) raise(*edge, top_px);
  }
  for (std::size_t column = 0; column < top_px.size(); ++column)
    error.silhouette_px.push_back(std::abs(top_px[column] - sea.horizon_y_px[column]));
  return error;
}

}  // namespace swell::render
