// A map of heights made finer by bicubic interpolation.
#pragma once

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// Refines a square to 4 samples in place of each along either axis, or 2 or 1 where there would be
// more than kMostRefined a side. The surface passes through the old samples with continuous slopes.
// Beyond the border its line goes straight on. 4 bytes a new sample; the same bits on any number of
// threads.
//
// Source: Keys, Cubic convolution interpolation for digital image processing, 1981, a = -1/2.
inline constexpr int kMostRefined = 8193;
HeightGrid refine_bicubic(const HeightGrid& heights, Workers& workers);

}  // namespace swell::terrain
