#include "ocean/coast/swash.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr double kHeightPart = 0.1;

double turns_along(std::size_t lag, glm::dvec2 p) {
  return p.x / kSwashLags_m[lag].x + p.y / kSwashLags_m[lag].y;
}

double sine_of_turns(double turns) { return sin(kTwoPi * (turns - std::floor(turns))); }
double cosine_of_turns(double turns) { return cos(kTwoPi * (turns - std::floor(turns))); }

}  // namespace

Swash make_swash(const Sea& sea, const CoastSea* coast, const Shelter* shelter) {
  if (coast)
    return {kHeightPart * static_cast<double>(coast->trains.height_bound_m),
            *std::ranges::max_element(coast->trains.period_s), shelter};
  if (!shelter) return {};
  const double mean_length_m = std::max(sea.mean_wavelength_m(), 1.0);
  return {kHeightPart * sea.significant_height_m(),
          std::sqrt(kTwoPi * mean_length_m / sea.description().gravity_mps2), shelter};
}

// As FindSwashEdge() of render/materials/terrain-inl.h.
double swash_edge_m(const Swash& swash, double wave_time_s, glm::dvec2 p_world) {
  const double a = sine_of_turns(turns_along(0, p_world));
  const double b = sine_of_turns(turns_along(1, p_world));
  const double turns = wave_time_s / swash.period_s - 0.3 * (a + b);
  const double leaning = turns - 0.056 * cosine_of_turns(turns);
  const double lobes = sine_of_turns(turns_along(2, p_world) + 0.7 * b);
  float kept = 1.0f;
  if (swash.shelter) apply_shelter(*swash.shelter, {&p_world, 1}, {&kept, 1});
  const double reach_m =
      swash.reach_m * static_cast<double>(kept) * (0.85 + 0.09 * b + 0.06 * lobes);
  return reach_m * (0.5 + 0.5 * sine_of_turns(leaning));
}

}  // namespace swell::ocean
