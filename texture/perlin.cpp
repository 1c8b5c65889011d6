#include "texture/perlin.h"

#include <algorithm>
#include <bit>

#include "math/check.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "texture/lattice.h"

namespace swell::texture {
namespace {

constexpr int kPeriod = 256;
constexpr std::uint64_t kValueStream = 0x76616c7565;  // apart from the permutation's numbers

// interpolation_weight(), without a call for the usual one.
double weight_at(Interpolation interpolation, double t) {
  return interpolation == Interpolation::kCubic ? smooth_blend(t)
                                                : interpolation_weight(interpolation, t);
}

void check_fractal(int octaves, double persistence) {
  SWELL_CHECK(octaves >= 1 && octaves <= 16, "octaves={}", octaves);
  SWELL_CHECK(persistence >= 0.0 && persistence <= 1.0, "persistence={}", persistence);
}

// sum over i < octaves of persistence^i noise(i, 2^i).
template <class Noise>
double sum_octaves(int octaves, double persistence, const Noise& noise) {
  check_fractal(octaves, persistence);
  double sum = 0.0, amplitude = 1.0, frequency = 1.0;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * noise(i, frequency);
    amplitude *= persistence;
    frequency *= 2.0;
  }
  return sum;
}

}  // namespace

double interpolation_weight(Interpolation interpolation, double t) {
  switch (interpolation) {
    case Interpolation::kLinear:
      return t;
    case Interpolation::kCosine:
      return 0.5 * (1.0 - sin_cos_turns(0.5 * t).cos);
    default:
      return smooth_blend(t);
  }
}

PerlinNoise::PerlinNoise(std::uint64_t seed, Interpolation interpolation)
    : interpolation_(interpolation), p_(make_permutation(seed)) {
  for (std::size_t n = 0; n < g_.size(); ++n) {
    g_[n] = 2.0 * random_uniform(seed ^ kValueStream, n) - 1.0;
  }
}

double PerlinNoise::lattice3(int i, int j, int k) const {
  return g_[p_[p_[p_[i & 255] + (j & 255)] + (k & 255)]];
}

double PerlinNoise::noise1(double x) const {
  const auto [i, t] = lattice_position(x, kPeriod);
  return mix(g_[p_[i]], g_[p_[i + 1]], weight_at(interpolation_, t));
}

double PerlinNoise::noise2(double x, double y) const {
  const auto [i, s] = lattice_position(x, kPeriod);
  const auto [j, t] = lattice_position(y, kPeriod);
  const double s_weight = weight_at(interpolation_, s);
  const auto row = [&, column = i](int at_j) {
    return mix(g_[p_[p_[column] + at_j]], g_[p_[p_[column + 1] + at_j]], s_weight);
  };
  return mix(row(j), row((j + 1) & 255), weight_at(interpolation_, t));
}

double PerlinNoise::noise3(double x, double y, double z) const {
  return wrapped_noise3(x, y, z, kPeriod);
}

double PerlinNoise::wrapped_noise3(double x, double y, double z, int period) const {
  const LatticePosition px = lattice_position(x, period), py = lattice_position(y, period);
  const LatticePosition pz = lattice_position(z, period);
  const double x_weight = weight_at(interpolation_, px.fraction);
  const double y_weight = weight_at(interpolation_, py.fraction);
  const double z_weight = weight_at(interpolation_, pz.fraction);
  const int next_i = (px.cell + 1) & (period - 1);
  const int next_j = (py.cell + 1) & (period - 1);
  const int next_k = (pz.cell + 1) & (period - 1);
  const auto row = [&](int j, int k) {
    return mix(lattice3(px.cell, j, k), lattice3(next_i, j, k), x_weight);
  };
  const auto plane = [&](int k) { return mix(row(py.cell, k), row(next_j, k), y_weight); };
  return mix(plane(pz.cell), plane(next_k), z_weight);
}

double PerlinNoise::fractal2(double x, double y, int octaves, double persistence) const {
  return sum_octaves(octaves, persistence,
                     [&](int, double frequency) { return noise2(frequency * x, frequency * y); });
}

void PerlinNoise::fractal2_row(std::span<const double> x, double y, int octaves, double persistence,
                               std::span<double> sums) const {
  check_fractal(octaves, persistence);
  SWELL_CHECK(x.size() == sums.size(), "{} places, {} sums", x.size(), sums.size());
  std::ranges::fill(sums, 0.0);
  double amplitude = 1.0, frequency = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    const auto [j, t] = lattice_position(frequency * y, kPeriod);
    const double t_weight = weight_at(interpolation_, t);
    const int next_j = (j + 1) & 255;
    int known = -1;  // the cell whose corners these are
    std::array<double, 4> corner{};
    for (std::size_t n = 0; n < x.size(); ++n) {
      const auto [i, s] = lattice_position(frequency * x[n], kPeriod);
      if (i != known) {
        const int low = p_[i], high = p_[i + 1];
        corner = {g_[p_[low + j]], g_[p_[high + j]], g_[p_[low + next_j]], g_[p_[high + next_j]]};
        known = i;
      }
      const double s_weight = weight_at(interpolation_, s);
      sums[n] += amplitude * mix(mix(corner[0], corner[1], s_weight),
                                 mix(corner[2], corner[3], s_weight), t_weight);
    }
    amplitude *= persistence;
    frequency *= 2.0;
  }
}

double PerlinNoise::fractal3(double x, double y, double z, int octaves, double persistence) const {
  return sum_octaves(octaves, persistence, [&](int, double frequency) {
    return noise3(frequency * x, frequency * y, frequency * z);
  });
}

double PerlinNoise::periodic_fractal3(double x, double y, double z, int period, int octaves,
                                      double persistence) const {
  SWELL_CHECK(
      period >= 1 && period <= kPeriod && std::has_single_bit(static_cast<unsigned>(period)),
      "period={}", period);
  return sum_octaves(octaves, persistence, [&](int octave, double frequency) {
    const int octave_period = static_cast<int>(std::min<long>(long{period} << octave, kPeriod));
    return wrapped_noise3(frequency * x, frequency * y, frequency * z, octave_period);
  });
}

}  // namespace swell::texture
