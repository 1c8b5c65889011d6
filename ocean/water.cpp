#include "ocean/water.h"

#include <algorithm>

#include "math/check.h"
#include "ocean/water_sources.h"

namespace swell::ocean {
namespace {

// steepest: the sea's and the trains' own, and what the fading adds: the edge rises by 1.5 over a
// tenth of the area, shallow water (on sand of slope 1) by 1 over the height of the waves, the sea
// makes room for the trains and runs into the lee of land.
WaterBounds bounds_of(const WaterParts& water) {
  const Sea& sea = *water.sea;
  const CoastSea* coast = water.coast;
  const double sea_m = sea.height_bound_m(), sea_slope = sea.slope_bound();
  const float trains_m = coast ? coast->trains.height_bound_m : 0.0f;
  const float trains_slope = coast ? coast->slope_bound() : 0.0f;
  WaterBounds bounds;
  bounds.height_m = static_cast<float>(sea_m) + trains_m + water.wakes.height_m;
  bounds.slope = static_cast<float>(sea_slope) + trains_slope + water.wakes.slope;
  const double all_m = sea_m + static_cast<double>(trains_m);
  const glm::dvec2 limits_m = water.area.limits_m();
  const double rim_m = kEdgePart * std::min(limits_m.x, limits_m.y);
  bounds.steepest = sea_slope + 2.0 * all_m * 1.5 / rim_m;
  if (water.land) bounds.steepest += shallow_steepness(sea);
  bounds.steepest += 2.0 * static_cast<double>(water.wakes.slope);
  if (water.shelter) bounds.steepest += static_cast<double>(water.shelter->slope_per_m) * sea_m;
  bounds.mean_wavelength_m = sea.mean_wavelength_m();
  if (const SurfFronts* const fronts = water.fronts) {
    bounds.height_m += fronts->height_bound_m;
    bounds.slope += fronts->slope_bound;
    bounds.steepest += static_cast<double>(fronts->slope_bound);
    bounds.steepest += static_cast<double>(fronts->share_slope_per_m) * sea_m;
    bounds.steepest += 2.0 * static_cast<double>(fronts->height_bound_m) * 1.5 / rim_m;
  }
  bounds.highest_m = bounds.height_m;
  if (water.inland) {
    bounds.highest_m += std::max(water.inland->highest_m(), 0.0f);
    bounds.steepest += 0.2;
  }
  if (!coast) return bounds;
  bounds.steepest += static_cast<double>(trains_slope);
  bounds.steepest += static_cast<double>(coast->share_slope_per_m) * sea_m;
  if (bounds.mean_wavelength_m == 0.0)
    bounds.mean_wavelength_m = static_cast<double>(coast->peak_wavelength_m);
  return bounds;
}

}  // namespace

double shallow_depth_m(const Sea& sea) { return 0.2 + sea.significant_height_m(); }

double shallow_steepness(const Sea& sea) { return sea.height_bound_m() / shallow_depth_m(sea); }

WaterBody::WaterBody(const WaterParts& parts)
    : parts_(parts),
      bounds_(bounds_of(parts)),
      wave_height_m_(static_cast<float>(parts.sea->significant_height_m())) {}

void WaterBody::heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                        std::span<float> height_m, std::size_t longest_patches) const {
  SWELL_CHECK(p_world.size() == height_m.size(), "{} points, {} heights", p_world.size(),
              height_m.size());
  add_up(parts_, {parts_, wave_height_m_, longest_patches}, height_m,
         [&](const auto& source, std::size_t first, Room room, std::span<float> z) {
           source.add_heights(frame, p_world.subspan(first, z.size()), room, z);
         });
  InlandLevels{parts_}.add_heights(p_world, height_m);
}

void WaterBody::slopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                       std::span<glm::vec2> slope) const {
  SWELL_CHECK(p_world.size() == slope.size(), "{} points, {} slopes", p_world.size(), slope.size());
  add_up(parts_, {parts_, wave_height_m_}, slope,
         [&](const auto& source, std::size_t first, Room room, std::span<glm::vec2> some) {
           source.add_slopes(frame, p_world.subspan(first, some.size()), room, some);
         });
  InlandLevels{parts_}.add_slopes(p_world, slope);
}

void WaterBody::velocities(const VelocityFrame& velocity, std::span<const glm::dvec2> p_world,
                           std::span<glm::vec3> velocity_mps) const {
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  add_up(parts_, {parts_, wave_height_m_}, velocity_mps,
         [&](const auto& source, std::size_t first, Room room, std::span<glm::vec3> v) {
           source.add_velocities(velocity, p_world.subspan(first, v.size()), room, v);
         });
  InlandLevels{parts_}.add_velocities(p_world, velocity_mps);
}

void WaterBody::currents(std::span<const glm::dvec2> p_world,
                         std::span<glm::vec2> current_mps) const {
  SWELL_CHECK(p_world.size() == current_mps.size(), "{} points, {} currents", p_world.size(),
              current_mps.size());
  const InlandLevels inland{parts_};
  for (std::size_t i = 0; i < p_world.size(); ++i) {
    const auto sample = inland.at(p_world[i]);
    current_mps[i] = sample ? glm::vec2(sample->east_mps, sample->north_mps) : glm::vec2(0.0f);
  }
}

}  // namespace swell::ocean
