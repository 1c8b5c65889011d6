// A sea that repeats itself: every wave has a whole number of periods in the loop.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/velocity.h"

namespace swell::ocean {
namespace {

SeaDescription looping_sea(double loop_s) {
  SeaDescription description;
  description.resolution = 32;
  description.loop_s = loop_s;
  description.sines = {{.amplitude_m = 0.5, .wavelength_m = 20.0, .to_rad = 0.7, .phase_rad = 0.3},
                       {.amplitude_m = 0.2, .wavelength_m = 9.0, .period_s = 3.0}};
  return description;
}

struct Moment {
  SeaFrame frame;
  VelocityFrame velocity;
};

Moment moment_at(const Sea& sea, double t_s) {
  Workers workers(1);
  Moment moment;
  advance(sea, t_s, moment.frame, workers);
  advance_velocity(sea, moment.frame, moment.velocity, workers);
  return moment;
}

bool same_heights(const SeaFrame& a, const SeaFrame& b) {
  bool same = a.patches.size() == b.patches.size() && a.sines.size() == b.sines.size();
  for (std::size_t p = 0; same && p < a.patches.size(); ++p)
    same = a.patches[p].height_m == b.patches[p].height_m;
  for (std::size_t i = 0; same && i < a.sines.size(); ++i)
    same = a.sines[i].cycles == b.sines[i].cycles;
  return same;
}

bool same_bits(const Moment& a, const Moment& b) {
  bool same = same_heights(a.frame, b.frame);
  for (std::size_t p = 0; same && p < a.frame.patches.size(); ++p)
    same = a.frame.patches[p].slope_x == b.frame.patches[p].slope_x &&
           a.frame.patches[p].slope_y == b.frame.patches[p].slope_y;
  return same && same_heights(a.velocity.x, b.velocity.x) &&
         same_heights(a.velocity.y, b.velocity.y) && same_heights(a.velocity.z, b.velocity.z);
}

// PHY-34.
TEST(SeaLoop, TimesWholeLoopsApartGiveTheSameBits) {
  const Sea sea(looping_sea(20.0));
  for (const double t_s : {0.0, 3.25, 13.625}) {
    const Moment want = moment_at(sea, t_s);
    for (const double loops : {1.0, 2.0, 7.0, -1.0, -3.0, 1e9})
      EXPECT_TRUE(same_bits(moment_at(sea, t_s + 20.0 * loops), want)) << t_s << " " << loops;
    EXPECT_FALSE(same_bits(moment_at(sea, t_s + 10.0), want)) << t_s;
  }
}

// 10.1 has no short binary form; its products with powers of two are exact.
TEST(SeaLoop, RepeatsExactlyForLoopsOfAnyLength) {
  for (const double loop_s : {10.1, 1.0 / 3.0 + 1.0, 99999.9}) {
    const Sea sea(looping_sea(loop_s));
    const Moment want = moment_at(sea, 0.0), half = moment_at(sea, 0.5 * loop_s);
    for (const double loops : {1.0, 2.0, 4.0, 1024.0, -1.0, -8.0})
      EXPECT_TRUE(same_bits(moment_at(sea, loop_s * loops), want)) << loop_s << " " << loops;
    EXPECT_TRUE(same_bits(moment_at(sea, -0.5 * loop_s), half)) << loop_s;
  }
}

TEST(SeaLoop, RepeatsExactlyWithSharpCrests) {
  SeaDescription description = looping_sea(20.0);
  description.choppiness = 1.0;
  const Sea sea(description);
  EXPECT_TRUE(same_bits(moment_at(sea, 23.25), moment_at(sea, 3.25)));
}

TEST(SeaLoop, DoesNotRepeatWithoutALoop) {
  const Sea sea(looping_sea(0.0));
  EXPECT_FALSE(same_bits(moment_at(sea, 0.0), moment_at(sea, 20.0)));
}

// What a sea that was only cut off and started again would fail.
TEST(SeaLoop, HasNoJumpWhereItStartsAgain) {
  for (const double loop_s : {5.0, 20.0, 3600.0}) {
    const Sea sea(looping_sea(loop_s));
    const SeaFrame last = moment_at(sea, loop_s - 1e-6).frame;
    const SeaFrame first = moment_at(sea, loop_s).frame;
    for (std::size_t p = 0; p < first.patches.size(); ++p) {
      for (std::size_t i = 0; i < first.patches[p].height_m.size(); ++i)
        ASSERT_NEAR(last.patches[p].height_m[i], first.patches[p].height_m[i], 5e-5) << loop_s;
    }
    for (std::size_t i = 0; i < first.sines.size(); ++i)
      EXPECT_NEAR(std::remainder(last.sines[i].cycles - first.sines[i].cycles, 1.0), 0.0, 1e-5);
  }
}

TEST(SeaLoop, MovesEveryWaveAtTheNearestFrequencyThatFits) {
  for (const double loop_s : {1.0, 20.0, 600.0}) {
    const SeaDescription description = looping_sea(loop_s);
    const Sea sea(description);
    int waves = 0;
    for (const PatchWaves& patch : sea.state().patches) {
      for (int j = 0; j < patch.size; ++j) {
        for (int i = 0; i < patch.size; ++i) {
          const double turns_per_s = patch.turns_per_s[wave_position(i, j, patch.size)];
          if (turns_per_s == 0.0) continue;
          const double counts = std::hypot(wave_count(i, patch.size), wave_count(j, patch.size));
          const double k = kTurn * counts / patch.length_m;
          const double turns = std::sqrt(description.gravity_mps2 * k) / kTurn * loop_s;
          const double n = turns_per_s * loop_s;
          ++waves;
          ASSERT_NEAR(n, std::round(n), 1e-9 * n);
          ASSERT_GE(n, 1.0 - 1e-12);
          // The phase speed, omega / k, is off by at most 1 / (2n).
          if (turns < 0.5) continue;  // n = 1 is too many
          ASSERT_LE(std::abs(turns / n - 1.0), 0.5 / n + 1e-12);
        }
      }
    }
    EXPECT_GT(waves, 500);
  }
}

TEST(SeaLoop, RoundsThePeriodsOfSines) {
  SeaDescription description;
  description.spectrum = false;
  description.loop_s = 20.0;
  description.sines = {{.amplitude_m = 1.0, .period_s = 3.0},      // 6.67 periods: 7
                       {.amplitude_m = 1.0, .period_s = 4.0},      // 5
                       {.amplitude_m = 1.0, .period_s = 1000.0}};  // 0.02: 1
  const SeaFrame frame = moment_at(Sea(description), 1.0).frame;
  EXPECT_NEAR(frame.sines[0].cycles, 1.0 - 7.0 / 20.0, 1e-12);
  EXPECT_NEAR(frame.sines[1].cycles, 1.0 - 5.0 / 20.0, 1e-12);
  EXPECT_NEAR(frame.sines[2].cycles, 1.0 - 1.0 / 20.0, 1e-12);
}

}  // namespace
}  // namespace swell::ocean
