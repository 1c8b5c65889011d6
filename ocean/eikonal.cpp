#include "ocean/eikonal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "math/check.h"

namespace swell::ocean {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Axis {
  int dx, dy;
};
constexpr std::array<Axis, 2> kAxes{{{1, 0}, {0, 1}}};

// theta at a grid point, infinity beyond the grid.
double value_at(const FloorGrid& grid, std::span<const double> theta, int i, int j) {
  if (i < 0 || j < 0 || i >= grid.samples_x || j >= grid.samples_y) return kInfinity;
  return theta[grid.index(i, j)];
}

// Godunov's upwind solution from the smaller neighbour along each axis; step = slowness x spacing.
double first_order_update(double a, double b, double step) {
  if (a > b) std::swap(a, b);
  const double difference = b - a;
  if (!(difference < step)) return a + step;
  return 0.5 * (a + b + std::sqrt(2.0 * step * step - difference * difference));
}

// One sweep; returns the largest change.
double sweep(const EikonalProblem& problem, bool x_up, bool y_up, std::vector<double>& theta) {
  const FloorGrid& grid = problem.grid;
  const int nx = grid.samples_x, ny = grid.samples_y;
  double change = 0.0;
  for (int jj = 0; jj < ny; ++jj) {
    const int j = y_up ? jj : ny - 1 - jj;
    for (int ii = 0; ii < nx; ++ii) {
      const int i = x_up ? ii : nx - 1 - ii;
      const std::size_t n = grid.index(i, j);
      if (problem.slowness[n] == 0.0 || problem.source[n] < kInfinity) continue;
      const double a = std::min(value_at(grid, theta, i - 1, j), value_at(grid, theta, i + 1, j));
      const double b = std::min(value_at(grid, theta, i, j - 1), value_at(grid, theta, i, j + 1));
      if (a == kInfinity && b == kInfinity) continue;
      const double t = first_order_update(a, b, problem.slowness[n] * grid.spacing_m);
      if (!(t < theta[n])) continue;
      change = std::max(change, theta[n] - t);
      theta[n] = t;
    }
  }
  return change;
}

// Sweeps until nothing changes by more than rounding. Each bend of a ray costs one round.
void sweep_until_converged(const EikonalProblem& problem, std::vector<double>& theta) {
  constexpr int kMaxRounds = 200;
  constexpr double kTolerance = 1e-10;
  for (int round = 0; round < kMaxRounds; ++round) {
    double change = 0.0;
    for (const bool y_up : {true, false}) {
      for (const bool x_up : {true, false}) {
        change = std::max(change, sweep(problem, x_up, y_up, theta));
      }
    }
    if (change <= kTolerance) return;
  }
}

// Samples that the wave reaches, in the order it does.
std::vector<std::uint32_t> arrival_order(std::span<const double> theta) {
  std::vector<std::uint32_t> order;
  for (std::size_t n = 0; n < theta.size(); ++n) {
    if (theta[n] < kInfinity) order.push_back(static_cast<std::uint32_t>(n));
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return theta[a] != theta[b] ? theta[a] < theta[b] : a < b;
  });
  return order;
}

// An upwind difference weight * (theta - value); weight 0: the wave does not come along this axis.
struct Difference {
  double weight = 0.0, value = kInfinity;
};

// The difference towards the neighbour that the wave reached first: three points where the wave
// comes through the second one too, else two.
Difference upwind_difference(const FloorGrid& grid, std::span<const double> arrival,
                             std::span<const double> theta, int i, int j, Axis axis) {
  const double before = value_at(grid, arrival, i - axis.dx, j - axis.dy);
  const double after = value_at(grid, arrival, i + axis.dx, j + axis.dy);
  const int side = before <= after ? -1 : 1;
  const double first = std::min(before, after);
  if (!(first < arrival[grid.index(i, j)])) return {};
  const double t1 = theta[grid.index(i + side * axis.dx, j + side * axis.dy)];
  const int i2 = i + 2 * side * axis.dx, j2 = j + 2 * side * axis.dy;
  if (!(value_at(grid, arrival, i2, j2) < first)) return {1.0 / grid.spacing_m, t1};
  const double t2 = theta[grid.index(i2, j2)];
  if (!(t2 < t1)) return {1.0 / grid.spacing_m, t1};
  return {1.5 / grid.spacing_m, (4.0 * t1 - t2) / 3.0};
}

// theta above both values with (wa (theta - a))^2 + (wb (theta - b))^2 = slowness^2; infinity if
// there is none.
double solve_two(Difference a, Difference b, double slowness) {
  const double wa = a.weight * a.weight, wb = b.weight * b.weight, sum = wa + wb;
  const double difference = a.value - b.value;
  const double discriminant = sum * slowness * slowness - wa * wb * difference * difference;
  if (!(discriminant >= 0.0)) return kInfinity;
  const double theta = (wa * a.value + wb * b.value + std::sqrt(discriminant)) / sum;
  return theta >= std::max(a.value, b.value) ? theta : kInfinity;
}

double solve_one(Difference a, double slowness) {
  return a.weight > 0.0 ? a.value + slowness / a.weight : kInfinity;
}

double second_order_update(const EikonalProblem& problem, std::span<const double> arrival,
                           std::span<const double> theta, int i, int j) {
  const double slowness = problem.slowness[problem.grid.index(i, j)];
  const Difference a = upwind_difference(problem.grid, arrival, theta, i, j, kAxes[0]);
  const Difference b = upwind_difference(problem.grid, arrival, theta, i, j, kAxes[1]);
  if (a.weight > 0.0 && b.weight > 0.0) {
    const double both = solve_two(a, b, slowness);
    if (both < kInfinity) return both;
  }
  return std::min(solve_one(a, slowness), solve_one(b, slowness));
}

// Flux through a cell's four faces: out and in per unit of energy flux density, and the energy that
// comes in.
struct Faces {
  double out = 0.0, in = 0.0, in_energy = 0.0;
};

Faces measure_faces(const EikonalProblem& problem, std::span<const double> theta,
                    std::span<const double> energy, int i, int j) {
  const FloorGrid& grid = problem.grid;
  const std::size_t n = grid.index(i, j);
  Faces faces;
  for (const Axis axis : kAxes) {
    std::array<double, 2> flux{};  // out of the cell, before and after along the axis
    std::array<bool, 2> open{};
    for (int side = 0; side < 2; ++side) {
      const int sign = 2 * side - 1, i1 = i + sign * axis.dx, j1 = j + sign * axis.dy;
      const double neighbour = value_at(grid, theta, i1, j1);
      open[side] = neighbour < kInfinity;
      if (!open[side]) continue;
      const std::size_t m = grid.index(i1, j1);
      const double slowness = 0.5 * (problem.slowness[n] + problem.slowness[m]);
      flux[side] = (neighbour - theta[n]) / (slowness * grid.spacing_m);
      if (!(flux[side] < 0.0)) continue;
      faces.in -= flux[side];
      faces.in_energy -= flux[side] * energy[m];
    }
    // Through the grid's border and onto land the wave goes on as it came.
    for (int side = 0; side < 2; ++side) {
      if (!open[side]) flux[side] = -flux[1 - side];
      faces.out += std::max(flux[side], 0.0);
    }
  }
  return faces;
}

}  // namespace

void solve_eikonal(const EikonalProblem& problem, std::vector<double>& theta) {
  const FloorGrid& grid = problem.grid;
  SWELL_CHECK(problem.slowness.size() == grid.size() && problem.source.size() == grid.size(),
              "samples={} slowness={} source={}", grid.size(), problem.slowness.size(),
              problem.source.size());
  // First arrivals.
  std::vector<double> arrival(problem.source);
  for (std::size_t n = 0; n < arrival.size(); ++n) {
    if (problem.slowness[n] == 0.0) arrival[n] = kInfinity;
  }
  sweep_until_converged(problem, arrival);
  // The same again in that order, with finer differences.
  theta = arrival;
  for (const std::uint32_t n : arrival_order(arrival)) {
    if (problem.source[n] < kInfinity) continue;
    const int i = static_cast<int>(n) % grid.samples_x, j = static_cast<int>(n) / grid.samples_x;
    const double finer = second_order_update(problem, arrival, theta, i, j);
    if (finer < kInfinity) theta[n] = finer;
  }
}

void spread_energy(const EikonalProblem& problem, std::span<const double> theta,
                   std::vector<double>& energy) {
  const FloorGrid& grid = problem.grid;
  SWELL_CHECK(problem.source_energy.size() == grid.size() && theta.size() == grid.size(),
              "samples={} source_energy={} theta={}", grid.size(), problem.source_energy.size(),
              theta.size());
  energy.assign(grid.size(), 0.0);
  for (const std::uint32_t n : arrival_order(theta)) {
    if (problem.source[n] < kInfinity) {
      energy[n] = problem.source_energy[n];
      continue;
    }
    const int i = static_cast<int>(n) % grid.samples_x, j = static_cast<int>(n) / grid.samples_x;
    const Faces faces = measure_faces(problem, theta, energy, i, j);
    if (faces.in_energy == 0.0) continue;
    // Rays that bend together change the density little from cell to cell; where much more flux
    // comes in than goes out, two waves meet, and what is too much for one goes with the other.
    const double out = std::max(faces.out, 0.9 * faces.in);
    energy[n] = std::min(faces.in_energy / out, kMaxFocus);
  }
}

}  // namespace swell::ocean
