#include "ocean/open_sea/wave_automaton.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"

namespace swell::ocean {
namespace {

constexpr int kSoftenings = 6;  // of heights: a wave of 4 cells keeps 1/64, one of 12 two thirds

struct Neighbours {
  int less, more;
};
Neighbours neighbours(int i, int size) {
  return {i == 0 ? size - 1 : i - 1, i + 1 == size ? 0 : i + 1};
}

// Calls body(cell, value of Lap field) for each cell in turn.
template <class Body>
void for_each_laplacian(const std::vector<double>& field, int size, Body body) {
  for (int j = 0; j < size; ++j) {
    const Neighbours rows = neighbours(j, size);
    const double* const south = field.data() + static_cast<std::ptrdiff_t>(rows.less) * size;
    const double* const here = field.data() + static_cast<std::ptrdiff_t>(j) * size;
    const double* const north = field.data() + static_cast<std::ptrdiff_t>(rows.more) * size;
    for (int i = 0; i < size; ++i) {
      const auto [west, east] = neighbours(i, size);
      const double sides = (south[i] + north[i]) + (here[west] + here[east]);
      const double corners = (south[west] + north[east]) + (south[east] + north[west]);
      body(static_cast<std::size_t>(j) * size + i,
           (corners + 4.0 * sides - 20.0 * here[i]) * (1.0 / 6.0));
    }
  }
}

// The variance of a wave in the spectrum of gusts, not scaled.
double gust_variance(const Gusts& gusts, int x, int y) {
  const double waves = std::sqrt(static_cast<double>(x * x + y * y));
  if (waves == 0.0 || waves > gusts.most_waves) return 0.0;
  const SinCos to = sin_cos_turns(gusts.to_rad / kTwoPi);
  const double cosine = (x * to.sin + y * to.cos) / waves;
  const double half2 = 0.5 * (1.0 + cosine);  // cos^2(theta / 2)
  const double peaks = waves / gusts.peak_waves;
  const double inverse2 = 1.0 / (peaks * peaks);
  return inverse2 * inverse2 * exp(-2.0 * inverse2) * pow(half2, gusts.spreading);
}

// The waves of gusts as complex amplitudes at (x + most, y + most), of variance 1 together.
std::vector<std::complex<double>> draw_gusts(const Gusts& gusts) {
  const int most = gusts.most_waves, side = 2 * most + 1;
  std::vector<std::complex<double>> amplitudes(static_cast<std::size_t>(side) * side);
  double sum = 0.0;
  for (int y = -most; y <= most; ++y)
    for (int x = -most; x <= most; ++x) sum += gust_variance(gusts, x, y);
  for (int y = -most; y <= most; ++y) {
    for (int x = -most; x <= most; ++x) {
      const auto at = static_cast<std::size_t>((y + most) * side + x + most);
      const GaussianPair pair = random_gaussian_pair(
          gusts.seed, static_cast<std::uint64_t>((y + 1024) * 4096 + x + 1024));
      const double deviation = std::sqrt(gust_variance(gusts, x, y) / sum);
      amplitudes[at] = {deviation * pair.first, deviation * pair.second};
    }
  }
  return amplitudes;
}

// Adds the real part of the sum of a(x, y) e^(2 pi i (x i + y j) / size), rows first.
void add_waves(const std::vector<std::complex<double>>& amplitudes, int most, int size,
               std::vector<double>& heights) {
  const int side = 2 * most + 1;
  std::vector<std::complex<double>> turn(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    const SinCos angle = sin_cos_turns(static_cast<double>(i) / size);
    turn[static_cast<std::size_t>(i)] = {angle.cos, angle.sin};
  }
  const auto turned = [&](int waves, int i) {
    return turn[static_cast<std::size_t>(((waves * i) % size + size) % size)];
  };
  std::vector<std::complex<double>> row(static_cast<std::size_t>(side));
  for (int j = 0; j < size; ++j) {
    std::ranges::fill(row, 0.0);
    for (int y = 0; y < side; ++y) {
      const std::complex<double> factor = turned(y - most, j);
      for (int x = 0; x < side; ++x)
        row[static_cast<std::size_t>(x)] +=
            amplitudes[static_cast<std::size_t>(y * side + x)] * factor;
    }
    for (int i = 0; i < size; ++i) {
      double sum = 0.0;
      for (int x = 0; x < side; ++x)
        sum += (row[static_cast<std::size_t>(x)] * turned(x - most, i)).real();
      heights[static_cast<std::size_t>(j * size + i)] += sum;
    }
  }
}

// [1 2 1] / 4 along rows and columns.
void soften(std::vector<double>& heights, int size) {
  std::vector<double> rows(heights.size());
  const auto at = [size](int i, int j) { return static_cast<std::size_t>(j) * size + i; };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const auto [west, east] = neighbours(i, size);
      rows[at(i, j)] =
          0.25 * (heights[at(west, j)] + heights[at(east, j)]) + 0.5 * heights[at(i, j)];
    }
  for (int j = 0; j < size; ++j) {
    const auto [south, north] = neighbours(j, size);
    for (int i = 0; i < size; ++i)
      heights[at(i, j)] = 0.25 * (rows[at(i, south)] + rows[at(i, north)]) + 0.5 * rows[at(i, j)];
  }
}

void add_at_rest(const std::vector<double>& heights, WaveAutomaton& automaton) {
  for (std::size_t i = 0; i < heights.size(); ++i) {
    automaton.now[i] += heights[i];
    automaton.before[i] += heights[i];
  }
}

}  // namespace

WaveAutomaton make_automaton(int size, double courant) {
  if (size < kMinAutomatonSize || size > kMaxAutomatonSize)
    throw std::invalid_argument(fmt::format("automaton size: got {}, allowed {} to {} cells", size,
                                            kMinAutomatonSize, kMaxAutomatonSize));
  if (!(courant > 0.0 && courant <= kMostCourant))  // NaN fails
    throw std::invalid_argument(fmt::format(
        "Courant number: got {}, allowed over 0 to {}, beyond which waves grow without end",
        courant, kMostCourant));
  const auto cells = static_cast<std::size_t>(size) * size;
  return {size, courant, std::vector<double>(cells), std::vector<double>(cells)};
}

void step(WaveAutomaton& automaton) {
  const double c2 = automaton.courant * automaton.courant;
  for_each_laplacian(automaton.now, automaton.size, [&](std::size_t i, double laplacian) {
    automaton.before[i] = (2.0 * automaton.now[i] - automaton.before[i]) + c2 * laplacian;
  });
  automaton.now.swap(automaton.before);
}

double energy(const WaveAutomaton& automaton) {
  const double c2 = automaton.courant * automaton.courant;
  double sum = 0.0;
  for_each_laplacian(automaton.before, automaton.size, [&](std::size_t i, double laplacian) {
    const double rise = automaton.now[i] - automaton.before[i];
    sum += rise * rise - c2 * automaton.now[i] * laplacian;
  });
  return sum;
}

double turns_per_step(const WaveAutomaton& automaton, double waves_x, double waves_y) {
  const double cos_x = sin_cos_turns(waves_x / automaton.size).cos;
  const double cos_y = sin_cos_turns(waves_y / automaton.size).cos;
  const double laplacian = (8.0 * (cos_x + cos_y) + 4.0 * cos_x * cos_y - 20.0) / 6.0;
  const double sin2 = -0.25 * automaton.courant * automaton.courant * laplacian;
  // sin^2(a / 2) = (1 - cos a) / 2.
  return acos(1.0 - 2.0 * sin2) / kTwoPi;
}

void remove_mean(std::span<double> heights) {
  double sum = 0.0;
  for (const double height : heights) sum += height;
  const double mean = sum / static_cast<double>(heights.size());
  for (double& height : heights) height -= mean;
}

void add_drops(WaveAutomaton& automaton, int count, double radius_cells, std::uint64_t seed) {
  SWELL_CHECK(count > 0 && count <= 10000 && radius_cells >= 1.0 && radius_cells <= 64.0,
              "count={} radius_cells={}", count, radius_cells);
  const int size = automaton.size;
  std::vector<double> heights(automaton.now.size()), across(static_cast<std::size_t>(size));
  std::vector<double> along(static_cast<std::size_t>(size));
  for (int drop = 0; drop < count; ++drop) {
    const auto profile = [&](std::uint64_t number, std::vector<double>& values) {
      const double middle = size * random_uniform(seed, number);
      for (int i = 0; i < size; ++i) {
        const double straight = std::abs(i - middle);
        const double away = std::min(straight, size - straight) / radius_cells;
        values[static_cast<std::size_t>(i)] = exp(-0.5 * away * away);
      }
    };
    profile(2 * static_cast<std::uint64_t>(drop), across);
    profile(2 * static_cast<std::uint64_t>(drop) + 1, along);
    const double sign = drop % 2 == 0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < heights.size(); ++i)
      heights[i] += sign * across[i % static_cast<std::size_t>(size)] *
                    along[i / static_cast<std::size_t>(size)];
  }
  remove_mean(heights);
  add_at_rest(heights, automaton);
}

void add_gusts(WaveAutomaton& automaton, const Gusts& gusts) {
  const int size = automaton.size, most = gusts.most_waves;
  SWELL_CHECK(most >= 1 && most <= size / 4, "most_waves={} size={}", most, size);
  SWELL_CHECK(gusts.peak_waves >= 1.0 && gusts.spreading >= 0.0 && gusts.spreading <= 50.0,
              "peak_waves={} spreading={}", gusts.peak_waves, gusts.spreading);
  std::vector<std::complex<double>> amplitudes = draw_gusts(gusts);
  add_waves(amplitudes, most, size, automaton.now);
  // Waves that travel: each has turned less a step before.
  const int side = 2 * most + 1;
  for (int y = -most; y <= most; ++y)
    for (int x = -most; x <= most; ++x) {
      const SinCos angle = sin_cos_turns(turns_per_step(automaton, x, y));
      amplitudes[static_cast<std::size_t>((y + most) * side + x + most)] *=
          std::complex<double>(angle.cos, angle.sin);
    }
  add_waves(amplitudes, most, size, automaton.before);
}

void add_heights(WaveAutomaton& automaton, std::span<const float> heights) {
  SWELL_CHECK(heights.size() == automaton.now.size(), "{} heights for {} cells", heights.size(),
              automaton.now.size());
  std::vector<double> soft(heights.begin(), heights.end());
  for (int i = 0; i < kSoftenings; ++i) soften(soft, automaton.size);
  remove_mean(soft);
  add_at_rest(soft, automaton);
}

}  // namespace swell::ocean
