// Seas of wave trains alone, made and sampled on one thread.
#pragma once

#include <vector>

#include "ocean/peachey.h"

namespace swell::ocean {

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
