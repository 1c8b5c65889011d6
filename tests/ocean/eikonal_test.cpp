// The eikonal solver against a plain one: sweeps over the whole grid, then samples sorted by
// arrival.
#include "ocean/coast/eikonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "constants.h"
#include "math/random.h"

namespace swell::ocean {
namespace {

// Samples that a wave reaches, in the order it does.
std::vector<std::size_t> arrival_order(const std::vector<double>& theta) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < theta.size(); ++n)
    if (theta[n] < kInf) order.push_back(n);
  std::ranges::stable_sort(order, {}, [&](std::size_t n) { return theta[n]; });
  return order;
}

class PlainSolver {
 public:
  explicit PlainSolver(const EikonalProblem& problem)
      : problem_(problem), nx_(problem.grid.samples_x), ny_(problem.grid.samples_y) {}

  std::vector<double> theta() {
    arrival_ = problem_.source;
    for (std::size_t n = 0; n < arrival_.size(); ++n)
      if (problem_.slowness[n] == 0.0) arrival_[n] = kInf;
    for (int round = 0; round < 200; ++round) {
      double change = 0.0;
      for (const bool y_up : {true, false})
        for (const bool x_up : {true, false}) change = std::max(change, sweep(x_up, y_up));
      if (change <= 1e-10) break;
    }
    std::vector<double> theta = arrival_;
    for (const std::size_t n : arrival_order(arrival_))
      if (problem_.source[n] == kInf) theta[n] = finer(theta, n);
    return theta;
  }

  std::vector<double> energy(const std::vector<double>& theta) const {
    std::vector<double> energy(theta.size(), 0.0);
    for (const std::size_t n : arrival_order(theta)) {
      energy[n] =
          problem_.source[n] < kInf ? problem_.source_energy[n] : energy_at(theta, energy, n);
    }
    return energy;
  }

 private:
  double at(const std::vector<double>& values, int i, int j) const {
    return i < 0 || j < 0 || i >= nx_ || j >= ny_ ? kInf : values[problem_.grid.index(i, j)];
  }

  double sweep(bool x_up, bool y_up) {
    double change = 0.0;
    for (int jj = 0; jj < ny_; ++jj) {
      for (int ii = 0; ii < nx_; ++ii) {
        const int i = x_up ? ii : nx_ - 1 - ii, j = y_up ? jj : ny_ - 1 - jj;
        const std::size_t n = problem_.grid.index(i, j);
        if (problem_.slowness[n] == 0.0 || problem_.source[n] < kInf) continue;
        const double x = std::min(at(arrival_, i - 1, j), at(arrival_, i + 1, j));
        const double y = std::min(at(arrival_, i, j - 1), at(arrival_, i, j + 1));
        const double a = std::min(x, y), b = std::max(x, y);
        if (a == kInf) continue;
        const double step = problem_.slowness[n] * problem_.grid.spacing_m, d = b - a;
        const double t = d < step ? 0.5 * (a + b + std::sqrt(2.0 * step * step - d * d)) : a + step;
        if (!(t < arrival_[n])) continue;
        change = std::max(change, arrival_[n] - t);
        arrival_[n] = t;
      }
    }
    return change;
  }

  struct Difference {
    double weight = 0.0, value = kInf;
  };
  Difference difference(const std::vector<double>& theta, int i, int j, int dx, int dy) const {
    const double before = at(arrival_, i - dx, j - dy), after = at(arrival_, i + dx, j + dy);
    const int side = before <= after ? -1 : 1;
    const double first = std::min(before, after), h = problem_.grid.spacing_m;
    if (!(first < at(arrival_, i, j))) return {};
    const double t1 = at(theta, i + side * dx, j + side * dy);
    if (!(at(arrival_, i + 2 * side * dx, j + 2 * side * dy) < first)) return {1.0 / h, t1};
    const double t2 = at(theta, i + 2 * side * dx, j + 2 * side * dy);
    return t2 < t1 ? Difference{1.5 / h, (4.0 * t1 - t2) / 3.0} : Difference{1.0 / h, t1};
  }

  double finer(const std::vector<double>& theta, std::size_t n) const {
    const int i = static_cast<int>(n) % nx_, j = static_cast<int>(n) / nx_;
    const double s = problem_.slowness[n];
    const Difference a = difference(theta, i, j, 1, 0), b = difference(theta, i, j, 0, 1);
    if (a.weight > 0.0 && b.weight > 0.0) {
      const double wa = a.weight * a.weight, wb = b.weight * b.weight, d = a.value - b.value;
      const double discriminant = (wa + wb) * s * s - wa * wb * d * d;
      const double both = (wa * a.value + wb * b.value + std::sqrt(discriminant)) / (wa + wb);
      if (discriminant >= 0.0 && both >= std::max(a.value, b.value)) return both;
    }
    const double one = std::min(a.weight > 0.0 ? a.value + s / a.weight : kInf,
                                b.weight > 0.0 ? b.value + s / b.weight : kInf);
    return one < kInf ? one : theta[n];
  }

  double energy_at(const std::vector<double>& theta, const std::vector<double>& energy,
                   std::size_t n) const {
    const int i = static_cast<int>(n) % nx_, j = static_cast<int>(n) / nx_;
    double out = 0.0, in = 0.0, in_energy = 0.0;
    for (const auto& [dx, dy] : {std::array{1, 0}, std::array{0, 1}}) {
      std::array<double, 2> flux{};
      std::array<bool, 2> open{};
      for (int k = 0; k < 2; ++k) {
        const int i1 = i + (2 * k - 1) * dx, j1 = j + (2 * k - 1) * dy;
        open[k] = at(theta, i1, j1) < kInf;
        if (!open[k]) continue;
        const std::size_t m = problem_.grid.index(i1, j1);
        const double slowness = 0.5 * (problem_.slowness[n] + problem_.slowness[m]);
        flux[k] = (theta[m] - theta[n]) / (slowness * problem_.grid.spacing_m);
        in -= std::min(flux[k], 0.0);
        in_energy -= std::min(flux[k], 0.0) * energy[m];
      }
      for (int k = 0; k < 2; ++k) out += std::max(open[k] ? flux[k] : -flux[1 - k], 0.0);
    }
    return in_energy == 0.0 ? 0.0 : std::min(in_energy / std::max(out, 0.9 * in), kMaxFocus);
  }

  const EikonalProblem& problem_;
  int nx_, ny_;
  std::vector<double> arrival_;
};

// Dice of one seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double uniform() { return random_uniform(seed_, n_++); }
  int below(int end) { return static_cast<int>(uniform() * end); }

 private:
  std::uint64_t seed_, n_ = 0;
};

// Waves into a grid of any shape through two of its borders, or from some samples inside; many
// samples have the same slowness, so that arrivals tie; up to half of all are obstacles.
EikonalProblem random_problem(Dice& dice) {
  const terrain::Grid grid{
      {0.0, 0.0}, 0.5 + 3.0 * dice.uniform(), 1 + dice.below(40), 1 + dice.below(40)};
  EikonalProblem problem{grid, {}, {}, {}};
  const double obstacles = dice.below(2) * 0.5 * dice.uniform();
  const int levels = 1 + dice.below(4);
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const bool open = dice.uniform() >= obstacles;
    problem.slowness.push_back(open ? 0.05 * (1 + dice.below(levels)) : 0.0);
  }
  problem.source.assign(grid.size(), kInf);
  problem.source_energy.assign(grid.size(), 0.0);
  const auto add = [&](int i, int j, double theta) {
    problem.source[grid.index(i, j)] = theta;
    problem.source_energy[grid.index(i, j)] = 0.5 + dice.uniform();
  };
  const int i0 = dice.below(2) * (grid.samples_x - 1), j0 = dice.below(2) * (grid.samples_y - 1);
  const double offset = 200.0 * dice.uniform() - 100.0, rate = 0.05 * grid.spacing_m;
  if (dice.below(4) == 0) {
    for (int n = 1 + dice.below(5); n > 0; --n)
      add(dice.below(grid.samples_x), dice.below(grid.samples_y), offset + dice.uniform());
  } else {
    const double along_x = rate * dice.below(3) / 2.0, along_y = rate * dice.below(3) / 2.0;
    for (int i = 0; i < grid.samples_x; ++i) add(i, j0, offset + along_x * std::abs(i - i0));
    for (int j = 0; j < grid.samples_y; ++j) add(i0, j, offset + along_y * std::abs(j - j0));
  }
  return problem;
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double x : values) result.push_back(std::bit_cast<std::uint64_t>(x));
  return result;
}

TEST(Eikonal, HasTheBitsOfWholeSweepsAndSortedArrivals) {
  for (int n = 0; n < 2000; ++n) {
    Dice dice(static_cast<std::uint64_t>(n));
    const EikonalProblem problem = random_problem(dice);
    std::vector<double> theta, energy;
    solve_eikonal(problem, theta);
    spread_energy(problem, theta, energy);
    PlainSolver plain(problem);
    ASSERT_EQ(bits(theta), bits(plain.theta())) << n;
    ASSERT_EQ(bits(energy), bits(plain.energy(theta))) << n;
  }
}

// A corridor that winds through the whole grid, so that the order of arrival is nothing like that
// of rows: one sample wide, walls of one sample between its turns.
TEST(Eikonal, FollowsAWindingCorridorToItsEnd) {
  constexpr int kSide = 101;
  EikonalProblem problem{{{0.0, 0.0}, 1.0, kSide, kSide}, {}, {}, {}};
  problem.slowness.assign(problem.grid.size(), 1.0);
  problem.source.assign(problem.grid.size(), kInf);
  problem.source_energy.assign(problem.grid.size(), 1.0);
  for (int j = 1; j < kSide; j += 2)
    for (int i = 0; i < kSide; ++i)
      if (i != (j % 4 == 1 ? kSide - 1 : 0)) problem.slowness[problem.grid.index(i, j)] = 0.0;
  problem.source[0] = 0.0;
  std::vector<double> theta, energy;
  solve_eikonal(problem, theta);
  spread_energy(problem, theta, energy);
  // 51 rows of 100 steps and 50 of 2 between them, from corner to corner.
  EXPECT_DOUBLE_EQ(theta[problem.grid.index(kSide - 1, kSide - 1)], 51 * 100 + 50 * 2);
  EXPECT_GT(energy[problem.grid.index(kSide - 1, kSide - 1)], 0.0);
}

}  // namespace
}  // namespace swell::ocean
