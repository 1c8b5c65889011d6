#include "scene/water_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "ocean/coast_velocity.h"
#include "scene/check_scene.h"
#include "scene/coast.h"

namespace swell::scene {
namespace {

constexpr std::size_t kChunk = 256;  // points whose ground is on the stack
constexpr double kShareStep_m = 0.25;

// Calls body(first, count) for pieces of at most kChunk points.
template <class Body>
void in_chunks(std::size_t points, Body body) {
  for (std::size_t first = 0; first < points; first += kChunk)
    body(first, std::min(kChunk, points - first));
}

// The sea's and the trains' own, and what the fading adds: the edge rises by 1.5 over a tenth of
// the area, shallow water (on sand of slope 1) by 1 over the height of the waves, the sea makes
// room for the trains.
double slope_bound(const ocean::Sea& sea, const SeaArea& area, const Terrain* terrain,
                   const ocean::CoastSea* coast) {
  const double sea_m = sea.height_bound_m();
  const double all_m = sea_m + (coast ? static_cast<double>(coast->trains.height_bound_m) : 0.0);
  const double edge = 2.0 * all_m * 1.5 / (0.1 * std::min(area.size_m.x, area.size_m.y));
  const double shallow = terrain ? sea_m / (0.2 + sea.significant_height_m()) : 0.0;
  const double own = sea.slope_bound() + edge + shallow;
  if (!coast) return own;
  return own + static_cast<double>(coast->slope_bound()) +
         static_cast<double>(coast->share_slope_per_m) * sea_m;
}

// The part of the ray between the planes z = -bound and z = bound, empty if first > last.
struct Range {
  double first_m, last_m;
};
Range clip_to_slab(double z, double dz, double bound_m, double max_distance_m) {
  if (dz == 0.0) return {0.0, std::abs(z) <= bound_m ? max_distance_m : -1.0};
  const double a = (-bound_m - z) / dz, b = (bound_m - z) / dz;
  return {std::max(0.0, std::min(a, b)), std::min(max_distance_m, std::max(a, b))};
}

}  // namespace

WaterSurface::WaterSurface(const ocean::Sea& sea, const ocean::SeaFrame& frame, const SeaArea& area,
                           const Terrain* terrain, const ocean::CoastSea* coast)
    : frame_(&frame),
      area_(&area),
      terrain_(terrain),
      coast_(coast),
      wave_height_m_(static_cast<float>(sea.significant_height_m())),
      bound_m_(static_cast<float>(sea.height_bound_m()) +
               (coast ? coast->trains.height_bound_m : 0.0f)),
      steepest_(slope_bound(sea, area, terrain, coast)) {}

// 1 inside the area, falling to 0 over its last tenth.
float WaterSurface::edge(glm::dvec2 p_world) const {
  const glm::dvec2 inside = 0.5 * area_->size_m - glm::abs(p_world - area_->centre_m);
  const glm::dvec2 rim = 0.1 * area_->size_m;
  if (inside.x >= rim.x && inside.y >= rim.y) return 1.0f;
  const glm::dvec2 t = glm::clamp(inside / rim, 0.0, 1.0);
  return static_cast<float>(t.x * t.x * (3.0 - 2.0 * t.x) * t.y * t.y * (3.0 - 2.0 * t.y));
}

// How much of the sea's own waves' height a place shows.
float WaterSurface::share(glm::dvec2 p_world, float ground_m) const {
  if (!terrain_) return edge(p_world);
  const float depth = std::max(-ground_m, 0.0f);
  return edge(p_world) * std::min(1.0f, depth / (0.2f + wave_height_m_));
}

float WaterSurface::share_at(glm::dvec2 p_world) const {
  float result = 0.0f;
  shares({&p_world, 1}, {&result, 1});
  return result;
}

// At most kChunk points.
void WaterSurface::shares(std::span<const glm::dvec2> p_world, std::span<float> result) const {
  std::array<float, kChunk> ground{};
  if (terrain_) sample_heights(*terrain_, p_world, std::span(ground).first(p_world.size()));
  for (std::size_t i = 0; i < p_world.size(); ++i) result[i] = share(p_world[i], ground[i]);
  if (!coast_) return;
  std::array<float, kChunk> trains;
  ocean::sample_coast_share(*coast_, p_world, std::span(trains).first(p_world.size()));
  for (std::size_t i = 0; i < p_world.size(); ++i) result[i] *= ocean::spectrum_weight(trains[i]);
}

// At most kChunk points. The trains' heights, and `factor` of all other waves times what the trains
// leave of them.
void WaterSurface::coast_heights(std::span<const glm::dvec2> p_world, std::span<float> height_m,
                                 std::span<float> factor) const {
  std::array<float, kChunk> shares_of_trains;
  const auto share = std::span(shares_of_trains).first(p_world.size());
  ocean::sample_coast(*coast_, frame_->t_s, p_world, height_m, share);
  for (std::size_t i = 0; i < p_world.size(); ++i) {
    height_m[i] *= edge(p_world[i]);
    factor[i] *= ocean::spectrum_weight(share[i]);
  }
}

// By differences: the trains' height with its share and edge.
glm::vec2 WaterSurface::coast_slope(glm::dvec2 p) const {
  constexpr double kStep_m = 0.05;
  const std::array<glm::dvec2, 4> at = {
      p + glm::dvec2(0.5 * kStep_m, 0.0), p - glm::dvec2(0.5 * kStep_m, 0.0),
      p + glm::dvec2(0.0, 0.5 * kStep_m), p - glm::dvec2(0.0, 0.5 * kStep_m)};
  std::array<float, 4> z, unused{};
  coast_heights(at, z, unused);
  return glm::vec2(z[0] - z[1], z[2] - z[3]) / static_cast<float>(kStep_m);
}

glm::vec2 WaterSurface::share_slope(glm::dvec2 p) const {
  const glm::dvec2 dx(0.5 * kShareStep_m, 0.0), dy(0.0, 0.5 * kShareStep_m);
  const glm::vec2 difference(share_at(p + dx) - share_at(p - dx),
                             share_at(p + dy) - share_at(p - dy));
  return difference / static_cast<float>(kShareStep_m);
}

void WaterSurface::heights(std::span<const glm::dvec2> p_world, std::span<float> height_m,
                           std::size_t longest_patches) const {
  SWELL_CHECK(p_world.size() == height_m.size(), "{} points, {} heights", p_world.size(),
              height_m.size());
  in_chunks(p_world.size(), [&](std::size_t first, std::size_t count) {
    const auto p = p_world.subspan(first, count);
    const auto z = height_m.subspan(first, count);
    std::array<float, kChunk> factor, ground{};
    if (terrain_) sample_heights(*terrain_, p, std::span(ground).first(count));
    for (std::size_t i = 0; i < count; ++i) factor[i] = share(p[i], ground[i]);
    std::ranges::fill(z, 0.0f);
    if (coast_) coast_heights(p, z, factor);
    add_sea(p, factor, longest_patches, z);
  });
}

// At most kChunk points. The sea's own waves times a factor; places where that is 0 cost nothing.
void WaterSurface::add_sea(std::span<const glm::dvec2> p_world, std::span<const float> factor,
                           std::size_t longest_patches, std::span<float> height_m) const {
  std::array<glm::dvec2, kChunk> shown;
  std::array<std::size_t, kChunk> place;
  std::size_t count = 0;
  for (std::size_t i = 0; i < p_world.size(); ++i) {
    if (factor[i] == 0.0f) continue;
    shown[count] = p_world[i];
    place[count++] = i;
  }
  std::array<float, kChunk> z;
  ocean::sample_heights(*frame_, std::span(shown).first(count), std::span(z).first(count),
                        longest_patches);
  for (std::size_t k = 0; k < count; ++k) height_m[place[k]] += z[k] * factor[place[k]];
}

float WaterSurface::height(glm::dvec2 p_world) const {
  float result = 0.0f;
  heights({&p_world, 1}, {&result, 1});
  return result;
}

void WaterSurface::slopes(std::span<const glm::dvec2> p_world, std::span<glm::vec2> slope) const {
  SWELL_CHECK(p_world.size() == slope.size(), "{} points, {} slopes", p_world.size(), slope.size());
  in_chunks(p_world.size(), [&](std::size_t first, std::size_t count) {
    const auto p = p_world.subspan(first, count);
    std::array<float, kChunk> x, y, height, factor;
    ocean::sample_slopes(*frame_, p, std::span(x).first(count), std::span(y).first(count));
    ocean::sample_heights(*frame_, p, std::span(height).first(count));
    shares(p, factor);
    for (std::size_t i = 0; i < count; ++i) {
      slope[first + i] = factor[i] * glm::vec2(x[i], y[i]);
      if (factor[i] != 1.0f) slope[first + i] += height[i] * share_slope(p[i]);
      if (coast_) slope[first + i] += coast_slope(p[i]);
    }
  });
}

void WaterSurface::normals(std::span<const glm::dvec2> p_world, std::span<glm::vec3> normal) const {
  SWELL_CHECK(p_world.size() == normal.size(), "{} points, {} normals", p_world.size(),
              normal.size());
  in_chunks(p_world.size(), [&](std::size_t first, std::size_t count) {
    std::array<glm::vec2, kChunk> slope;
    slopes(p_world.subspan(first, count), std::span(slope).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 up(-slope[i], 1.0f);
      normal[first + i] = up / std::sqrt(up.x * up.x + up.y * up.y + 1.0f);
    }
  });
}

void WaterSurface::velocities(std::span<const glm::dvec2> p_world,
                              const ocean::VelocityFrame& velocity,
                              std::span<glm::vec3> velocity_mps) const {
  SWELL_CHECK(velocity.z.t_s == frame_->t_s, "t_s={}, velocity of {}", frame_->t_s, velocity.z.t_s);
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  ocean::sample_velocities(velocity, p_world, velocity_mps);
  in_chunks(p_world.size(), [&](std::size_t first, std::size_t count) {
    std::array<float, kChunk> factor;
    shares(p_world.subspan(first, count), factor);
    for (std::size_t i = 0; i < count; ++i) velocity_mps[first + i] *= factor[i];
    if (!coast_) return;
    std::array<glm::vec3, kChunk> trains;
    const auto p = p_world.subspan(first, count);
    ocean::sample_coast_velocities(*coast_, frame_->t_s, p, std::span(trains).first(count));
    for (std::size_t i = 0; i < count; ++i) velocity_mps[first + i] += edge(p[i]) * trains[i];
  });
}

bool WaterSurface::in_water(glm::dvec3 p_world) const {
  const glm::dvec2 p(p_world);
  if (!(p_world.z <= height(p))) return false;
  float ground_m = -HUGE_VALF;
  if (terrain_) sample_heights(*terrain_, {&p, 1}, {&ground_m, 1});
  return p_world.z > ground_m;
}

std::optional<WaterHit> WaterSurface::intersect(glm::dvec3 origin_world, glm::dvec3 direction,
                                                double max_distance_m) const {
  const double length = glm::length(direction);
  SWELL_CHECK(std::isfinite(origin_world.x + origin_world.y + origin_world.z), "origin={},{},{}",
              origin_world.x, origin_world.y, origin_world.z);
  SWELL_CHECK(std::isfinite(length) && length > 0.0, "direction={},{},{}", direction.x, direction.y,
              direction.z);
  const glm::dvec3 along = direction / length;
  const auto height_above = [&](double s) {
    const glm::dvec3 p = origin_world + s * along;
    return p.z - static_cast<double>(height(glm::dvec2(p)));
  };
  // Outside the slab that holds the surface nothing can be hit.
  const double slab_m = static_cast<double>(bound_m_) + 1e-3;
  const Range range = clip_to_slab(origin_world.z, along.z, slab_m, max_distance_m);
  if (!(range.first_m <= range.last_m)) return std::nullopt;

  // March: the gap closes by at most `closing` a metre.
  const double closing = std::abs(along.z) + steepest_ * glm::length(glm::dvec2(along));
  double near_m = range.first_m;
  const double gap0 = height_above(near_m);
  const bool from_above = gap0 > 0.0;
  double gap = gap0, far_m = near_m;
  while ((gap > 0.0) == from_above) {
    if (far_m >= range.last_m) return std::nullopt;
    near_m = far_m;
    far_m =
        std::min(range.last_m, near_m + std::max(std::abs(gap) / closing, 0.02 + 2e-4 * near_m));
    gap = height_above(far_m);
  }

  // Bisect: the start is on one side, the end on the other.
  while (far_m - near_m > 1e-7) {
    const double middle = 0.5 * (near_m + far_m);
    if (middle <= near_m || middle >= far_m) break;  // no number between them
    ((height_above(middle) > 0.0) == from_above ? near_m : far_m) = middle;
  }
  const glm::dvec3 p = origin_world + far_m * along;
  return WaterHit{far_m, p, from_above};
}

namespace {

const Scene& checked(const Scene& scene) {
  check_scene(scene);
  return scene;
}

}  // namespace

Water::Water(const Scene& scene) : sea_(checked(scene).sea), area_(scene.area) {
  if (scene.terrain) terrain_ = build_terrain(*scene.terrain);
  coast_ = build_coast(scene, terrain());
}

WaterSurface Water::at(double t_s, ocean::SeaFrame& frame, Workers& workers) const {
  ocean::advance(sea_, t_s, frame, workers);
  return {sea_, frame, area_, terrain(), coast()};
}

}  // namespace swell::scene
