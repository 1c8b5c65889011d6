// Perlin noise as in Elykov et al., 2000: lattice values g in [-1, 1] through a permutation,
// interpolated. Deterministic: tables come from the seed by counter-based random numbers.
#pragma once

#include <array>
#include <cstdint>

namespace swell::texture {

enum class Interpolation : std::uint8_t { kLinear, kCosine, kCubic };

class PerlinNoise {
 public:
  explicit PerlinNoise(std::uint64_t seed, Interpolation interpolation = Interpolation::kCubic);

  // Value noise in [-1, 1], equal to g[p[...]] at lattice points, period 256 along each axis.
  double noise1(double x) const;
  double noise2(double x, double y) const;
  double noise3(double x, double y, double z) const;

  // sum over i < octaves of persistence^i noise(2^i x), persistence in [0, 1], octaves in [1, 16].
  double fractal2(double x, double y, int octaves, double persistence) const;
  double fractal3(double x, double y, double z, int octaves, double persistence) const;

  // As fractal3 with the lattice wrapped in x, y and z at `period` (a power of two <= 256; octave i
  // wraps at 2^i period, at most 256), so that a map or an animation made of it tiles.
  double periodic_fractal3(double x, double y, double z, int period, int octaves,
                           double persistence) const;

 private:
  double lattice3(int i, int j, int k) const;
  Interpolation interpolation_;
  std::array<double, 256> g_;
  std::array<std::uint8_t, 512> p_;
};

}  // namespace swell::texture
