#include "sky/air_paths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "math/elementary.h"
#include "math/smoothstep.h"

namespace swell::sky {
namespace {

double cube(double x) { return x * x * x; }

glm::dvec3 exp_each(glm::dvec3 x) { return {exp(x.x), exp(x.y), exp(x.z)}; }

// The transmittance: rows by height, columns by the distance to the air's top.
// Source: Bruneton, Neyret 2008, section 4.
constexpr int kHeights = 80;
const double kHorizonAtTop_m =
    std::sqrt(kAirTopRadius_m * kAirTopRadius_m - kEarthRadius_m * kEarthRadius_m);

double horizon_distance_m(double radius_m) {
  return std::sqrt(std::max(radius_m * radius_m - kEarthRadius_m * kEarthRadius_m, 0.0));
}

// Light of optical depth up to the air's top, for a ray that misses the earth.
glm::dvec3 transmittance_to_top(const Air& air, double radius_m, double sine) {
  constexpr int kSteps = 60;
  const double length_m = distance_to_air_top_m(radius_m, sine);
  glm::dvec3 depth(0.0);
  for (int i = 0; i < kSteps; ++i) {
    // Steps that grow from the start, where air is densest or the ray lowest.
    const double begin = double(i) / kSteps, end = double(i + 1) / kSteps;
    const double t = 0.5 * (begin * begin + end * end), dt = end * end - begin * begin;
    depth +=
        air_light(air, height_along(radius_m, sine, t * length_m)).lost_per_m * (dt * length_m);
  }
  return exp_each(-depth);
}

// Where on a step of an optical depth the light that arrives from it is scattered, in the mean:
// [0, 0.5] of the way.
double mean_place(double depth) {
  if (depth < 1e-3) return 0.5 - depth / 12.0;
  const double passes = exp(-depth);
  return 1.0 / depth - passes / (1.0 - passes);
}

// Where step i of so many begins, as a part of a ray: steps grow from where air is densest. Towards
// the sea that is the far end for an eye high up, and even steps serve both ends.
class Steps {
 public:
  Steps(double height_m, bool meets_sea, int count)
      : even_(meets_sea ? smoothstep(0.0, kEvenFrom_m, height_m) : 0.0), count_(count) {}
  double begin(int i) const {
    const double x = static_cast<double>(i) / count_;
    return cube(x) + even_ * (x - cube(x));
  }

 private:
  static constexpr double kEvenFrom_m = 10000.0;
  double even_;
  int count_;
};

// Rows of sources lie at kEven_m times the hyperbolic sine of even steps up to kEvenHeights.
constexpr double kEven_m = 1500.0, kTopOfEven = kAirTop_m / kEven_m;
const double kEvenHeights = log(kTopOfEven + std::sqrt(kTopOfEven * kTopOfEven + 1.0));

}  // namespace

// ---- Tables

void fill_transmittance(Atmosphere& atmosphere, Workers& workers) {
  atmosphere.transmittance.resize(static_cast<std::size_t>(kHeights) * kTransmittanceColumns);
  workers.for_each(kHeights, [&](std::size_t row, int) {
    const double horizon_m = kHorizonAtTop_m * static_cast<double>(row) / (kHeights - 1);
    const double radius_m = std::sqrt(horizon_m * horizon_m + kEarthRadius_m * kEarthRadius_m);
    const double nearest_m = kAirTopRadius_m - radius_m, furthest_m = horizon_m + kHorizonAtTop_m;
    for (int column = 0; column < kTransmittanceColumns; ++column) {
      const double d = std::max(
          nearest_m + (furthest_m - nearest_m) * column / (kTransmittanceColumns - 1), 1e-3);
      const double sine =
          (kAirTopRadius_m * kAirTopRadius_m - radius_m * radius_m - d * d) / (2.0 * radius_m * d);
      atmosphere.transmittance[row * kTransmittanceColumns + static_cast<std::size_t>(column)] =
          transmittance_to_top(atmosphere.air, radius_m, std::clamp(sine, -1.0, 1.0));
    }
  });
}

HeightRow height_row_of(double height_m) {
  const double radius_m = kEarthRadius_m + height_m, horizon_m = horizon_distance_m(radius_m);
  const double nearest_m = kAirTopRadius_m - radius_m;
  return {between(horizon_m / kHorizonAtTop_m * (kHeights - 1), kHeights), radius_m, nearest_m,
          1.0 / (horizon_m + kHorizonAtTop_m - nearest_m), -horizon_m / radius_m};
}

glm::vec3 transmittance_over_horizon(const Atmosphere& atmosphere, const HeightRow& at,
                                     double sine) {
  return interpolate(atmosphere.transmittance.data(), kTransmittanceColumns, at.row,
                     transmittance_column(at, sine));
}

glm::vec3 disc_transmittance(const Atmosphere& atmosphere, const HeightRow& at, double sine) {
  const double seen = part_over_edge(at, sine);
  if (seen <= 0.0) return glm::vec3(0.0f);
  return static_cast<float>(seen) *
         transmittance_over_horizon(atmosphere, at, std::max(sine, at.horizon_sine));
}

double source_height_m(int row) {
  const double x = exp(kEvenHeights * row / (kSourceHeights - 1));
  return row == kSourceHeights - 1 ? kAirTop_m : 0.5 * kEven_m * (x - 1.0 / x);
}

Between source_row(double height_m) {
  const double x = std::max(height_m, 0.0) / kEven_m;
  return between(log(x + std::sqrt(x * x + 1.0)) * ((kSourceHeights - 1) / kEvenHeights),
                 kSourceHeights);
}

double source_sine(int column) {
  if (column < kLowSines) return kLowestSine + (kMiddleSine - kLowestSine) * column / kLowSines;
  const double from_zenith = static_cast<double>(kSourceSines - 1 - column) / kHighSines;
  return 1.0 - (1.0 - kMiddleSine) * from_zenith * from_zenith;
}

// ---- Rays

Path trace(const Air& air, double height_m, double sine, int step_count) {
  const double radius_m = kEarthRadius_m + height_m;
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
  Path path;
  const std::optional<double> sea_m = distance_to_sea_m(radius_m, sine);
  path.sine = sine;
  path.meets_sea = sea_m.has_value();
  const double length_m = sea_m ? *sea_m : distance_to_air_top_m(radius_m, sine);
  const Steps steps(height_m, path.meets_sea, step_count);
  glm::dvec3 left(1.0);
  for (int i = 0; i < step_count; ++i) {
    const double from = steps.begin(i), to = steps.begin(i + 1);
    const double t_m = 0.5 * (from + to) * length_m;
    const double dt_m = (to - from) * length_m;
    const double h_m = std::max(height_along(radius_m, sine, t_m), 0.0);
    const AirLight here = air_light(air, h_m);
    const glm::dvec3 lost = glm::max(here.lost_per_m, 1e-12);
    const glm::dvec3 passes = exp_each(-lost * dt_m);
    const glm::dvec3 weight = left * (1.0 - passes);
    const double mean_m = from * length_m + dt_m * mean_place(lost.y * dt_m);
    const double mean_h_m = std::max(height_along(radius_m, sine, mean_m), 0.0);
    const AirLight there = air_light(air, mean_h_m);
    const glm::dvec3 scattered = weight / glm::max(there.lost_per_m, 1e-12);
    const double r_m = kEarthRadius_m + mean_h_m;
    path.steps.push_back({height_row_of(mean_h_m), source_row(mean_h_m),
                          (radius_m + mean_m * sine) / r_m, mean_m * cosine / r_m,
                          scattered * there.rayleigh_per_m, scattered * there.mie_per_m});
    left *= passes;
  }
  path.left = left;
  path.sea = left * kSeaAlbedo;
  path.sea_up = (radius_m + length_m * sine) / kEarthRadius_m;
  path.sea_ahead = length_m * cosine / kEarthRadius_m;
  return path;
}

}  // namespace swell::sky
