#include "apps/view/sim_clock.h"

#include <gtest/gtest.h>

namespace swell::view {
namespace {

TEST(SimClock, FrameKIsAtKSixtiethsExactlyWhateverTheWallClockSays) {
  SimClock clock{.by_steps = true};
  for (int k = 1; k <= 1000; ++k) {
    tick(clock, 0.001 * (k % 50));
    ASSERT_EQ(clock.t_s, k / 60.0);
  }
}

TEST(SimClock, RunsWithTheWallClock) {
  SimClock clock;
  tick(clock, 0.25);
  tick(clock, 0.5);
  EXPECT_EQ(clock.t_s, 0.75);
}

TEST(SimClock, StandsStillWhilePaused) {
  for (const bool by_steps : {false, true}) {
    SimClock clock{.by_steps = by_steps, .paused = true};
    tick(clock, 1.0);
    EXPECT_EQ(clock.t_s, 0.0);
    clock.paused = false;
    tick(clock, 0.5);
    EXPECT_EQ(clock.t_s, by_steps ? 1.0 / 60.0 : 0.5);
  }
}

TEST(SimClock, ASingleStepIsASixtiethOfASecondAndHappensOnce) {
  for (const bool by_steps : {false, true}) {
    SimClock clock{.by_steps = by_steps, .paused = true, .step_once = true};
    tick(clock, 1.0);
    tick(clock, 1.0);
    EXPECT_EQ(clock.t_s, 1.0 / 60.0);
  }
}

TEST(SimClock, AStepAskedForWhileRunningIsForgotten) {
  SimClock clock{.step_once = true};
  tick(clock, 0.5);
  clock.paused = true;
  tick(clock, 0.5);
  EXPECT_EQ(clock.t_s, 0.5);
}

}  // namespace
}  // namespace swell::view
