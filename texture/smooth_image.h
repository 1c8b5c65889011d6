// An image of 16 bits a channel, for what changes slowly and must show no steps: the sky. See
// smooth_image-inl.h for the sampler.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace swell::texture {

// Square. A value is range (code / 65535)^2. A word holds the codes of a texel and of its right
// neighbour (the low and the high half), so that a bilinear sample of a channel is two loads. Texel
// (x, y)'s centre lies at (x + 0.5, y + 0.5); beyond the last column it repeats.
struct SmoothImage {
  int size = 0;
  float range = 1.0f;
  std::array<std::vector<std::uint32_t>, 3> channels;  // row by row
};

// rgb: 3 size^2 values, row by row, clamped to [0, range]. size in [2, 4096].
SmoothImage make_smooth_image(std::span<const float> rgb, int size, float range);

}  // namespace swell::texture
