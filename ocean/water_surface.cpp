#include "ocean/water_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/with_ieee.h"
#include "ocean/coast/coast_map.h"
#include "ocean/coast/foam_lace.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/point_chunk.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

// The part of the ray between the planes z = low and z = high, empty if first > last.
struct Range {
  double first_m, last_m;
};
Range clip_to_slab(double z, double dz, double low_m, double high_m, double max_distance_m) {
  if (dz == 0.0) return {0.0, z >= low_m && z <= high_m ? max_distance_m : -1.0};
  const double a = (low_m - z) / dz, b = (high_m - z) / dz;
  return {std::max(0.0, std::min(a, b)), std::min(max_distance_m, std::max(a, b))};
}

std::optional<WaterHit> find_hit(const WaterSurface& surface, glm::dvec3 origin_world,
                                 glm::dvec3 direction, double max_distance_m) {
  const double length = glm::length(direction);
  SWELL_CHECK(std::isfinite(origin_world.x + origin_world.y + origin_world.z), "origin={},{},{}",
              origin_world.x, origin_world.y, origin_world.z);
  SWELL_CHECK(std::isfinite(length) && length > 0.0, "direction={},{},{}", direction.x, direction.y,
              direction.z);
  const glm::dvec3 along = direction / length;
  const auto height_above = [&](double s) {
    const glm::dvec3 p = origin_world + s * along;
    return p.z - static_cast<double>(surface.height(glm::dvec2(p)));
  };
  // Outside the slab that holds the surface nothing can be hit.
  const double low_m = -static_cast<double>(surface.bounds().height_m) - 1e-3;
  const double high_m = static_cast<double>(surface.bounds().highest_m) + 1e-3;
  const Range range = clip_to_slab(origin_world.z, along.z, low_m, high_m, max_distance_m);
  if (!(range.first_m <= range.last_m)) return std::nullopt;

  // March: the gap closes by at most `closing` a metre.
  const double closing =
      std::abs(along.z) + surface.bounds().steepest * glm::length(glm::dvec2(along));
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

}  // namespace

WaterSurface::WaterSurface(const WaterParts& parts, const SeaFrame& frame)
    : water_(parts), frame_(&frame) {}

void WaterSurface::heights(std::span<const glm::dvec2> p_world, std::span<float> height_m,
                           std::size_t longest_patches) const {
  const ScopedFloatEnvironment ieee;
  water_.heights(*frame_, p_world, height_m, longest_patches);
}

float WaterSurface::height(glm::dvec2 p_world) const {
  float result = 0.0f;
  heights({&p_world, 1}, {&result, 1});
  return result;
}

void WaterSurface::slopes(std::span<const glm::dvec2> p_world, std::span<glm::vec2> slope) const {
  const ScopedFloatEnvironment ieee;
  water_.slopes(*frame_, p_world, slope);
}

void WaterSurface::normals(std::span<const glm::dvec2> p_world, std::span<glm::vec3> normal) const {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(p_world.size() == normal.size(), "{} points, {} normals", p_world.size(),
              normal.size());
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const std::size_t count = std::min(kPointChunk, p_world.size() - first);
    std::array<glm::vec2, kPointChunk> slope;
    slopes(p_world.subspan(first, count), std::span(slope).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 up(-slope[i], 1.0f);
      normal[first + i] = up / std::sqrt(up.x * up.x + up.y * up.y + 1.0f);
    }
  }
}

void WaterSurface::velocities(std::span<const glm::dvec2> p_world, const VelocityFrame& velocity,
                              std::span<glm::vec3> velocity_mps) const {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(velocity.z.t_s == frame_->t_s, "t_s={}, velocity of {}", frame_->t_s, velocity.z.t_s);
  water_.velocities(velocity, p_world, velocity_mps);
}

void WaterSurface::currents(std::span<const glm::dvec2> p_world,
                            std::span<glm::vec2> current_mps) const {
  const ScopedFloatEnvironment ieee;
  water_.currents(p_world, current_mps);
}

void WaterSurface::foam(std::span<const glm::dvec2> p_world, const WhitecapFrame& whitecaps,
                        std::span<float> foam) const {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(p_world.size() == foam.size(), "{} points, {} foam", p_world.size(), foam.size());
  const CoastSea* const coast = water_.parts().coast;
  const double wave_t_s = wave_time_s(water_.parts().sea->description(), frame_->t_s);
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const auto p = p_world.subspan(first, std::min(kPointChunk, p_world.size() - first));
    const auto some = foam.subspan(first, p.size());
    std::array<float, kPointChunk> z, ceded{}, surf;
    heights(p, std::span(z).first(p.size()));
    if (coast) {
      sample_coast_share(*coast, p, std::span(ceded).first(p.size()));
      for (float& x : ceded) x = 1.0f - spectrum_weight(x);
    }
    if (const SurfFronts* const fronts = water_.parts().fronts; fronts && frame_->has_fronts)
      for (std::size_t i = 0; i < p.size(); ++i)
        ceded[i] = 1.0f - spectrum_weight(place_in_fronts(*fronts, p[i]).at.share);
    sample_whitecaps(whitecaps, p, std::span(z).first(p.size()), some, ceded);
    if (const Shelter* shelter = water_.parts().shelter; shelter && frame_->sheltered)
      apply_shelter(*shelter, p, some);
    if (coast) {
      sample_surf_foam(*coast, wave_t_s, p, std::span(surf).first(p.size()));
      // Two patterns that know nothing of each other.
      for (std::size_t i = 0; i < p.size(); ++i)
        some[i] = 1.0f - (1.0f - some[i]) * (1.0f - mean_lace_cover(surf[i]));
    }
    if (const InlandWater* const inland = water_.parts().inland)
      for (std::size_t i = 0; i < p.size(); ++i)
        if (const auto at = inland->at(p[i]))
          some[i] = std::max(some[i] * at->sea_share, at->white);
    add_wake_foam(frame_->wakes, p, some);
  }
}

bool WaterSurface::in_water(glm::dvec3 p_world) const {
  const ScopedFloatEnvironment ieee;
  const glm::dvec2 p(p_world);
  if (!(p_world.z <= height(p))) return false;
  float ground_m = -HUGE_VALF;
  if (water_.parts().land) sample_heights(*water_.parts().land, {&p, 1}, {&ground_m, 1});
  return p_world.z > ground_m;
}

std::optional<WaterHit> WaterSurface::intersect(glm::dvec3 origin_world, glm::dvec3 direction,
                                                double max_distance_m) const {
  return with_ieee([&] { return find_hit(*this, origin_world, direction, max_distance_m); });
}

}  // namespace swell::ocean
