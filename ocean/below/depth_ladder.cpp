#include "ocean/below/depth_ladder.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr double kFirst_m = 0.02, kRatio = 1.6;
constexpr double kLogRatio = 0.47000362924573558;

// Depths as rungs of the ladder, with fractions.
double place_on_ladder(double below_m) {
  constexpr auto kDeepest = static_cast<double>(kRungs - 1);
  if (!(below_m < HUGE_VAL)) return kDeepest;
  return std::min(log(1.0 + below_m / kFirst_m) / kLogRatio, kDeepest);
}

std::size_t last_rung(double floor_place) {
  return static_cast<std::size_t>(std::max(std::nearbyint(floor_place), 3.0));
}

}  // namespace

double rung_depth_m(std::size_t rung, double floor_m) {
  if (rung >= last_rung(place_on_ladder(floor_m)) && floor_m < HUGE_VAL) return floor_m;
  double power = 1.0;
  for (std::size_t n = 0; n < rung; ++n) power *= kRatio;
  return kFirst_m * (power - 1.0);
}

RungWeights rung_weights(double below_m, double floor_m) {
  const double floor_place = place_on_ladder(floor_m);
  const std::size_t last = last_rung(floor_place);
  const double at = std::min(place_on_ladder(below_m), floor_place);
  RungWeights weights;
  weights.first = static_cast<std::size_t>(
      std::clamp(std::floor(at) - 1.0, 0.0, static_cast<double>(last - 3)));
  std::array<double, 4> place;
  for (std::size_t n = 0; n < 4; ++n)
    place[n] = weights.first + n == last ? floor_place : static_cast<double>(weights.first + n);
  // Lagrange's polynomials.
  for (std::size_t n = 0; n < 4; ++n) {
    double weight = 1.0;
    for (std::size_t m = 0; m < 4; ++m)
      if (m != n) weight *= (at - place[m]) / (place[n] - place[m]);
    weights.weight[n] = static_cast<float>(weight);
  }
  return weights;
}

}  // namespace swell::ocean
