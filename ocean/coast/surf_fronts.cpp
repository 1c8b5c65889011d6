#include "ocean/coast/surf_fronts.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/large_array.h"
#include "math/smoothstep.h"
#include "ocean/open_sea/sea_state.h"

namespace swell::ocean {
namespace {

// Waves begin to break where the water is so much deeper than they are high, significant heights.
constexpr double kDepthOfSurf = 1.6;
constexpr double kMostSurfReach_m = 400.0;

// The floor's mean slope within `within_m` of the shore, on the map: its apron may be steep.
double beach_slope(const terrain::ShoreMap& shore, const terrain::Grid& map, double within_m) {
  double depths_m = 0.0, distances_m = 0.0;
  for (int j = 0; j < shore.grid().samples_y; ++j)
    for (int i = 0; i < shore.grid().samples_x; ++i) {
      const std::size_t k = shore.grid().index(i, j);
      const float distance_m = shore.signed_distance_m()[k];
      if (!(distance_m > 0.0f && distance_m < static_cast<float>(within_m))) continue;
      if (!map.holds(shore.grid().point(i, j))) continue;
      depths_m -= static_cast<double>(shore.height_m()[k]);
      distances_m += static_cast<double>(distance_m);
    }
  return distances_m > 0.0 ? std::clamp(depths_m / distances_m, 0.01, 0.5) : 0.1;
}

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

// Far enough along the shore for fronts to lie within 10 degrees of it.
glm::vec3 lag_along(glm::dvec2 origin, double x_m, double y_m) {
  return glm::vec3(1.0 / x_m, 1.0 / y_m, fraction(origin.x / x_m + origin.y / y_m));
}

float reach_turns(const SurfZone& zone) {
  return static_cast<float>(0.25 * zone.reach_s / zone.period_s);
}

// The steepest that the front function is by turns, on the narrowest face; a tenth more for what
// the face's width changes by.
constexpr float kSteepestByTurns = 1.1f * 1.5f / 0.05f;
// The lags change by 0.06 sine waves of 157 m and 131 m length, at the most.
constexpr float kLagTurnsPerM = 0.06f * 6.2832f * 0.01f;

// Sets the bounds, from differences between neighbouring points.
void bound(const terrain::ShoreMap& shore, SurfFronts& fronts) {
  const terrain::Grid& grid = fronts.grid;
  const float per_m = static_cast<float>(1.0 / grid.spacing_m), turns = reach_turns(fronts.zone);
  struct Point {
    float height_m, turns, share;
  };
  const auto at = [&](int i, int j) -> Point {
    const std::size_t k = grid.index(i, j);
    const FrontPoint& point = fronts.points[k];
    return {front_height_m(point, -shore.height_m()[k]),
            turns * std::sqrt(std::max(point.part, 0.0f)), point.share};
  };
  for (int j = 1; j < grid.samples_y; ++j)
    for (int i = 1; i < grid.samples_x; ++i) {
      const Point here = at(i, j), west = at(i - 1, j), south = at(i, j - 1);
      const float most_m = std::max({here.height_m, west.height_m, south.height_m});
      const auto slope = [&](float Point::*of) {
        return per_m * glm::length(glm::vec2(here.*of - west.*of, here.*of - south.*of));
      };
      const float by_turns = most_m * kSteepestByTurns * (slope(&Point::turns) + kLagTurnsPerM);
      fronts.height_bound_m = std::max(fronts.height_bound_m, (1.0f - kFrontMean) * most_m);
      fronts.slope_bound = std::max(fronts.slope_bound, by_turns + slope(&Point::height_m));
      fronts.share_slope_per_m = std::max(fronts.share_slope_per_m, slope(&Point::share));
    }
}

}  // namespace

SurfZone find_surf_zone(const terrain::ShoreMap& shore, const terrain::Grid& land, const Sea& sea,
                        double surf_width) {
  const terrain::Grid& square = shore.grid();
  const double least_m = kLeastSurfReach * square.size_m();
  const double gravity = sea.description().gravity_mps2, height_m = sea.significant_height_m();
  const double slope = beach_slope(shore, land, std::max(30.0, 3.0 * square.spacing_m));
  SurfZone zone;
  zone.reach_m =
      std::clamp(kDepthOfSurf * height_m / slope, least_m, std::max(kMostSurfReach_m, least_m));
  zone.reach_m = std::max(zone.reach_m * surf_width, least_m);
  zone.reach_s = 2.0 * std::sqrt(zone.reach_m / (gravity * slope));
  zone.depth_m = zone.reach_m * slope;
  // The period is that of the mean wave in deep water.
  zone.period_s = std::sqrt(2.0 * kPi * std::max(sea.mean_wavelength_m(), 1.0) / gravity);
  return zone;
}

float part_of_reach(const SurfZone& zone, const terrain::ShoreMap& shore, glm::dvec2 p,
                    float none) {
  const float distance_m = shore.sample(p.x, p.y).signed_distance_m;
  const float surf = shore.surf_at(p.x, p.y);
  return surf > 0.0f ? distance_m / (surf * static_cast<float>(zone.reach_m)) : none;
}

double front_turns_per_s(const SurfZone& zone, const SeaDescription& sea) {
  return looping_frequency(0.25 / zone.period_s, sea.loop_s);
}

FrontClock make_front_clock(const SurfZone& zone, const SeaDescription& sea, double t_s,
                            glm::dvec2 origin) {
  return {.cycles = fraction(wave_time_s(sea, t_s) * front_turns_per_s(zone, sea)),
          .reach_turns = reach_turns(zone),
          .lag_a = lag_along(origin, 410.0, 330.0),
          .lag_b = lag_along(origin, -157.0, 131.0),
          .lag_c = lag_along(origin, 67.0, -53.0)};
}

SurfFronts make_surf_fronts(const terrain::ShoreMap& shore, const terrain::Grid& land,
                            const Sea& sea, const Shelter& shelter, double surf_width,
                            Workers& workers) {
  SurfFronts fronts{find_surf_zone(shore, land, sea, surf_width), shore.grid(), {}};
  resize_large(fronts.points, fronts.grid.size());
  const auto height_m = static_cast<float>(sea.significant_height_m());
  workers.for_each(static_cast<std::size_t>(fronts.grid.samples_y), [&](std::size_t row, int) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < fronts.grid.samples_x; ++i) {
      const glm::dvec2 p = fronts.grid.point(i, j);
      const float part = part_of_reach(fronts.zone, shore, p, kFrontsFrom);
      FrontPoint& point = fronts.points[fronts.grid.index(i, j)];
      point.part = std::clamp(part, -kFrontsFrom, kFrontsFrom);
      if (point.part >= kFrontsFrom) continue;
      float kept = 1.0f;
      apply_shelter(shelter, {&p, 1}, {&kept, 1});
      // As ShareOfFronts() of front_function-inl.h.
      const float way = kFrontsFrom - std::max(point.part, 0.0f) / std::max(kept, 0.1f);
      point.share = smooth_blend(std::clamp(way, 0.0f, 1.0f));
      point.height_m = height_m * kept * point.share;
    }
  });
  bound(shore, fronts);
  return fronts;
}

FrontPlace place_in_fronts(const SurfFronts& fronts, glm::dvec2 p_world) {
  const terrain::Grid& grid = fronts.grid;
  const glm::dvec2 at = (p_world - grid.min_world) / grid.spacing_m;
  const glm::dvec2 last(grid.samples_x - 1, grid.samples_y - 1);
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < last.x && at.y < last.y)) return {};
  const int i = static_cast<int>(at.x), j = static_cast<int>(at.y);
  const auto x = static_cast<float>(at.x - i), y = static_cast<float>(at.y - j);
  const FrontPoint* const low = fronts.points.data() + grid.index(i, j);
  const FrontPoint* const high = low + grid.samples_x;
  const auto lerp = [](float a, float b, float t) { return a + t * (b - a); };
  const auto blend = [&](float FrontPoint::*of) {
    return lerp(lerp(low[0].*of, low[1].*of, x), lerp(high[0].*of, high[1].*of, x), y);
  };
  constexpr auto kPart = &FrontPoint::part;
  const auto per_m = static_cast<float>(1.0 / grid.spacing_m);
  return {
      {blend(kPart), blend(&FrontPoint::share), blend(&FrontPoint::height_m)},
      per_m * glm::vec2(lerp(low[1].*kPart - low[0].*kPart, high[1].*kPart - high[0].*kPart, y),
                        lerp(high[0].*kPart - low[0].*kPart, high[1].*kPart - low[1].*kPart, x))};
}

}  // namespace swell::ocean
