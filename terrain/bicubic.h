// A map of heights made finer by bicubic interpolation.
#pragma once

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// The same square with 4 samples in place of each, or 2 or 1 where there would be more than
// kMostRefined a side: through the old ones with continuous slopes. Beyond the border its line goes
// straight on. 4 bytes a new sample; the same bits on any number of threads.
//
// Source: Keys, Cubic convolution interpolation for digital image processing, 1981, a = -1/2.
inline constexpr int kMostRefined = 8193;
HeightGrid refine_bicubic(const HeightGrid& heights, Workers& workers);

}  // namespace swell::terrain
