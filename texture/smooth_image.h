// An image of 16 bits a channel, for what changes slowly and must show no steps: the sky. See
// smooth_image-inl.h for the sampler.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace swell::texture {

// A value is range (code / 65535)^2. A word holds the codes of a texel and of its right
// neighbour (the low and the high half), so that a bilinear sample of a channel is two loads. Texel
// (x, y)'s centre lies at (x + 0.5, y + 0.5); beyond the last column it repeats.
struct SmoothImage {
  int width = 0, height = 0;
  float range = 1.0f;
  std::array<std::vector<std::uint32_t>, 3> channels;  // row by row

  auto fields() { return std::tie(width, height, range, channels); }
};

// rgb: 3 width height values, row by row, clamped to [0, range]. width and height in [2, 4096].
SmoothImage make_smooth_image(std::span<const float> rgb, int width, int height, float range);

// Fills rows [first_row, end_row) of `result` with what lies between the codes of `a`, at part 0,
// and of `b`, at part 1. All three: of one size and range.
void blend_rows(const SmoothImage& a, const SmoothImage& b, float part, int first_row, int end_row,
                SmoothImage& result);

}  // namespace swell::texture
