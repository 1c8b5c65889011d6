// The small sea of bump images: its heights are the sum of its waves, which loop.
#include "ocean/open_sea/small_sea.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"

namespace swell::ocean {
namespace {

TEST(SmallSea, HasTheHeightsOfItsWaves) {
  const SmallSea sea{.size = 128, .frames = 9, .wind_from_rad = 4.0};
  Workers workers(1);
  const auto heights = small_sea_heights(sea, workers);
  const auto waves = small_sea_waves(sea);
  ASSERT_EQ(heights.size(), 9u);
  for (const int frame : {0, 1, 5, 8})
    for (const auto& [x, y] : {std::pair(0, 0), {17, 0}, {0, 17}, {99, 42}, {127, 127}}) {
      double sum = 0.0;
      for (const SmallWave& w : waves)
        sum += w.amplitude *
               std::cos(kTurn * ((w.i * x + w.j * y) / 128.0 - w.cycles * frame / 9.0 + w.phase));
      EXPECT_NEAR(heights[static_cast<std::size_t>(frame)][static_cast<std::size_t>(128 * y + x)],
                  sum, 2e-6)
          << frame << " " << x << " " << y;
    }
}

// omega^2 = k (g + (sigma / rho) k^2), as near as whole cycles come to it.
TEST(SmallSea, WavesKeepTheirPaceInWholeCycles) {
  const SmallSea sea{.length_m = 6.0, .loop_s = 4.0, .frames = 256};
  for (const SmallWave& wave : small_sea_waves(sea)) {
    const double k = kTurn * std::hypot(wave.i, wave.j) / 6.0;
    const double cycles = 4.0 / kTurn * std::sqrt(k * (9.81 + 7.28e-5 * k * k));
    EXPECT_NEAR(wave.cycles, cycles, 0.5) << wave.i << " " << wave.j;
  }
  for (const SmallWave& wave : small_sea_waves({.loop_s = 4.0, .frames = 20})) {
    EXPECT_GE(wave.cycles, 1);
    EXPECT_LE(wave.cycles, 2);
  }
}

TEST(SmallSea, WavesGoWithTheWind) {
  for (const double from_deg : {0.0, 90.0, 215.0}) {
    const double to = (from_deg + 180.0) * kTurn / 360.0;
    double along = 0.0, all = 0.0;
    for (const SmallWave& w : small_sea_waves({.wind_from_rad = from_deg * kTurn / 360.0})) {
      const double length = std::hypot(w.i, w.j);
      const double cosine = (w.i * std::sin(to) + w.j * std::cos(to)) / length;
      EXPECT_GE(cosine, -1e-9);
      along += cosine * w.amplitude;
      all += w.amplitude;
    }
    EXPECT_GT(along / all, 0.65) << from_deg;
  }
}

TEST(SmallSea, IsAnotherForAnotherSeed) {
  const auto a = small_sea_waves({.seed = 1}), b = small_sea_waves({.seed = 2});
  ASSERT_EQ(a.size(), b.size());
  int same = 0;
  for (std::size_t n = 0; n < a.size(); ++n) same += a[n].phase == b[n].phase;
  EXPECT_EQ(same, 0);
}

}  // namespace
}  // namespace swell::ocean
