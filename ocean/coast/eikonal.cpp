#include "ocean/coast/eikonal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "math/check.h"
#include "math/elementary.h"
#include "math/stop.h"

namespace swell::ocean {
namespace {

struct Axis {
  int dx, dy;
};
constexpr std::array<Axis, 2> kAxes{{{1, 0}, {0, 1}}};

// A sample's place in its grid.
struct Sample {
  int i, j;
};

// Values of a grid's samples within a rim of infinity, so that neighbours need no check.
class RimmedGrid {
 public:
  RimmedGrid(const terrain::Grid& grid, std::span<const double> values)
      : stride_(grid.samples_x + 2),
        values_(static_cast<std::size_t>(stride_) * (grid.samples_y + 2), kInfinity<double>) {
    for (int j = 0; j < grid.samples_y; ++j) {
      const auto row = values.subspan(grid.index(0, j), static_cast<std::size_t>(grid.samples_x));
      std::ranges::copy(row, at(0, j));
    }
  }

  int stride() const { return stride_; }  // from row to row
  double* at(int i, int j) { return values_.data() + index(i, j); }
  const double* at(int i, int j) const { return values_.data() + index(i, j); }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j + 1) * stride_ + (i + 1);
  }

 private:
  int stride_;
  std::vector<double> values_;
};

// Godunov's upwind solution from the smaller neighbour along each axis; step = slowness x spacing.
double first_order_update(double a, double b, double step) {
  if (a > b) std::swap(a, b);
  const double difference = b - a;
  if (!(difference < step)) return a + step;
  return 0.5 * (a + b + std::sqrt(2.0 * step * step - difference * difference));
}

// ---- First arrivals

// Sweeps over the samples whose neighbours have changed since they were last worked out: all others
// would stay as they are. The bits are those of sweeps over the whole grid.
class FirstArrivals {
 public:
  FirstArrivals(const EikonalProblem& problem, RimmedGrid& theta)
      : problem_(problem),
        theta_(theta),
        state_(static_cast<std::size_t>(theta.stride()) * (problem.grid.samples_y + 2), kFixed),
        rows_(static_cast<std::size_t>(problem.grid.samples_y) + 2) {
    const terrain::Grid& grid = problem.grid;
    for (int j = 0; j < grid.samples_y; ++j) {
      for (int i = 0; i < grid.samples_x; ++i) {
        const std::size_t n = grid.index(i, j);
        if (problem.slowness[n] == 0.0 || problem.source[n] < kInfinity<double>) continue;
        longest_step_ = std::max(longest_step_, problem.slowness[n] * grid.spacing_m);
        state_[theta.index(i, j)] = kIdle;
      }
    }
    for (int j = 0; j < grid.samples_y; ++j) {
      for (int i = 0; i < grid.samples_x; ++i) {
        const double t = *theta.at(i, j);
        if (!(t < kInfinity<double>)) continue;
        for (const Axis axis : kAxes) {
          wake_later(i - axis.dx, j - axis.dy, lowered_from(t));
          wake_later(i + axis.dx, j + axis.dy, lowered_from(t));
        }
      }
    }
  }

  // Returns the largest change.
  double sweep(bool x_up, bool y_up) {
    const int ny = problem_.grid.samples_y;
    double change = 0.0;
    for (int jj = 0; jj < ny; ++jj) {
      const int j = y_up ? jj : ny - 1 - jj;
      if (!row(j).is_empty()) change = std::max(change, x_up ? sweep_row<1>(j) : sweep_row<-1>(j));
    }
    return change;
  }

 private:
  enum State : std::uint8_t { kFixed = 0, kIdle = 1, kAwake = 2 };

  // Samples first to last of a row, among which all those are that are awake.
  struct Row {
    int first = std::numeric_limits<int>::max(), last = -1;
    bool is_empty() const { return last < first; }
    void add(int i) {
      first = std::min(first, i);
      last = std::max(last, i);
    }
  };

  // A solution lies above the values that it is made from but for the rounding of four sums of
  // numbers below |value| + 2 steps. Neighbours further below need not be woken.
  static constexpr double kRounding = 0x1p-49;

  Row& row(int j) { return rows_[static_cast<std::size_t>(j) + 1]; }

  // The least theta of a neighbour that theta = t may lower.
  double lowered_from(double t) const { return t - kRounding * (std::abs(t) + longest_step_); }

  // True if it has to be worked out anew.
  bool wake(int i, int j, double lowered_from) {
    std::uint8_t& state = state_[theta_.index(i, j)];
    if (state == kFixed || *theta_.at(i, j) < lowered_from) return false;
    state = kAwake;
    return true;
  }
  void wake_later(int i, int j, double lowered_from) {
    if (wake(i, j, lowered_from)) row(j).add(i);
  }

  template <int kStep>
  double sweep_row(int j) {
    const int stride = theta_.stride();
    const Row todo = std::exchange(row(j), Row{});
    const int last = kStep > 0 ? todo.last : todo.first;
    const double* slowness = problem_.slowness.data() + problem_.grid.index(0, j);
    double change = 0.0;
    bool next_is_awake = false;
    for (int i = kStep > 0 ? todo.first : todo.last; kStep * i <= kStep * last || next_is_awake;
         i += kStep) {
      next_is_awake = false;
      std::uint8_t& state = state_[theta_.index(i, j)];
      if (state != kAwake) continue;
      state = kIdle;
      double* theta = theta_.at(i, j);
      const double a = std::min(theta[-1], theta[1]), b = std::min(theta[-stride], theta[stride]);
      const double t = first_order_update(a, b, slowness[i] * problem_.grid.spacing_m);
      if (!(t < *theta)) continue;
      change = std::max(change, *theta - t);
      *theta = t;
      const double from = lowered_from(t);
      next_is_awake = wake(i + kStep, j, from);
      wake_later(i - kStep, j, from);
      wake_later(i, j - 1, from);
      wake_later(i, j + 1, from);
    }
    return change;
  }

  const EikonalProblem& problem_;
  RimmedGrid& theta_;
  std::vector<std::uint8_t> state_;
  std::vector<Row> rows_;
  double longest_step_ = 0.0;
};

// Sweeps until nothing changes by more than rounding. Each bend of a ray costs one round.
void sweep_until_converged(const EikonalProblem& problem, RimmedGrid& theta) {
  constexpr int kMaxRounds = 200;
  constexpr double kTolerance = 1e-10;
  FirstArrivals arrivals(problem, theta);
  for (int round = 0; round < kMaxRounds; ++round) {
    double change = 0.0;
    for (const bool y_up : {true, false}) {
      check_stop();
      for (const bool x_up : {true, false}) change = std::max(change, arrivals.sweep(x_up, y_up));
    }
    if (change <= kTolerance) return;
  }
}

// ---- Down the wave

// Calls solve(sample, needed) for each sample of the grid until it is true. If it is false, the
// sample `needed`, which lies up the wave, comes first. Few have to wait when `first`, the corner
// to begin at, is near the wave's beginning. No order by arrival is needed: sorting took a third of
// the time.
template <class Solve>
void solve_down_the_wave(const terrain::Grid& grid, Sample first, Solve solve) {
  std::vector<Sample> waiting;
  for (int jj = 0; jj < grid.samples_y; ++jj) {
    check_stop();
    const int j = first.j == 0 ? jj : grid.samples_y - 1 - jj;
    for (int ii = 0; ii < grid.samples_x; ++ii) {
      const int i = first.i == 0 ? ii : grid.samples_x - 1 - ii;
      Sample needed{};
      if (solve(Sample{i, j}, needed)) continue;
      waiting.assign({{i, j}, needed});
      while (!waiting.empty()) {
        if (solve(waiting.back(), needed))
          waiting.pop_back();
        else
          waiting.push_back(needed);
      }
    }
  }
}

// The grid's corner where theta_of(sample) is least.
template <class Theta>
Sample earliest_corner(const terrain::Grid& grid, Theta theta_of) {
  const int i = grid.samples_x - 1, j = grid.samples_y - 1;
  return std::ranges::min(std::array<Sample, 4>{{{0, 0}, {i, 0}, {0, j}, {i, j}}}, {}, theta_of);
}

// An upwind difference weight * (theta - value); weight 0: the wave does not come along this axis.
struct Difference {
  double weight = 0.0, value = kInfinity<double>;
};

// Not a number: a sample that waits for others.
constexpr double kWaiting = std::numeric_limits<double>::quiet_NaN();

// The difference towards the neighbour that the wave reached first: three points where the wave
// comes through the second one too, else two. False if one of them is waiting, which is `needed`
// then.
bool upwind_difference(const terrain::Grid& grid, const RimmedGrid& arrival,
                       std::span<const double> theta, Sample at, Axis axis, Difference& difference,
                       Sample& needed) {
  const int stride = axis.dx + axis.dy * arrival.stride();
  const double* here = arrival.at(at.i, at.j);
  const int side = here[-stride] <= here[stride] ? -1 : 1;
  const double first = here[side * stride];
  if (!(first < *here)) return true;
  needed = {at.i + side * axis.dx, at.j + side * axis.dy};
  const double t1 = theta[grid.index(needed.i, needed.j)];
  if (std::isnan(t1)) return false;
  difference = {1.0 / grid.spacing_m, t1};
  if (!(here[2 * side * stride] < first)) return true;
  needed = {at.i + 2 * side * axis.dx, at.j + 2 * side * axis.dy};
  const double t2 = theta[grid.index(needed.i, needed.j)];
  if (std::isnan(t2)) return false;
  if (t2 < t1) difference = {1.5 / grid.spacing_m, (4.0 * t1 - t2) / 3.0};
  return true;
}

// theta above both values with (wa (theta - a))^2 + (wb (theta - b))^2 = slowness^2; infinity if
// there is none.
double solve_two(Difference a, Difference b, double slowness) {
  const double wa = a.weight * a.weight, wb = b.weight * b.weight, sum = wa + wb;
  const double difference = a.value - b.value;
  const double discriminant = sum * slowness * slowness - wa * wb * difference * difference;
  if (!(discriminant >= 0.0)) return kInfinity<double>;
  const double theta = (wa * a.value + wb * b.value + std::sqrt(discriminant)) / sum;
  return theta >= std::max(a.value, b.value) ? theta : kInfinity<double>;
}

double solve_one(Difference a, double slowness) {
  return a.weight > 0.0 ? a.value + slowness / a.weight : kInfinity<double>;
}

double second_order_update(Difference a, Difference b, double slowness) {
  if (a.weight > 0.0 && b.weight > 0.0) {
    const double both = solve_two(a, b, slowness);
    if (both < kInfinity<double>) return both;
  }
  return std::min(solve_one(a, slowness), solve_one(b, slowness));
}

// Flux through a cell's four faces: out and in per unit of energy flux density, and the energy that
// comes in.
struct Faces {
  double out = 0.0, in = 0.0, in_energy = 0.0;
};

// theta at a grid point, infinity beyond the grid.
double value_at(const terrain::Grid& grid, std::span<const double> theta, int i, int j) {
  if (i < 0 || j < 0 || i >= grid.samples_x || j >= grid.samples_y) return kInfinity<double>;
  return theta[grid.index(i, j)];
}

// False if the wave comes in from a sample that is waiting, which is `needed` then.
bool measure_faces(const EikonalProblem& problem, std::span<const double> theta,
                   std::span<const double> energy, Sample at, Faces& faces, Sample& needed) {
  const terrain::Grid& grid = problem.grid;
  const std::size_t n = grid.index(at.i, at.j);
  for (const Axis axis : kAxes) {
    std::array<double, 2> flux{};  // out of the cell, before and after along the axis
    std::array<bool, 2> open{};
    for (int side = 0; side < 2; ++side) {
      const int sign = 2 * side - 1, i1 = at.i + sign * axis.dx, j1 = at.j + sign * axis.dy;
      const double neighbour = value_at(grid, theta, i1, j1);
      open[side] = neighbour < kInfinity<double>;
      if (!open[side]) continue;
      const std::size_t m = grid.index(i1, j1);
      const double slowness = 0.5 * (problem.slowness[n] + problem.slowness[m]);
      flux[side] = (neighbour - theta[n]) / (slowness * grid.spacing_m);
      if (!(flux[side] < 0.0)) continue;
      needed = {i1, j1};
      if (std::isnan(energy[m])) return false;
      faces.in -= flux[side];
      faces.in_energy -= flux[side] * energy[m];
    }
    // Through the grid's border and onto land the wave goes on as it came.
    for (int side = 0; side < 2; ++side) {
      if (!open[side]) flux[side] = -flux[1 - side];
      faces.out += std::max(flux[side], 0.0);
    }
  }
  return true;
}

}  // namespace

void solve_eikonal(const EikonalProblem& problem, std::vector<double>& theta) {
  const terrain::Grid& grid = problem.grid;
  SWELL_CHECK(problem.slowness.size() == grid.size() && problem.source.size() == grid.size(),
              "samples={} slowness={} source={}", grid.size(), problem.slowness.size(),
              problem.source.size());
  // `arrival` gets the first arrivals.
  RimmedGrid arrival(grid, problem.source);
  for (int j = 0; j < grid.samples_y; ++j)
    for (int i = 0; i < grid.samples_x; ++i)
      if (problem.slowness[grid.index(i, j)] == 0.0) *arrival.at(i, j) = kInfinity<double>;
  sweep_until_converged(problem, arrival);
  // theta is solved for again in the order of these, with finer differences.
  theta.resize(grid.size());
  for (int j = 0; j < grid.samples_y; ++j) {
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t n = grid.index(i, j);
      const bool known =
          problem.source[n] < kInfinity<double> || *arrival.at(i, j) == kInfinity<double>;
      theta[n] = known ? *arrival.at(i, j) : kWaiting;
    }
  }
  const auto arrival_at = [&](Sample at) { return *arrival.at(at.i, at.j); };
  solve_down_the_wave(grid, earliest_corner(grid, arrival_at), [&](Sample at, Sample& needed) {
    const std::size_t n = grid.index(at.i, at.j);
    if (!std::isnan(theta[n])) return true;
    Difference a, b;
    if (!upwind_difference(grid, arrival, theta, at, kAxes[0], a, needed) ||
        !upwind_difference(grid, arrival, theta, at, kAxes[1], b, needed))
      return false;
    const double finer = second_order_update(a, b, problem.slowness[n]);
    theta[n] = finer < kInfinity<double> ? finer : *arrival.at(at.i, at.j);
    return true;
  });
}

void spread_energy(const EikonalProblem& problem, std::span<const double> theta,
                   std::vector<double>& energy) {
  const terrain::Grid& grid = problem.grid;
  SWELL_CHECK(problem.source_energy.size() == grid.size() && theta.size() == grid.size(),
              "samples={} source_energy={} theta={}", grid.size(), problem.source_energy.size(),
              theta.size());
  energy.resize(grid.size());
  for (std::size_t n = 0; n < energy.size(); ++n) {
    const double here = problem.source[n] < kInfinity<double> ? problem.source_energy[n] : kWaiting;
    energy[n] = theta[n] < kInfinity<double> ? here : 0.0;
  }
  const auto theta_of = [&](Sample at) { return theta[grid.index(at.i, at.j)]; };
  solve_down_the_wave(grid, earliest_corner(grid, theta_of), [&](Sample at, Sample& needed) {
    const std::size_t n = grid.index(at.i, at.j);
    if (!std::isnan(energy[n])) return true;
    Faces faces;
    if (!measure_faces(problem, theta, energy, at, faces, needed)) return false;
    // Rays that bend together change the density little from cell to cell; where much more flux
    // comes in than goes out, two waves meet, and what is too much for one goes with the other.
    const double out = std::max(faces.out, 0.9 * faces.in);
    energy[n] = faces.in_energy == 0.0 ? 0.0 : std::min(faces.in_energy / out, kMaxFocus);
    return true;
  });
}

}  // namespace swell::ocean
