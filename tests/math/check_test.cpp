#include "math/check.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/elementary.h"
#include "math/parallel.h"
#include "math/view.h"

namespace swell {
namespace {

int evaluations = 0;
bool counted(bool result) {
  ++evaluations;
  return result;
}

TEST(Check, PrintsPlaceExpressionAndValuesBeforeItAborts) {
  const int size = -3;
  EXPECT_DEATH(SWELL_CHECK(size >= 0, "size={}", size),
               "check failed: .*check_test\\.cpp:[0-9]+: size >= 0 \\(size=-3\\)");
}

TEST(Check, EvaluatesItsConditionOnceAndContinuesIfTrue) {
  evaluations = 0;
  SWELL_CHECK(counted(true), "evaluations={}", evaluations);
  EXPECT_EQ(evaluations, 1);
}

TEST(Check, IsOneStatementThatAnElseMayFollow) {
  bool reached = false;
  if (evaluations < 0)
    SWELL_CHECK(false, "evaluations={}", evaluations);
  else
    reached = true;
  EXPECT_TRUE(reached);
}

TEST(Check, InnerChecksRunOnlyInCheckedBuilds) {
#ifdef SWELL_DCHECKS
  EXPECT_DEATH(SWELL_DCHECK(1 + 1 == 3, "sum={}", 2), "1 \\+ 1 == 3 \\(sum=2\\)");
#else
  evaluations = 0;
  SWELL_DCHECK(counted(false), "evaluations={}", evaluations);
  EXPECT_EQ(evaluations, 0);
#endif
}

TEST(Check, GuardsThePublicEntriesOfTheFolder) {
  EXPECT_DEATH(Workers(0), "thread_count=0");
  EXPECT_DEATH(Workers(257), "thread_count=257");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DEATH(make_view({}, 0, 0, 1.0, 0.1f, 0, 10), "size=0x10");
  EXPECT_DEATH(make_view({}, 0, 0, 1.0, 0.1f, 10, -1), "size=10x-1");
  EXPECT_DEATH(make_view({}, 0, 0, kPi, 0.1f, 10, 10), "fov_y_rad=3.14");
  EXPECT_DEATH(make_view({}, 0, 0, nan, 0.1f, 10, 10), "fov_y_rad=nan");
  EXPECT_DEATH(make_view({}, 0, 0, 1.0, 0.0f, 10, 10), "near_m=0");
  EXPECT_DEATH(make_view({}, nan, 0, 1.0, 0.1f, 10, 10), "heading_rad=nan");
  EXPECT_DEATH(make_view({}, 0, nan, 1.0, 0.1f, 10, 10), "pitch_rad=nan");
}

}  // namespace
}  // namespace swell
