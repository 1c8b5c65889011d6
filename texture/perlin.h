// Perlin noise as in Elykov et al., 2000: lattice values g in [-1, 1] through a permutation,
// interpolated. Deterministic: tables come from the seed by counter-based random numbers. All
// functions take any coordinate; one of 2^52 or more is a lattice point, NaN or infinity gives NaN.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace swell::texture {

// The weight of the further lattice point at fraction t of the way: t, (1 - cos(pi t)) / 2 or
// 3 t^2 - 2 t^3. The last two make the noise's first derivative continuous.
enum class Interpolation : std::uint8_t { kLinear, kCosine, kCubic };
double interpolation_weight(Interpolation interpolation, double t);  // t in [0, 1]

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

  // fractal2(x[i], y, octaves, persistence) to sums[i], for as many x; the same numbers. Fast where
  // neighbours lie between the same lattice points: about 3 ns an octave.
  void fractal2_row(std::span<const double> x, double y, int octaves, double persistence,
                    std::span<double> sums) const;

  // As fractal3 with the lattice wrapped in x, y and z at `period` (a power of two <= 256; octave i
  // wraps at 2^i period, at most 256), so that a map or an animation made of it tiles.
  double periodic_fractal3(double x, double y, double z, int period, int octaves,
                           double persistence) const;

  // periodic_fractal3(x[i], y, z, period, octaves, persistence) to sums[i], for as many x; the same
  // numbers. Fast where neighbours lie between the same lattice points.
  void periodic_fractal3_row(std::span<const double> x, double y, double z, int period, int octaves,
                             double persistence, std::span<double> sums) const;

  // The value at a lattice point, what noise3 is at (i, j, k). Period 256.
  double lattice3(int i, int j, int k) const;

 private:
  // Lattice points between which a place lies on an axis, and the weight of the further one.
  struct Between {
    int low, high;
    double weight;
  };
  Between between(double x, int period) const;
  // The values at the corners of a cell: x varies first, z last.
  using Corners = std::array<double, 8>;
  Corners corners(const Between& x, const Between& y, const Between& z) const;
  double wrapped_noise3(double x, double y, double z, int period) const;

  Interpolation interpolation_;
  std::array<double, 256> g_;
  std::array<std::uint8_t, 512>
      p_;  // a permutation of 0 .. 255, twice: p[p[i] + j] needs no modulo
};

}  // namespace swell::texture
