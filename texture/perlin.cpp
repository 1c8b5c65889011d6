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

// Of the values at a cell's corners.
double blend(const std::array<double, 8>& c, double x_weight, double y_weight, double z_weight) {
  const double low = mix(mix(c[0], c[1], x_weight), mix(c[2], c[3], x_weight), y_weight);
  const double high = mix(mix(c[4], c[5], x_weight), mix(c[6], c[7], x_weight), y_weight);
  return mix(low, high, z_weight);
}

void check_fractal(int octaves, double persistence) {
  SWELL_CHECK(octaves >= 1 && octaves <= 16, "octaves={}", octaves);
  SWELL_CHECK(persistence >= 0.0 && persistence <= 1.0, "persistence={}", persistence);
}

void check_period(int period) {
  SWELL_CHECK(
      period >= 1 && period <= kPeriod && std::has_single_bit(static_cast<unsigned>(period)),
      "period={}", period);
}

// Of an octave of noise that wraps at a period.
int period_of_octave(int octave, int period) {
  return static_cast<int>(std::min<long>(long{period} << octave, kPeriod));
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

inline PerlinNoise::Between PerlinNoise::between(double x, int period) const {
  const auto [cell, fraction] = lattice_position(x, period);
  return {cell, (cell + 1) & (period - 1), weight_at(interpolation_, fraction)};
}

inline PerlinNoise::Corners PerlinNoise::corners(const Between& x, const Between& y,
                                                 const Between& z) const {
  const int low = p_[x.low], high = p_[x.high];
  const int low_low = p_[low + y.low], high_low = p_[high + y.low];
  const int low_high = p_[low + y.high], high_high = p_[high + y.high];
  const auto at = [&](int column, int k) { return g_[p_[column + k]]; };
  return {at(low_low, z.low),  at(high_low, z.low),  at(low_high, z.low),  at(high_high, z.low),
          at(low_low, z.high), at(high_low, z.high), at(low_high, z.high), at(high_high, z.high)};
}

double PerlinNoise::wrapped_noise3(double x, double y, double z, int period) const {
  const Between at_x = between(x, period), at_y = between(y, period), at_z = between(z, period);
  return blend(corners(at_x, at_y, at_z), at_x.weight, at_y.weight, at_z.weight);
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
  check_period(period);
  return sum_octaves(octaves, persistence, [&](int octave, double frequency) {
    return wrapped_noise3(frequency * x, frequency * y, frequency * z,
                          period_of_octave(octave, period));
  });
}

void PerlinNoise::periodic_fractal3_row(std::span<const double> x, double y, double z, int period,
                                        int octaves, double persistence,
                                        std::span<double> sums) const {
  check_period(period);
  check_fractal(octaves, persistence);
  SWELL_CHECK(x.size() == sums.size(), "{} places, {} sums", x.size(), sums.size());
  std::ranges::fill(sums, 0.0);
  double amplitude = 1.0, frequency = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    const int octave_period = period_of_octave(octave, period);
    const Between at_y = between(frequency * y, octave_period);
    const Between at_z = between(frequency * z, octave_period);
    int known = -1;  // the cell whose corners these are
    Corners corner{};
    for (std::size_t n = 0; n < x.size(); ++n) {
      const Between at_x = between(frequency * x[n], octave_period);
      if (at_x.low != known) corner = corners(at_x, at_y, at_z);
      known = at_x.low;
      sums[n] += amplitude * blend(corner, at_x.weight, at_y.weight, at_z.weight);
    }
    amplitude *= persistence;
    frequency *= 2.0;
  }
}

}  // namespace swell::texture
