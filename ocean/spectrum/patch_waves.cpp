#include "ocean/spectrum/patch_waves.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

#include "math/elementary.h"
#include "math/random.h"
#include "ocean/spectrum/dispersion.h"

namespace swell::ocean {
namespace {

// Points per axis for the integral over a cell: many where the spectrum's foot or the fan of
// directions is narrower than a cell, some where the band's edge cuts it, else its middle.
int cell_points(glm::ivec2 count, double k_rad_m, double dk_rad_m, WaveBand band) {
  if (std::max(std::abs(count.x), std::abs(count.y)) <= 8) return 8;
  const double half_diagonal = 0.7072 * dk_rad_m;
  const bool cut = std::abs(k_rad_m - band.low_rad_m) < half_diagonal ||
                   std::abs(k_rad_m - band.high_rad_m) < half_diagonal;
  return cut ? 4 : 1;
}

// Integral of S over the part inside the band of the cell centred on dk (count.x, count.y).
double cell_variance(std::span<const WaveSystem> systems, WaveBand band, glm::ivec2 count,
                     double dk_rad_m) {
  const double k_centre = dk_rad_m * std::sqrt(double(count.x * count.x + count.y * count.y));
  if (k_centre > band.high_rad_m + dk_rad_m || k_centre < band.low_rad_m - dk_rad_m) return 0.0;
  const int points = cell_points(count, k_centre, dk_rad_m, band);
  double sum = 0.0;
  for (int y = 0; y < points; ++y) {
    for (int x = 0; x < points; ++x) {
      const glm::dvec2 k = dk_rad_m * glm::dvec2(count.x + (x + 0.5) / points - 0.5,
                                                 count.y + (y + 0.5) / points - 0.5);
      const double k2 = k.x * k.x + k.y * k.y;
      const bool inside =
          k2 >= band.low_rad_m * band.low_rad_m && k2 < band.high_rad_m * band.high_rad_m;
      if (!inside) continue;
      for (const WaveSystem& system : systems) sum += wave_vector_spectrum(system, k);
    }
  }
  return sum * dk_rad_m * dk_rad_m / (points * points);
}

std::complex<double> unit_gaussian(std::uint64_t seed, int patch, glm::ivec2 count) {
  const auto word = [](int signed_count) {
    return static_cast<std::uint64_t>(signed_count + 4096);
  };
  const std::uint64_t patch_seed = random_bits(seed, static_cast<std::uint64_t>(patch));
  const GaussianPair pair = random_gaussian_pair(patch_seed, word(count.x) << 16 | word(count.y));
  return {pair.first, pair.second};
}

// a(k) of every FFT index, row-major.
std::vector<std::complex<double>> draw_amplitudes(std::span<const WaveSystem> systems,
                                                  WaveBand band, double length_m, int size,
                                                  double amplitude_scale, std::uint64_t seed,
                                                  int patch) {
  const double dk = 2.0 * kPi / length_m;
  std::vector<std::complex<double>> amplitudes(static_cast<std::size_t>(size) * size);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const glm::ivec2 count(wave_count(i, size), wave_count(j, size));
      if (i == size / 2 || j == size / 2 || count == glm::ivec2(0)) continue;
      const double variance = cell_variance(systems, band, count, dk);
      if (variance == 0.0) continue;
      // Real and imaginary part have variance 1/4 of the wave's: E|a|^2 = 1/2.
      amplitudes[static_cast<std::size_t>(j * size + i)] =
          unit_gaussian(seed, patch, count) * (0.5 * amplitude_scale * std::sqrt(variance));
    }
  }
  return amplitudes;
}

}  // namespace

glm::dvec2 wave_vector(int i, int j, int size, double length_m) {
  const double dk = 2.0 * kPi / length_m;
  return {dk * wave_count(i, size), dk * wave_count(j, size)};
}

PatchWaves make_patch_waves(std::span<const WaveSystem> systems, WaveBand band, double length_m,
                            int size, double amplitude_scale, std::uint64_t seed, int patch) {
  const auto amplitudes =
      draw_amplitudes(systems, band, length_m, size, amplitude_scale, seed, patch);
  const double gravity_mps2 = systems.front().gravity_mps2;
  PatchWaves waves;
  waves.length_m = length_m;
  waves.size = size;
  for (auto* table : {&waves.cos_re, &waves.sin_re, &waves.cos_im, &waves.sin_im}) {
    table->resize(amplitudes.size());
  }
  waves.turns_per_s.resize(amplitudes.size());
  for (int j = 0; j < size; ++j) {
    waves.k_rad_m.push_back(static_cast<float>(wave_vector(0, j, size, length_m).y));
    for (int i = 0; i < size; ++i) {
      const int i_opposite = (size - i) % size, j_opposite = (size - j) % size;
      const std::complex<double> a = amplitudes[static_cast<std::size_t>(j * size + i)];
      const std::complex<double> b =
          amplitudes[static_cast<std::size_t>(j_opposite * size + i_opposite)];
      if (a == 0.0 && b == 0.0) continue;
      const glm::dvec2 k = wave_vector(i, j, size, length_m);
      const double k2 = k.x * k.x + k.y * k.y;
      // a (c - i s) + conj(b) (c + i s); the sums are even in k, the differences odd, exactly.
      const std::size_t at = wave_position(i, j, size);
      waves.cos_re[at] = static_cast<float>(a.real() + b.real());
      waves.sin_re[at] = static_cast<float>(a.imag() + b.imag());
      waves.cos_im[at] = static_cast<float>(a.imag() - b.imag());
      waves.sin_im[at] = static_cast<float>(b.real() - a.real());
      waves.turns_per_s[at] = deep_water_omega(std::sqrt(k2), gravity_mps2) / (2.0 * kPi);
      // The real wave 2 |a| cos(...) has variance 2 |a|^2.
      waves.variance_m2 += 2.0 * std::norm(a);
      waves.variance_k_m += 2.0 * std::norm(a) * std::sqrt(k2);
      waves.slope_variance += 2.0 * std::norm(a) * k2;
      waves.reach =
          std::max({waves.reach, std::abs(wave_count(i, size)), std::abs(wave_count(j, size))});
    }
  }
  return waves;
}

}  // namespace swell::ocean
