// Where a coordinate lies on a periodic lattice of noise; shared by the noises of this folder.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "math/random.h"

namespace swell::texture {

struct LatticePosition {
  int cell;         // in [0, period)
  double fraction;  // in [0, 1); NaN for a coordinate that is not finite
};

// Returns the position of a coordinate of 2^52 or more, a whole number, or one that is not finite.
inline LatticePosition far_lattice_position(double x, int period) {
  if (!std::isfinite(x)) return {0, std::numeric_limits<double>::quiet_NaN()};
  const double turns = std::floor(x / period);  // exact: period is a power of two
  return {static_cast<int>(x - turns * period), 0.0};
}

// period: a power of two.
inline LatticePosition lattice_position(double x, int period) {
  constexpr double kAllWhole = 4503599627370496.0;  // 2^52
  if (!(std::abs(x) < kAllWhole)) return far_lattice_position(x, period);
  auto cell = static_cast<std::int64_t>(x);  // towards 0
  cell -= x < static_cast<double>(cell);
  const double fraction = x - static_cast<double>(cell);
  return {static_cast<int>(cell & (period - 1)), fraction + 0.0};  // of -0.0 it is 0.0
}

// a + weight (b - a)
inline double mix(double a, double b, double weight) { return a + weight * (b - a); }

// A permutation of 0 .. 255 by the seed (Fisher and Yates), written twice.
inline std::array<std::uint8_t, 512> make_permutation(std::uint64_t seed) {
  std::array<std::uint8_t, 512> p;
  for (int i = 0; i < 256; ++i) p[i] = static_cast<std::uint8_t>(i);
  for (std::uint64_t i = 255; i > 0; --i) std::swap(p[i], p[random_bits(seed, i) % (i + 1)]);
  for (int i = 0; i < 256; ++i) p[256 + i] = p[i];
  return p;
}

}  // namespace swell::texture
