// Seas of wave trains alone, made and sampled on one thread.
#pragma once

#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/coast/peachey.h"

namespace swell::ocean {

// k by bisection of omega^2 = g k tanh(k h): the oracle of every wave length of these seas.
inline double bisected_wave_number(double period_s, double depth_m) {
  const double omega = kTurn / period_s;
  double low = omega * omega / kG, high = low + 2.0 * omega / std::sqrt(kG * depth_m);
  for (int i = 0; i < 80; ++i) {
    const double k = 0.5 * (low + high);
    (kG * k * std::tanh(k * depth_m) < omega * omega ? low : high) = k;
  }
  return low;
}

inline glm::dvec2 unit(double angle_deg) {
  return {std::cos(angle_deg * kDegree), std::sin(angle_deg * kDegree)};
}

inline TrainSea make_sea(const terrain::HeightGrid& floor, const std::vector<WaveTrain>& trains,
                         PhaseMethod method = PhaseMethod::kEikonal) {
  Workers workers(1);
  return make_train_sea(floor, trains, method, workers);
}

inline double height_at(const TrainSea& sea, double t_s, glm::dvec2 p) {
  float z = 0.0f;
  sample_trains(sea, t_s, {&p, 1}, {&z, 1});
  return static_cast<double>(z);
}

}  // namespace swell::ocean
