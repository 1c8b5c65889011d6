// How a periodic patch covers the sea without repeating itself: the plane is laid with tiles as
// large as the patch, every other row moved by half a tile, and each tile reads the patch at an
// offset of its own. Across borders of an eighth of a tile neighbours are blended by weights whose
// squares add up to 1 (within 0.4 %), which keeps the distribution of a sum of waves: heights of
// independent places are normal, and so is their blend, with the same variance. Source: Heitz and
// Neyret, High-Performance By-Example Noise using a Histogram-Preserving Blending Operator, 2018,
// section 3; rows of squares instead of triangles, so that most places read one tile.
//
// The blend's weights have slopes too. Waves of standard deviation sigma, on a patch of length L,
// get along a border's middle line a further slope of 19 sigma / L, in the mean over the sea a
// further slope variance of about 50 (sigma / L)^2: in a gale of 15 m/s 0.3 % of all. Heights and
// slopes that are asked for have it; the drawn slopes, whose maps know no heights, leave it out.
#pragma once

#include <cmath>
#include <cstdint>

namespace swell::ocean {

struct PatchTiling {
  bool on = false;  // off: the patch repeats itself
  std::uint32_t seed = 0;

  bool operator==(const PatchTiling&) const = default;
};

inline constexpr float kTileBorder = 1.0f / 8.0f;  // width of the blend across a border, in tiles

// The largest slope of a blend's weights, in their norm: 1 / tiles.
inline constexpr double kTileBlendSlope = 2.4 / static_cast<double>(kTileBorder);

// Tiles have numbers modulo 2^16 along each axis.
inline int tile_number(double tiles) {
  return static_cast<int>(tiles - 65536.0 * std::floor(tiles / 65536.0));
}

}  // namespace swell::ocean
