// The automaton that makes periodic maps: what its steps keep, how fast its waves are.
#include "ocean/open_sea/wave_automaton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "constants.h"

namespace swell::ocean {
namespace {

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// PER-01.
TEST(WaveAutomaton, KeepsItsEnergy) {
  WaveAutomaton automaton = make_automaton(48, 0.6);
  add_gusts(automaton, {.to_rad = 0.4, .most_waves = 10, .seed = 3});
  add_drops(automaton, 5, 2.0, 4);
  remove_mean(automaton.now);
  remove_mean(automaton.before);
  const double first = energy(automaton);
  ASSERT_GT(first, 0.0);
  for (int n = 0; n < 2000; ++n) step(automaton);
  EXPECT_NEAR(energy(automaton), first, 1e-12 * first);
}

// cos(k x - omega n) by the scheme's own dispersion, in closed form: on axes, on diagonals and
// between. Worked out here from the nine points' sum by hand, not by turns_per_step().
double omega_of(double courant, double kx, double ky) {
  const double laplacian =
      (8.0 * (std::cos(kx) + std::cos(ky)) + 4.0 * std::cos(kx) * std::cos(ky) - 20.0) / 6.0;
  return 2.0 * std::asin(0.5 * courant * std::sqrt(-laplacian));
}

// PER-02.
TEST(WaveAutomaton, WavesHaveTheSpeedOfTheirClosedForm) {
  constexpr int kSize = 32;
  for (const double courant : {0.3, 0.5, 0.86}) {
    for (const auto& [waves_x, waves_y] : {std::pair(8, 0), {0, 4}, {2, 2}, {3, -1}, {5, 5}}) {
      const double kx = kTurn * waves_x / kSize, ky = kTurn * waves_y / kSize;
      const double omega = omega_of(courant, kx, ky);
      WaveAutomaton automaton = make_automaton(kSize, courant);
      EXPECT_NEAR(kTurn * turns_per_step(automaton, waves_x, waves_y), omega, 1e-7);
      const auto height = [&](int i, int j, int n) {
        return std::cos(kx * i + ky * j - omega * n);
      };
      for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i) {
          automaton.now[static_cast<std::size_t>(j * kSize + i)] = height(i, j, 0);
          automaton.before[static_cast<std::size_t>(j * kSize + i)] = height(i, j, -1);
        }
      constexpr int kSteps = 200;
      for (int n = 0; n < kSteps; ++n) step(automaton);
      for (int i = 0; i < kSize; ++i)
        EXPECT_NEAR(automaton.now[static_cast<std::size_t>(5 * kSize + i)], height(i, 5, kSteps),
                    1e-9)
            << courant << " " << waves_x << " " << waves_y;
    }
  }
}

// The errors of speed that the nine points have, the same along axes and diagonals: 8 % with four
// cells a wave, 0.5 % with sixteen.
TEST(WaveAutomaton, WavesOfFewCellsAreSlow) {
  const WaveAutomaton automaton = make_automaton(64, 0.5);
  const auto error = [&](double waves_x, double waves_y) {
    return turns_per_step(automaton, waves_x, waves_y) * 64.0 /
               (0.5 * std::hypot(waves_x, waves_y)) -
           1.0;
  };
  EXPECT_NEAR(error(16.0, 0.0), -0.080, 0.001);
  EXPECT_NEAR(error(8.0, 0.0), -0.0195, 0.0005);
  EXPECT_NEAR(error(4.0, 0.0), -0.0048, 0.0001);
  const double along_diagonal = 8.0 / std::sqrt(2.0);
  EXPECT_NEAR(error(along_diagonal, along_diagonal), error(8.0, 0.0), 0.0005);
}

TEST(WaveAutomaton, RefusesWhatWouldGrowWithoutEnd) {
  EXPECT_NO_THROW(make_automaton(16, kMostCourant));
  for (const double courant : {0.0, -0.5, 0.867, 5.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(make_automaton(16, courant), std::invalid_argument) << courant;
  EXPECT_THROW(make_automaton(7, 0.5), std::invalid_argument);
  EXPECT_THROW(make_automaton(1025, 0.5), std::invalid_argument);
}

// The bound is the right one: at it the shortest wave stays, a little beyond it explodes.
TEST(WaveAutomaton, BeyondTheBoundWavesDoGrow) {
  const auto after = [](double courant) {
    WaveAutomaton automaton = make_automaton(16, 0.5);
    automaton.courant = courant;
    add_drops(automaton, 3, 1.0, 1);
    for (int n = 0; n < 1000; ++n) step(automaton);
    return largest(automaton.now);
  };
  EXPECT_LT(after(0.866), 10.0);
  EXPECT_GT(after(0.88), 1e6);
}

TEST(WaveAutomaton, GustsRunDownwindAtTheirVariance) {
  double variance = 0.0, along = 0.0, across = 0.0;
  constexpr int kSeeds = 20;
  for (int seed = 0; seed < kSeeds; ++seed) {
    WaveAutomaton automaton = make_automaton(64, 0.5);
    add_gusts(automaton, {.to_rad = 0.5 * std::numbers::pi,
                          .most_waves = 10,
                          .seed = static_cast<std::uint64_t>(seed)});
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i) {
        const auto at = [&](int x, int y) {
          return automaton.now[static_cast<std::size_t>(((j + y) & 63) * 64 + ((i + x) & 63))];
        };
        const double rate = at(0, 0) - automaton.before[static_cast<std::size_t>(j * 64 + i)];
        variance += at(0, 0) * at(0, 0) / (64.0 * 64.0 * kSeeds);
        along -= rate * (at(1, 0) - at(-1, 0));  // h_t = -c h_x of waves to the east
        across -= rate * (at(0, 1) - at(0, -1));
      }
  }
  EXPECT_NEAR(variance, 1.0, 0.15);
  EXPECT_GT(along, 5.0 * std::abs(across));
}

TEST(WaveAutomaton, HeightsComeToRestWithoutTheirMean) {
  WaveAutomaton automaton = make_automaton(32, 0.5);
  std::vector<float> heights(32 * 32, 3.0f);
  heights[100] = 90.0f;
  add_heights(automaton, heights);
  EXPECT_EQ(automaton.now, automaton.before);
  const double sum = std::accumulate(automaton.now.begin(), automaton.now.end(), 0.0);
  EXPECT_NEAR(sum, 0.0, 1e-9);
  EXPECT_EQ(std::ranges::max_element(automaton.now) - automaton.now.begin(), 100);
}

}  // namespace
}  // namespace swell::ocean
