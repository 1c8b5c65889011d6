// How far out the water's triangles show waves.
//
// Where triangles have grown wider than waves are long (lod::AdaptStatistics::reach_m), the heights
// of their corners are a few random samples of the waves: they would stand on the horizon like
// headlands, and jump from triangle to triangle. So waves fade out there, from 0.8 to 1.6 of that
// distance, and beyond they are in the shading alone.
#pragma once

#include <algorithm>

namespace swell::render {

// The share is kWaveShareAtEye - kWaveShareFall distance / reach, within [0, 1].
inline constexpr float kWaveShareAtEye = 2.0f, kWaveShareFall = 1.25f;

// The share of the waves that a vertex shows, in [0, 1]. `inv_reach_per_m`: 0 without an end.
inline float wave_share(float distance_m, float inv_reach_per_m) {
  return std::clamp(kWaveShareAtEye - kWaveShareFall * inv_reach_per_m * distance_m, 0.0f, 1.0f);
}

}  // namespace swell::render
