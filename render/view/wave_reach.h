// How far out the water's triangles show waves.
//
// Where triangles have grown wider than waves are long (lod::AdaptStatistics::reach_m), the heights
// of their corners are a few random samples of the waves: they would stand on the horizon like
// headlands, and jump from triangle to triangle. So waves fade out over the last two fifths before,
// and beyond they are in the shading alone.
#pragma once

#include <algorithm>

namespace swell::render {

inline constexpr float kWaveReachSlope = 2.5f;  // the share falls from 1 at 0.6 of the reach

// The share of the waves that a vertex shows, in [0, 1]. `inv_reach_per_m`: 0 without an end.
inline float wave_share(float distance_m, float inv_reach_per_m) {
  return std::clamp(kWaveReachSlope - kWaveReachSlope * inv_reach_per_m * distance_m, 0.0f, 1.0f);
}

}  // namespace swell::render
