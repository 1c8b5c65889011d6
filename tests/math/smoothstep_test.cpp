#include "math/smoothstep.h"

#include <gtest/gtest.h>

#include "math/lattice.h"

namespace swell {
namespace {

TEST(Smoothstep, GoesFromNothingToOneInAnS) {
  EXPECT_EQ(smoothstep(2.0, 6.0, 1.0), 0.0);
  EXPECT_EQ(smoothstep(2.0, 6.0, 2.0), 0.0);
  EXPECT_EQ(smoothstep(2.0, 6.0, 3.0), 5.0 / 32.0);  // 3/16 - 2/64
  EXPECT_EQ(smoothstep(2.0, 6.0, 4.0), 0.5);
  EXPECT_EQ(smoothstep(2.0f, 6.0f, 6.0f), 1.0f);
  EXPECT_EQ(smoothstep(2.0f, 6.0f, 1e30f), 1.0f);
}

TEST(Smoothstep, FallsFromAHighEdgeToALowOne) {
  EXPECT_EQ(smoothstep(6.0, 2.0, 7.0), 0.0);
  EXPECT_EQ(smoothstep(6.0, 2.0, 5.0), 5.0 / 32.0);
  EXPECT_EQ(smoothstep(6.0, 2.0, 1.0), 1.0);
}

TEST(Smoothstep, IsFlatAtBothEnds) {
  EXPECT_LT(smooth_blend(1e-6), 4e-12);
  EXPECT_LT(1.0 - smooth_blend(1.0 - 1e-6), 4e-12);
}

TEST(LatticePoint, LiesWholeStepsFromItsCorner) {
  EXPECT_EQ(lattice_point({10.0, -20.0}, 0.25, {3.0, 8.0}), glm::dvec2(10.75, -18.0));
  EXPECT_EQ(lattice_point({10.0, -20.0}, 0.25, {0.0, 0.0}), glm::dvec2(10.0, -20.0));
  EXPECT_EQ(lattice_point({10.0, -20.0}, {0.25, 2.0}, {3.0, 8.0}), glm::dvec2(10.75, -4.0));
}

}  // namespace
}  // namespace swell
