// What surf hides through the holes of its lace.
#pragma once

namespace swell::ocean {

inline constexpr float kFoamRim = 0.3f;  // width of a bubble's rim, as a threshold

// The mean of what surf of this foam, in [0, 1], hides, over the lace's thresholds, spread evenly
// over [0, 1]: nothing where (1 + kFoamRim) foam is at the threshold, all where it is kFoamRim over
// it.
inline float mean_lace_cover(float foam) {
  const float over = (1.0f + kFoamRim) * foam;
  if (over < kFoamRim) return over * over / (2.0f * kFoamRim);
  if (over < 1.0f) return over - 0.5f * kFoamRim;
  const float left = 1.0f + kFoamRim - over;
  return 1.0f - left * left / (2.0f * kFoamRim);
}

}  // namespace swell::ocean
