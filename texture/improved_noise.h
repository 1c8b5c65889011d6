// Gradient noise.
// Source: Perlin, Improving Noise, 2002.
#pragma once

#include <array>
#include <cstdint>

namespace swell::texture {

class ImprovedNoise {
 public:
  ImprovedNoise();                             // Perlin's own permutation
  explicit ImprovedNoise(std::uint64_t seed);  // a permutation by the seed

  // Noise lies in [-1.04, 1.04] (seen: +-0.92) and is 0 at lattice points. Its first and second
  // derivative are continuous, its period is 256 along each axis. NaN or infinity gives NaN.
  double noise3(double x, double y, double z) const { return noise3(x, y, z, 256); }
  // This noise has its lattice wrapped at `period`, a power of two in [1, 256].
  double noise3(double x, double y, double z, int period) const;

 private:
  std::array<std::uint8_t, 512> p_;
};

}  // namespace swell::texture
