// What of the fronts of surf (ocean/coast/surf_fronts.h) is the same at all places.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

inline constexpr int kSurfFronts = 4;

// Fronts lift the water from kFrontsFrom reaches on, and from one reach on they are all its waves;
// in the lee of land as much nearer to the shore as waves are lower.
inline constexpr float kFrontsFrom = 2.0f;
// Part of H by which troughs lie below the mean level, so that fronts take and give no water.
inline constexpr float kFrontMean = 0.25f;
inline constexpr float kBreakingDepths = 0.78f;

// What is the same for all places at one time.
struct FrontClock {
  float cycles = 0.0f;       // t / (4 T)
  float reach_turns = 0.0f;  // tau / (4 T) of the reach
  // Lags along the shore: cycles by x, by y, at the origin.
  glm::vec3 lag_a{0.0f}, lag_b{0.0f}, lag_c{0.0f};
};

}  // namespace swell::ocean
