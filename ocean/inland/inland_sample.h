// What the lattice of rivers and lakes holds at a point.
#pragma once

#include <cstddef>

namespace swell::ocean {

// A sample of the lattice; between samples values are bilinear. Eight floats: shaders gather them.
struct InlandSample {
  float level_m = 0.0f;
  float depth_m = -1.0f;  // of the water; below 0 on the banks
  float east_mps = 0.0f, north_mps = 0.0f;
  float white = 0.0f;      // how much of the surface foams, [0, 1]
  float sea_share = 0.0f;  // of the sea's surface: 1 where a river has ended
  float phase = 0.0f;      // of ripples, in cycles: differs from place to place, smoothly
  float near = 0.0f;       // 0: too far from any water to have a level
};

// kBlock x kBlock cells, whose samples are (kBlock + 1)^2, row by row; the last of a row and of a
// column are the next block's first.
inline constexpr int kInlandBlock = 16, kInlandSide = kInlandBlock + 1;
inline constexpr std::size_t kInlandSamples = kInlandSide * kInlandSide;

}  // namespace swell::ocean
