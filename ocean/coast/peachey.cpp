#include "ocean/coast/peachey.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"

namespace swell::ocean {
namespace {

// h / L0 of water that is `part` of the local wavelength deep: L = L0 tanh(k h).
double depth_over_deep_length(double part) { return part * tanh(kTwoPi * part); }

double deep_length_m(const WaveTrain& train) {
  return train.gravity_mps2 * train.period_s * train.period_s / kTwoPi;
}

// 0, 1, ..., count - 1 in an order drawn from the seed (Fisher and Yates).
std::array<int, kMaxTrains> shuffled(int count, std::uint64_t seed) {
  std::array<int, kMaxTrains> order{};
  for (int n = 0; n < count; ++n) order[n] = n;
  for (int n = count - 1; n > 0; --n) {
    const double u = random_uniform(seed, 1000 + static_cast<std::uint64_t>(n));
    std::swap(order[n], order[static_cast<int>(u * (n + 1))]);
  }
  return order;
}

// Bilinear coefficients of four corner values.
struct Bilinear {
  double c0, c1, c2, c3;
};
Bilinear bilinear_of(double v00, double v10, double v01, double v11) {
  return {v00, v10 - v00, v01 - v00, (v11 - v01) - (v10 - v00)};
}

void store(const Bilinear& b, double c0, float* out) {
  out[0] = static_cast<float>(c0);
  out[1] = static_cast<float>(b.c1);
  out[2] = static_cast<float>(b.c2);
  out[3] = static_cast<float>(b.c3);
}

// Sample numbers of a cell's corners; a grid one sample wide has cells without width.
std::array<std::size_t, 4> cell_corners(const terrain::Grid& grid, int i, int j) {
  const int i1 = std::min(i + 1, grid.samples_x - 1), j1 = std::min(j + 1, grid.samples_y - 1);
  return {grid.index(i, j), grid.index(i1, j), grid.index(i, j1), grid.index(i1, j1)};
}

// value(sample): of the corners.
Bilinear cell_bilinear(const std::array<std::size_t, 4>& corners, auto value) {
  return bilinear_of(value(corners[0]), value(corners[1]), value(corners[2]), value(corners[3]));
}

// Turns relative amplitudes into metres, and limits their sum to what the depth carries, for the
// samples first to end. Returns the largest sum.
double break_waves(const terrain::HeightGrid& floor, std::span<const WaveTrain> trains,
                   std::span<WavePhase> phases, std::size_t first, std::size_t end) {
  double largest = 0.0;
  for (std::size_t n = first; n < end; ++n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < trains.size(); ++i) {
      sum += trains[i].amplitude_m * static_cast<double>(phases[i].amplitude[n]);
    }
    const double factor = breaking_factor(sum, depth_of_sample(floor, n));
    for (std::size_t i = 0; i < trains.size(); ++i) {
      float& a = phases[i].amplitude[n];
      a = static_cast<float>(trains[i].amplitude_m * static_cast<double>(a) * factor);
    }
    largest = std::max(largest, sum * factor);
  }
  return largest;
}

// The largest length of a bilinear function's gradient, per sample spacing.
double steepest(const Bilinear& b) {
  const double by_x = std::max(std::abs(b.c1), std::abs(b.c1 + b.c3));
  const double by_y = std::max(std::abs(b.c2), std::abs(b.c2 + b.c3));
  return std::sqrt(by_x * by_x + by_y * by_y);
}

double largest(const Bilinear& b) {
  return std::max({b.c0, b.c0 + b.c1, b.c0 + b.c2, b.c0 + b.c1 + b.c2 + b.c3});
}

double smallest(const Bilinear& b) { return -largest({-b.c0, -b.c1, -b.c2, -b.c3}); }

// A bound on |grad (A w)| per sample spacing in one cell, for z = A w(theta, h):
//   w grad A + A (dw/dtheta grad theta + dw/db db/dh grad h), b the blend of the two profiles.
// Their slopes are at most 2 pi and 8; they differ by at most 0.611, and |db/dh| is at most 1.5
// over the depths between them.
double train_slope_bound(const TrainSea& sea, std::size_t train, const Bilinear& theta,
                         const Bilinear& amplitude, const Bilinear& depth) {
  const auto deep_m = static_cast<double>(sea.deep_depth_m[train]),
             shallow_m = static_cast<double>(sea.shallow_depth_m[train]);
  const double by_theta = kTwoPi + shore_part(smallest(depth), deep_m, shallow_m) * (8.0 - kTwoPi);
  const double by_depth = 0.611 * 1.5 / (deep_m - shallow_m);
  return steepest(amplitude) +
         largest(amplitude) * (by_theta * steepest(theta) + by_depth * steepest(depth));
}

// Fills a row of cells and returns a bound on the slope of all trains together there.
double fill_row(const terrain::HeightGrid& floor, std::span<const WavePhase> phases, int j,
                TrainSea& sea) {
  const std::size_t cell = static_cast<std::size_t>(j) * static_cast<std::size_t>(sea.cells_x);
  float* wave = sea.waves.data() + cell * 8 * phases.size();
  float* depth = sea.depth.data() + cell * 4;
  double slope_bound = 0.0;
  const auto values_of = [](const auto& samples) {
    return [&samples](std::size_t n) { return static_cast<double>(samples[n]); };
  };
  for (int i = 0; i < sea.cells_x; ++i) {
    const auto corners = cell_corners(floor.grid, i, j);
    const Bilinear h =
        cell_bilinear(corners, [&](std::size_t n) { return depth_of_sample(floor, n); });
    store(h, h.c0, depth);
    depth += 4;
    double slope = 0.0;
    for (std::size_t train = 0; train < phases.size(); ++train) {
      const Bilinear theta = cell_bilinear(corners, values_of(phases[train].cycles));
      const Bilinear amplitude = cell_bilinear(corners, values_of(phases[train].amplitude));
      store(theta, theta.c0 - std::floor(theta.c0), wave);
      store(amplitude, amplitude.c0, wave + 4);
      wave += 8;
      slope += train_slope_bound(sea, train, theta, amplitude, h);
    }
    slope_bound = std::max(slope_bound, slope / floor.grid.spacing_m);
  }
  return slope_bound;
}

void set_trains(std::span<const WaveTrain> trains, TrainSea& sea) {
  sea.trains = static_cast<int>(trains.size());
  for (const WaveTrain& train : trains) {
    const ProfileDepths depths = profile_depths(deep_length_m(train));
    sea.period_s.push_back(train.period_s);
    sea.gravity_mps2.push_back(train.gravity_mps2);
    sea.deep_depth_m.push_back(static_cast<float>(depths.deep_m));
    sea.shallow_depth_m.push_back(static_cast<float>(depths.shallow_m));
  }
}

}  // namespace

std::vector<WaveTrain> make_trains(const WaveSystem& system, int count, std::uint64_t seed) {
  SWELL_CHECK(count >= 1 && count <= kMaxTrains, "count={}", count);
  std::vector<WaveTrain> trains(static_cast<std::size_t>(count));
  const std::array<int, kMaxTrains> direction_bin = shuffled(count, seed);
  // A calm has no peak: any will do for waves without height.
  const double peak_hz = system.peak_hz > 0.0 ? system.peak_hz : 1.0;
  const double m0 = variance_below(system, std::numeric_limits<double>::infinity());
  for (int n = 0; n < count; ++n) {
    const auto uniform = [&](std::uint64_t k) {
      return random_uniform(seed, 3 * static_cast<std::uint64_t>(n) + k);
    };
    WaveTrain& train = trains[static_cast<std::size_t>(n)];
    const double part = kBandBegin + (kBandEnd - kBandBegin) * (n + uniform(0)) / count;
    const double f_over_peak = frequency_of_energy(system, part);
    const double angle =
        angle_of_energy(spreading_of(system, f_over_peak), (direction_bin[n] + uniform(1)) / count);
    train.amplitude_m = std::sqrt(2.0 * m0 * (kBandEnd - kBandBegin) / count);
    train.period_s = 1.0 / (f_over_peak * peak_hz);
    train.travel = glm::normalize(turned(system.travel, angle));
    train.phase_cycles = uniform(2);
    train.gravity_mps2 = system.gravity_mps2;
  }
  return trains;
}

std::vector<WaveTrain> make_trains(std::span<const WaveSystem> systems, int count,
                                   std::uint64_t seed) {
  const int spare = count - static_cast<int>(systems.size());
  SWELL_CHECK(!systems.empty() && spare >= 0, "{} trains of {} systems", count, systems.size());
  std::vector<double> height;
  for (const WaveSystem& system : systems)
    height.push_back(std::sqrt(variance_below(system, std::numeric_limits<double>::infinity())));
  std::vector<int> trains(systems.size(), 1);
  // The next train goes to the system that has the fewest for its height.
  for (int n = 0; n < spare; ++n) {
    std::size_t most = 0;
    for (std::size_t s = 1; s < systems.size(); ++s)
      if (height[s] * trains[most] > height[most] * trains[s]) most = s;
    ++trains[most];
  }
  std::vector<WaveTrain> all;
  for (std::size_t s = 0; s < systems.size(); ++s)
    for (const WaveTrain& train : make_trains(systems[s], trains[s], seed + s))
      all.push_back(train);
  return all;
}

ProfileDepths profile_depths(double deep_length_m) {
  return {deep_length_m * depth_over_deep_length(0.25),
          deep_length_m * depth_over_deep_length(0.05)};
}

TrainSea make_train_sea(const terrain::HeightGrid& floor, std::span<const WaveTrain> trains,
                        PhaseMethod method, Workers& workers,
                        std::span<const std::vector<float>> kept) {
  check_sea_floor(floor);
  if (trains.size() > static_cast<std::size_t>(kMaxTrains)) {
    throw std::invalid_argument(
        fmt::format("{} wave trains, at most {}", trains.size(), kMaxTrains));
  }
  TrainSea sea;
  sea.grid = floor.grid;
  sea.cells_x = std::max(floor.grid.samples_x - 1, 1);
  sea.cells_y = std::max(floor.grid.samples_y - 1, 1);
  const std::size_t cells =
      static_cast<std::size_t>(sea.cells_x) * static_cast<std::size_t>(sea.cells_y);
  if (cells * 8 * std::max<std::size_t>(trains.size(), 1) > 0x7fffffffu) {
    throw std::invalid_argument(
        fmt::format("{} wave trains over {} cells, at most 2^28 in all", trains.size(), cells));
  }
  set_trains(trains, sea);
  // One phase a train.
  std::vector<WavePhase> phases(trains.size());
  workers.for_each(trains.size(), [&](std::size_t i, int) {
    phases[i] = make_wave_phase(floor, trains[i], method);
    if (kept.empty()) return;
    for (std::size_t k = 0; k < kept[i].size(); ++k) phases[i].amplitude[k] *= kept[i][k];
  });
  std::vector<double> largest(static_cast<std::size_t>(floor.grid.samples_y));
  workers.for_each(largest.size(), [&](std::size_t j, int) {
    const std::size_t first = floor.grid.index(0, static_cast<int>(j));
    largest[j] = break_waves(floor, trains, phases, first, first + floor.grid.samples_x);
  });
  sea.height_bound_m = static_cast<float>(std::ranges::max(largest) * (1.0 + 1e-6));
  // Cells.
  sea.depth.resize(cells * 4);
  sea.waves.resize(cells * 8 * trains.size());
  std::vector<double> steepest_row(static_cast<std::size_t>(sea.cells_y));
  workers.for_each(steepest_row.size(), [&](std::size_t j, int) {
    steepest_row[j] = fill_row(floor, phases, static_cast<int>(j), sea);
  });
  sea.slope_bound = static_cast<float>(std::ranges::max(steepest_row) * (1.0 + 1e-4));
  return sea;
}

}  // namespace swell::ocean
