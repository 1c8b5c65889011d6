// The least and the greatest height of squares of a domain, and of squares of squares: bounds of a
// surface that hold for any triangulation of it.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::lod {

struct HeightRange {
  float low_m = 0.0f, high_m = 0.0f;
};

inline HeightRange join(HeightRange a, HeightRange b) {
  return {std::min(a.low_m, b.low_m), std::max(a.high_m, b.high_m)};
}

struct HeightPyramid {
  int bits = 0;                    // the finest level has 2^bits x 2^bits squares
  std::vector<HeightRange> range;  // level l (2^l x 2^l squares, row by row) from (4^l - 1) / 3 on
};

// From ranges of 4^bits squares, row by row from the south; bits in [0, 12]. One range (bits = 0)
// stands for all of the domain: the bound of waves at any time.
HeightPyramid make_height_pyramid(int bits, std::span<const HeightRange> finest);

// From samples x samples heights over the domain, border to border, bilinear between them, such as
// a terrain's; samples >= 2.
HeightPyramid make_height_pyramid(int bits, std::span<const float> height_m, int samples);

// Bounds of the heights over the box [low, high] (high > low) of a lattice of 2^lattice_bits steps
// a side. Looks at four squares at most, so the box that counts is up to four times as wide.
HeightRange height_range(const HeightPyramid& pyramid, int lattice_bits, glm::ivec2 low,
                         glm::ivec2 high);

}  // namespace swell::lod
