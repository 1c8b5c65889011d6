// The web that foam leaves between its bubbles, as a map of thresholds.
// Source: Worley, A Cellular Texture Basis Function, SIGGRAPH 1996 (F2 - F1).
#pragma once

#include <cstdint>
#include <vector>

namespace swell::texture {

// size x size thresholds, row by row, periodic: foam that covers a part `a` of the water lies where
// the threshold is below a. Each of (k + 1/2) / size^2, k from 0, comes once, so that the part is
// exact; low ones are the rims of cells of size / 10 and size / 25 texels. size is a power of two
// in [32, 1024]. About 60 ms for 256 x 256.
std::vector<float> make_foam_pattern(int size, std::uint64_t seed);

// Thresholds of the same kind for larger shapes: low ones are patches of size / 8 texels with rims
// torn down to size / 64.
std::vector<float> make_tear_pattern(int size, std::uint64_t seed);

}  // namespace swell::texture
