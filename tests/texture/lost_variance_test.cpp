// The variance that bilinear samples of mip levels lack, where it is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "texture/on_every_target.h"
#include "texture/packed_map.h"

namespace swell::texture {
namespace {

class LostVariance : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, LostVariance, every_target(), target_name);

constexpr int kLostSize = 128;

// One wave of `cycles_x`, `cycles_y` periods in the map, in both channels. It begins an eighth of a
// turn off its crest, so that two samples a period have its mean square too.
PackedMap2 sine_map(int cycles_x, int cycles_y, double a, double b) {
  std::vector<float> map_a, map_b;
  for (int j = 0; j < kLostSize; ++j) {
    for (int i = 0; i < kLostSize; ++i) {
      const double turns = 0.125 + (cycles_x * i + cycles_y * j) / static_cast<double>(kLostSize);
      const double phase = 2.0 * std::numbers::pi * turns;
      map_a.push_back(static_cast<float>(a * std::cos(phase)));
      map_b.push_back(static_cast<float>(b * std::cos(phase)));
    }
  }
  PackedMap2 map;
  pack_map2(kLostSize, map_a, map_b, 0.0f, map);
  return map;
}

// What [1 2 1] / 4 leaves of a wave's amplitude: cos^2 of half its phase step. Each level has twice
// the step of the level before; waves beyond two texels come back as their aliases, with the same
// factor.
double amplitude_left(int cycles, int level) {
  double left = 1.0;
  for (int l = 0; l < level; ++l) {
    const double half_step = std::numbers::pi * cycles * std::exp2(l) / kLostSize;
    left *= std::cos(half_step) * std::cos(half_step);
  }
  return left;
}

// The part of a wave's mean square that straight lines between the texels of a level leave: (2 +
// cos) / 3 of its phase step.
double variance_left_between(int cycles, int level) {
  return (2.0 + std::cos(2.0 * std::numbers::pi * cycles * std::exp2(level) / kLostSize)) / 3.0;
}

TEST_P(LostVariance, OfASineIsWhatTheFilterAndStraightLinesTakeOfIt) {
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 3}, {5, 2}, {16, 0}, {21, 21}, {0, 50}}) {
    const PackedMap2 map = sine_map(x, y, 0.3, -0.2);
    const double whole = 0.5 * (0.3 * 0.3 + 0.2 * 0.2);
    // Down to the level whose texels are as long as the wave: from there on its samples all show
    // the same phase.
    for (int level = 0; (std::max(x, y) << level) < kLostSize; ++level) {
      const double left = amplitude_left(x, level) * amplitude_left(y, level);
      const double between = variance_left_between(x, level) * variance_left_between(y, level);
      EXPECT_NEAR(map.lost_variance[level], whole * (1.0 - left * left * between),
                  2e-6 * whole + 1e-8)
          << x << " " << y << " level " << level;
    }
  }
}

// Four texels a wave: level 1 keeps half of the amplitude, level 2 nothing; between texels two
// thirds of the square are left, then a third.
TEST_P(LostVariance, OfAWaveOfFourTexelsIsAThirdThenNearlyAll) {
  const PackedMap2 map = sine_map(kLostSize / 4, 0, 1.0, 0.0);
  EXPECT_NEAR(map.lost_variance[0], 0.5 / 3.0, 1e-6);
  EXPECT_NEAR(map.lost_variance[1], 0.5 * (1.0 - 0.25 / 3.0), 1e-6);
  for (int level = 2; level < map.levels; ++level)
    EXPECT_NEAR(map.lost_variance[level], 0.5, 1e-6) << level;
}

// Waves of different directions are independent: what they lose adds up.
TEST_P(LostVariance, OfASumOfWavesIsTheSumOfWhatTheyLose) {
  const PackedMap2 one = sine_map(7, 1, 0.4, 0.1), other = sine_map(2, 11, -0.2, 0.5);
  std::vector<float> a, b;
  for (int j = 0; j < kLostSize; ++j) {
    for (int i = 0; i < kLostSize; ++i) {
      const double step = 2.0 * std::numbers::pi / kLostSize;
      const double first = std::cos(step * (16 + 7 * i + j)),
                   second = std::cos(step * (16 + 2 * i + 11 * j));
      a.push_back(static_cast<float>(0.4 * first - 0.2 * second));
      b.push_back(static_cast<float>(0.1 * first + 0.5 * second));
    }
  }
  PackedMap2 both;
  pack_map2(kLostSize, a, b, 0.0f, both);
  for (int level = 0; level <= 3; ++level)
    EXPECT_NEAR(both.lost_variance[level], one.lost_variance[level] + other.lost_variance[level],
                2e-7)
        << level;
}

// White noise: between texels 2/3 of the variance are left along each axis. A tent keeps 6/16, of
// which neighbours two texels apart share a sixth: 4 1/3 of 16 are left between them. All but the
// mean is lost in the end.
TEST_P(LostVariance, OfWhiteNoiseIsThatOfTheFiltersWeights) {
  const auto a = random_floats(1 << 20, -1.0, 1.0, 31), b = random_floats(1 << 20, -1.0, 1.0, 32);
  PackedMap2 map;
  pack_map2(1 << 10, a, b, 0.0f, map);
  constexpr double kWhole = 2.0 / 3.0;  // two channels of 2^2 / 12
  EXPECT_NEAR(map.lost_variance[0], kWhole * (1.0 - 4.0 / 9.0), 2e-3 * kWhole);
  EXPECT_NEAR(map.lost_variance[1], kWhole * (1.0 - std::pow(13.0 / 48.0, 2.0)), 2e-3 * kWhole);
  EXPECT_NEAR(map.lost_variance.back(), kWhole, 2e-3 * kWhole);
  for (int level = 1; level < map.levels; ++level)
    EXPECT_GE(map.lost_variance[level], map.lost_variance[level - 1]);
}

}  // namespace
}  // namespace swell::texture
