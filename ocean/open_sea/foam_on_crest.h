// How foam gathers on the crests of long waves.
#pragma once

#include <algorithm>

namespace swell::ocean {

// Short waves break on the crests of long ones: foam of all but the longest patch counts so many
// times where the surface is this high over the mean level, and once in the mean.
inline constexpr float kMostOnCrest = 1.6f;
inline float foam_on_crest(float height_m, float crest_per_m) {
  return std::clamp(1.0f + height_m * crest_per_m, 2.0f - kMostOnCrest, kMostOnCrest);
}

}  // namespace swell::ocean
