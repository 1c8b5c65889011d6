#include "ocean/coast/wave_phase.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "math/elementary.h"
#include "ocean/coast/eikonal.h"
#include "ocean/spectrum/dispersion.h"
#include "ocean/spectrum/wave_numbers.h"

namespace swell::ocean {
namespace {

void check_train(const WaveTrain& train) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(train.amplitude_m >= 0.0 && std::isfinite(train.amplitude_m),
          fmt::format("wave amplitude {} m, must be at least 0", train.amplitude_m));
  require(train.period_s > 0.0 && std::isfinite(train.period_s),
          fmt::format("wave period {} s, must be positive", train.period_s));
  require(
      std::abs(glm::length(train.travel) - 1.0) < 1e-6,
      fmt::format("wave direction ({}, {}), must have length 1", train.travel.x, train.travel.y));
  require(std::isfinite(train.phase_cycles),
          fmt::format("wave phase {} cycles", train.phase_cycles));
  require(train.gravity_mps2 > 0.0 && std::isfinite(train.gravity_mps2),
          fmt::format("gravity {} m/s^2, must be positive", train.gravity_mps2));
}

double omega_of(const WaveTrain& train) { return kTwoPi / train.period_s; }

// k at a depth, rad/m.
double local_wave_number(const WaveTrain& train, double depth_m) {
  return wave_number(omega_of(train), std::max(depth_m, kShallowestDepth), train.gravity_mps2);
}

// k and the shoaling coefficient Ks for the samples of one row of a floor after the other; land
// counts as the shallowest water.
class RowWaves {
 public:
  RowWaves(const terrain::HeightGrid& floor, const WaveTrain& train)
      : floor_(floor),
        train_(train),
        depth_m_(static_cast<std::size_t>(floor.grid.samples_x)),
        values_(depth_m_.size()) {}

  std::span<const double> numbers(int j) {
    const std::size_t first = floor_.grid.index(0, j);
    for (std::size_t i = 0; i < depth_m_.size(); ++i)
      depth_m_[i] = std::max(depth_of_sample(floor_, first + i), kShallowestDepth);
    wave_numbers(omega_of(train_), train_.gravity_mps2, depth_m_, values_);
    return values_;
  }

  std::span<const double> shoaling(int j) {
    numbers(j);
    shoaling_coefficients(values_, depth_m_, values_);
    return values_;
  }

 private:
  const terrain::HeightGrid& floor_;
  const WaveTrain& train_;
  std::vector<double> depth_m_, values_;
};

// amplitude = amplitude_of(sample, Ks there).
template <class AmplitudeOf>
void set_amplitude(const terrain::HeightGrid& floor, const WaveTrain& train, WavePhase& phase,
                   AmplitudeOf amplitude_of) {
  phase.amplitude.resize(floor.grid.size());
  RowWaves waves(floor, train);
  for (int j = 0; j < floor.grid.samples_y; ++j) {
    const std::span<const double> shoaling = waves.shoaling(j);
    const std::size_t first = floor.grid.index(0, j);
    for (std::size_t i = 0; i < shoaling.size(); ++i)
      phase.amplitude[first + i] = static_cast<float>(amplitude_of(first + i, shoaling[i]));
  }
}

// Phase of the deep-water wave, in cycles.
double deep_cycles(const WaveTrain& train, glm::dvec2 p) {
  return local_wave_number(train, kInfinity<double>) * glm::dot(train.travel, p) / kTwoPi +
         train.phase_cycles;
}

// ---- Straight lines of travel

// A stretch of a line of travel: the phase where it begins, k at both ends, the depth midway.
struct Stretch {
  double cycles, length_m, k_begin, k_end, middle_depth_m;
};

// The phase where the stretch ends, with (1 / 2 pi) integral of k along it by Simpson's rule.
double end_cycles(const Stretch& s, double k_middle) {
  return s.cycles + s.length_m * (s.k_begin + 4.0 * k_middle + s.k_end) / (6.0 * kTwoPi);
}

// theta at sample (i, j) from the samples one grid line upstream. The main axis is the one the
// wave mostly travels along; the line through (i, j) meets the line of samples before it between
// two of them, or leaves the grid.
class StraightMarch {
 public:
  StraightMarch(const terrain::HeightGrid& floor, const WaveTrain& train,
                std::vector<double>& cycles)
      : floor_(floor),
        train_(train),
        cycles_(cycles),
        x_main_(std::abs(train.travel.x) >= std::abs(train.travel.y)),
        main_(x_main_ ? train.travel.x : train.travel.y),
        shift_((x_main_ ? train.travel.y : train.travel.x) / std::abs(main_)) {
    k_.reserve(floor.grid.size());
    RowWaves waves(floor, train);
    for (int j = 0; j < floor.grid.samples_y; ++j) {
      const std::span<const double> row = waves.numbers(j);
      k_.insert(k_.end(), row.begin(), row.end());
    }
  }

  void run() {
    const terrain::Grid& grid = floor_.grid;
    const int lines = x_main_ ? grid.samples_x : grid.samples_y;
    const int across = x_main_ ? grid.samples_y : grid.samples_x;
    std::vector<Stretch> stretch(static_cast<std::size_t>(across));
    std::vector<double> middle_m(stretch.size()), k_middle(stretch.size());
    for (int n = 0; n < lines; ++n) {
      const int line = main_ > 0.0 ? n : lines - 1 - n;
      for (int a = 0; a < across; ++a) {
        stretch[a] = n == 0 ? enter(line, a, 0.0) : step(line, a, across);
        middle_m[a] = std::max(stretch[a].middle_depth_m, kShallowestDepth);
      }
      wave_numbers(omega_of(train_), train_.gravity_mps2, middle_m, k_middle);
      for (int a = 0; a < across; ++a)
        cycles_[index(line, a)] = end_cycles(stretch[a], k_middle[a]);
    }
  }

 private:
  std::size_t index(int line, int a) const {
    return x_main_ ? floor_.grid.index(line, a) : floor_.grid.index(a, line);
  }
  glm::dvec2 point(double line, double a) const {
    return lattice_point(floor_.grid.min_world, floor_.grid.spacing_m,
                         x_main_ ? glm::dvec2(line, a) : glm::dvec2(a, line));
  }

  Stretch stretch_to(int line, int a, glm::dvec2 begin, double cycles, double k_begin) const {
    const glm::dvec2 end = point(line, a);
    return {cycles, glm::length(end - begin), k_begin, k_[index(line, a)],
            depth_at(floor_, 0.5 * (begin + end))};
  }

  // The line entered the grid `back` grid lines before the sample.
  Stretch enter(int line, int a, double back) const {
    const glm::dvec2 entry =
        point(line, a) - train_.travel * (back * floor_.grid.spacing_m / std::abs(main_));
    return stretch_to(line, a, entry, deep_cycles(train_, entry),
                      local_wave_number(train_, depth_at(floor_, entry)));
  }

  Stretch step(int line, int a, int across) const {
    const double upstream_a = a - shift_;
    if (upstream_a < 0.0) return enter(line, a, a / shift_);
    if (upstream_a > across - 1) return enter(line, a, (across - 1 - a) / -shift_);
    // Between two samples of the line before.
    const int upstream = main_ > 0.0 ? line - 1 : line + 1;
    const int a0 = std::min(static_cast<int>(upstream_a), std::max(across - 2, 0));
    const int a1 = std::min(a0 + 1, across - 1);
    const double f = upstream_a - a0;
    const std::size_t n0 = index(upstream, a0), n1 = index(upstream, a1);
    return stretch_to(line, a, point(upstream, upstream_a),
                      cycles_[n0] + f * (cycles_[n1] - cycles_[n0]),
                      k_[n0] + f * (k_[n1] - k_[n0]));
  }

  const terrain::HeightGrid& floor_;
  const WaveTrain& train_;
  std::vector<double>& cycles_;
  bool x_main_;
  double main_, shift_;  // travel along the main axis; samples across per grid line
  std::vector<double> k_;
};

WavePhase make_straight_phase(const terrain::HeightGrid& floor, const WaveTrain& train) {
  WavePhase phase;
  phase.cycles.resize(floor.grid.size());
  StraightMarch(floor, train, phase.cycles).run();
  set_amplitude(floor, train, phase, [&](std::size_t n, double shoaling) {
    return depth_of_sample(floor, n) > 0.0 ? shoaling : 0.0;
  });
  return phase;
}

// ---- The eikonal equation

// A wave that has come over straight contours from deep water.
struct RefractedWave {
  glm::dvec2 k_rad_m;
  double energy;  // Kr^2
};

// Snell's law: k along the contours is the deep-water wave's. `uphill` is the unit normal of the
// contours, 0 on a flat floor, where the wave keeps its direction.
RefractedWave refract(const WaveTrain& train, glm::dvec2 uphill, double depth_m) {
  const double k = local_wave_number(train, depth_m);
  const double across = glm::dot(train.travel, uphill);
  if (std::abs(across) < 1e-6) return {k * train.travel, 1.0};
  const glm::dvec2 along(-uphill.y, uphill.x);
  const double k_along =
      local_wave_number(train, kInfinity<double>) * glm::dot(train.travel, along);
  const double k_across = std::sqrt(std::max(k * k - k_along * k_along, 0.0));
  const double energy = std::abs(across) * k / std::max(k_across, 1e-6 * k);
  return {k_along * along + std::copysign(k_across, across) * uphill, std::min(energy, kMaxFocus)};
}

// A border of the grid: samples start + n step, n in [0, count).
struct Border {
  glm::ivec2 start, step;
  int count;
};

// Mean direction in which the floor rises along a border; 0 if it is flat there.
glm::dvec2 mean_uphill(const terrain::HeightGrid& floor, const Border& border) {
  glm::dvec2 sum(0.0);
  double depth = 0.0;
  for (int n = 0; n < border.count; ++n) {
    const glm::ivec2 at = border.start + n * border.step;
    const double h = depth_of_sample(floor, floor.grid.index(at.x, at.y));
    if (!(h > 0.0)) continue;
    sum += slope_at(floor, floor.grid.point(at.x, at.y));
    depth += h;
  }
  // Flat: the whole grid's width changes the depth by less than 1 %.
  const int width = std::max(floor.grid.samples_x, floor.grid.samples_y);
  const double change = glm::length(sum) * floor.grid.spacing_m * width;
  return change > 0.01 * depth ? glm::normalize(sum) : glm::dvec2(0.0);
}

// Gives the eikonal problem its values on a border that the wave comes in through; inward is the
// border's normal. theta is integrated along the border from its value at the start.
void set_border(const terrain::HeightGrid& floor, const WaveTrain& train, const Border& border,
                glm::dvec2 inward, EikonalProblem& problem) {
  const terrain::Grid& grid = floor.grid;
  const glm::dvec2 uphill = mean_uphill(floor, border);
  double cycles = deep_cycles(train, grid.point(border.start.x, border.start.y));
  double rate_before = 0.0;
  for (int n = 0; n < border.count; ++n) {
    const glm::ivec2 at = border.start + n * border.step;
    const std::size_t sample = grid.index(at.x, at.y);
    const double depth = depth_of_sample(floor, sample);
    const RefractedWave wave = refract(train, uphill, depth > 0.0 ? depth : kInfinity<double>);
    const double rate = glm::dot(wave.k_rad_m, glm::dvec2(border.step)) * grid.spacing_m / kTwoPi;
    if (n > 0) cycles += 0.5 * (rate_before + rate);
    rate_before = rate;
    const double in = glm::dot(wave.k_rad_m, inward);
    if (!(depth > 0.0) || !(in > 1e-9 * glm::length(wave.k_rad_m))) continue;
    problem.source[sample] = cycles;
    problem.source_energy[sample] = wave.energy;
  }
}

EikonalProblem make_problem(const terrain::HeightGrid& floor, const WaveTrain& train) {
  const terrain::Grid& grid = floor.grid;
  EikonalProblem problem{grid, std::vector<double>(grid.size(), 0.0),
                         std::vector<double>(grid.size(), kInfinity<double>),
                         std::vector<double>(grid.size(), 0.0)};
  RowWaves waves(floor, train);
  for (int j = 0; j < grid.samples_y; ++j) {
    const std::span<const double> k = waves.numbers(j);
    for (std::size_t i = 0; i < k.size(); ++i) {
      const std::size_t n = grid.index(0, j) + i;
      if (depth_of_sample(floor, n) > 0.0) problem.slowness[n] = k[i] / kTwoPi;
    }
  }
  // The two borders at the corner that the wave reaches first.
  const glm::ivec2 inward(train.travel.x >= 0.0 ? 1 : -1, train.travel.y >= 0.0 ? 1 : -1);
  const glm::ivec2 corner(inward.x > 0 ? 0 : grid.samples_x - 1,
                          inward.y > 0 ? 0 : grid.samples_y - 1);
  set_border(floor, train, {corner, {0, inward.y}, grid.samples_y}, glm::dvec2(inward.x, 0),
             problem);
  set_border(floor, train, {corner, {inward.x, 0}, grid.samples_x}, glm::dvec2(0, inward.y),
             problem);
  return problem;
}

// The mean of what the waves at the eight neighbours of a sample without any become there, each
// carried on along its own slope; 0 if there are none.
double continued_cycles(const terrain::Grid& grid, const std::vector<double>& cycles, int i,
                        int j) {
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < grid.samples_x && y < grid.samples_y;
    return inside ? cycles[grid.index(x, y)] : kInfinity<double>;
  };
  double sum = 0.0;
  int count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const double near = at(i + dx, j + dy);
      if (near == kInfinity<double>) continue;
      const double beyond = at(i + 2 * dx, j + 2 * dy);
      sum += beyond < kInfinity<double> ? 2.0 * near - beyond : near;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

// Replaces infinite phases.
void continue_onto_land(const terrain::Grid& grid, std::vector<double>& cycles) {
  std::vector<double> filled(cycles);
  for (int j = 0; j < grid.samples_y; ++j) {
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t n = grid.index(i, j);
      if (cycles[n] == kInfinity<double>) filled[n] = continued_cycles(grid, cycles, i, j);
    }
  }
  cycles.swap(filled);
}

WavePhase make_eikonal_phase(const terrain::HeightGrid& floor, const WaveTrain& train) {
  const EikonalProblem problem = make_problem(floor, train);
  WavePhase phase;
  std::vector<double> energy;
  solve_eikonal(problem, phase.cycles);
  spread_energy(problem, phase.cycles, energy);
  set_amplitude(floor, train, phase, [&](std::size_t n, double shoaling) {
    return energy[n] > 0.0 ? shoaling * std::sqrt(energy[n]) : 0.0;
  });
  continue_onto_land(floor.grid, phase.cycles);
  return phase;
}

}  // namespace

WavePhase make_wave_phase(const terrain::HeightGrid& floor, const WaveTrain& train,
                          PhaseMethod method) {
  check_sea_floor(floor);
  check_train(train);
  return method == PhaseMethod::kStraight ? make_straight_phase(floor, train)
                                          : make_eikonal_phase(floor, train);
}

glm::dvec2 wave_vector_at(const terrain::Grid& grid, const WavePhase& phase, glm::dvec2 p_world) {
  // Central differences at a sample, one-sided on the border; 0 next to samples without waves.
  const auto slope = [&](int i, int j) {
    const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, grid.samples_x - 1);
    const int j0 = std::max(j - 1, 0), j1 = std::min(j + 1, grid.samples_y - 1);
    const auto cycles = [&](int x, int y) { return phase.cycles[grid.index(x, y)]; };
    for (const std::size_t n :
         {grid.index(i0, j), grid.index(i1, j), grid.index(i, j0), grid.index(i, j1)}) {
      if (phase.amplitude[n] == 0.0f) return glm::dvec2(0.0);
    }
    return glm::dvec2(i1 > i0 ? (cycles(i1, j) - cycles(i0, j)) / (i1 - i0) : 0.0,
                      j1 > j0 ? (cycles(i, j1) - cycles(i, j0)) / (j1 - j0) : 0.0);
  };
  const glm::dvec2 last(grid.samples_x - 1, grid.samples_y - 1);
  const glm::dvec2 u =
      glm::clamp((p_world - grid.min_world) / grid.spacing_m, glm::dvec2(0.0), last);
  const int i0 = static_cast<int>(u.x), j0 = static_cast<int>(u.y);
  const int i1 = std::min(i0 + 1, grid.samples_x - 1), j1 = std::min(j0 + 1, grid.samples_y - 1);
  const glm::dvec2 f = u - glm::dvec2(i0, j0);
  const glm::dvec2 below = glm::mix(slope(i0, j0), slope(i1, j0), f.x);
  const glm::dvec2 above = glm::mix(slope(i0, j1), slope(i1, j1), f.x);
  return glm::mix(below, above, f.y) * (kTwoPi / grid.spacing_m);
}

glm::dvec2 turned(glm::dvec2 travel, double angle_rad) {
  const double c = cos(angle_rad), s = sin(angle_rad);
  return {c * travel.x - s * travel.y, s * travel.x + c * travel.y};
}

double breaking_factor(double sum_m, double depth_m) {
  if (!(depth_m > 0.0)) return 0.0;
  const double most_m = 0.5 * kBreakingRatio * depth_m;
  return sum_m > most_m ? most_m / sum_m : 1.0;
}

}  // namespace swell::ocean
