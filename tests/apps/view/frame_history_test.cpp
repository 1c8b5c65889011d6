#include "apps/view/frame_history.h"

#include <gtest/gtest.h>

namespace swell::view {
namespace {

TEST(FrameHistory, AnEmptyHistoryHasZerosForAnswers) {
  EXPECT_EQ(percentile_ms({}, 0.5), 0.0);
  EXPECT_EQ(share_over_budget({}), 0.0);
}

TEST(FrameHistory, PercentilesAreNearestRanks) {
  FrameHistory history;
  for (const double ms : {5.0, 1.0, 4.0, 2.0, 3.0}) add_frame(history, ms);
  EXPECT_EQ(percentile_ms(history, 0.0), 1.0);
  EXPECT_EQ(percentile_ms(history, 0.5), 3.0);
  EXPECT_EQ(percentile_ms(history, 0.95), 5.0);
  EXPECT_EQ(percentile_ms(history, 1.0), 5.0);
}

TEST(FrameHistory, OnlyTheLastFramesAreKept) {
  FrameHistory history;
  for (std::size_t i = 0; i < 1000; ++i) add_frame(history, 100.0);
  for (std::size_t i = 0; i < FrameHistory::kLength; ++i) add_frame(history, 1.0);
  EXPECT_EQ(history.count, FrameHistory::kLength);
  EXPECT_EQ(percentile_ms(history, 1.0), 1.0);
}

TEST(FrameHistory, ExactlyTheBudgetIsNotOverIt) {
  FrameHistory history;
  for (const double ms : {16.0, 17.0, 17.5, 40.0}) add_frame(history, ms);
  EXPECT_EQ(share_over_budget(history), 0.5);
}

}  // namespace
}  // namespace swell::view
