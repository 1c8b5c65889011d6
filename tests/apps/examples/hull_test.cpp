// The physics of the boats of examples/, by what Archimedes and a pendulum say.
#include "ros2/hull.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace {

constexpr double kStep_s = 1e-3;
using Water = std::array<double, kColumnCount>;

Water sloped(const Hull& hull, double east, double north) {
  Water water{};
  for (std::size_t n = 0; n < kColumnCount; ++n)
    water[n] = east * hull.foot(n).x_m + north * hull.foot(n).y_m;
  return water;
}

void run(Hull& hull, double seconds, const Water& water = {}) {
  for (int k = 0; k < std::lround(seconds / kStep_s); ++k) hull.step(water, kStep_s);
}

TEST(ExampleHull, StaysAtItsWaterlineInStillWater) {
  Hull hull;
  run(hull, 5.0);
  EXPECT_NEAR(hull.z_m, 0.0, 1e-9);
  EXPECT_NEAR(hull.roll_rad, 0.0, 1e-9);
  EXPECT_NEAR(hull.pitch_rad, 0.0, 1e-9);
}

TEST(ExampleHull, ComesToRestWhereItsWeightIsThatOfTheWater) {
  Hull hull;
  hull.z_m = 0.2;
  hull.roll_rad = 0.2;
  hull.pitch_rad = -0.1;
  run(hull, 30.0);
  EXPECT_NEAR(hull.z_m, 0.0, 1e-6);
  EXPECT_NEAR(hull.roll_rad, 0.0, 1e-6);
  EXPECT_NEAR(hull.pitch_rad, 0.0, 1e-6);
}

// A column of the draught d swings as a pendulum of that length; damping makes it slower.
TEST(ExampleHull, HeavesWithThePeriodOfItsDraught) {
  Hull hull;
  hull.z_m = 0.1;
  double crossed_s[2] = {};
  int crossings = 0;
  double before_m = hull.z_m;
  for (int k = 1; crossings < 2; ++k) {
    hull.step({}, kStep_s);
    if (before_m > 0.0 && hull.z_m <= 0.0) crossed_s[crossings++] = k * kStep_s;
    before_m = hull.z_m;
  }
  const double omega = std::sqrt(Hull::kGravity_mps2 / Hull::kDraught_m);
  const double damping = 0.5 * omega * Hull::kDampingTime_s;
  const double period_s = 2.0 * std::numbers::pi / (omega * std::sqrt(1.0 - damping * damping));
  EXPECT_NEAR(crossed_s[1] - crossed_s[0], period_s, 0.01 * period_s);
}

TEST(ExampleHull, LiesAsAGentleSlopeOfTheWaterDoes) {
  for (const double yaw_rad : {0.0, 0.5 * std::numbers::pi}) {
    Hull hull;
    hull.yaw_rad = yaw_rad;
    // 2 cm a metre up to the north: the left of a boat that points east, ahead of one to the north.
    for (int k = 0; k < 20'000; ++k) hull.step(sloped(hull, 0.0, 0.02), kStep_s);
    const double along_m = yaw_rad == 0.0 ? hull.roll_rad : -hull.pitch_rad;
    const double across_m = yaw_rad == 0.0 ? hull.pitch_rad : hull.roll_rad;
    EXPECT_GT(along_m, 0.015) << yaw_rad;
    EXPECT_LT(along_m, 0.05) << yaw_rad;
    EXPECT_NEAR(across_m, 0.0, 1e-3) << yaw_rad;
  }
}

TEST(ExampleHull, HasTheTurnsOfRep103) {
  Hull hull;
  hull.roll_rad = 0.1;
  EXPECT_GT(hull.foot(2).z_m, hull.foot(3).z_m);  // left and right: a positive roll has left up
  EXPECT_NEAR(hull.orientation().x, std::sin(0.05), 1e-15);
  hull.roll_rad = 0.0, hull.pitch_rad = 0.1;
  EXPECT_LT(hull.foot(0).z_m, hull.foot(4).z_m);  // a positive pitch has the bow down
  EXPECT_NEAR(hull.orientation().y, std::sin(0.05), 1e-15);
  hull.pitch_rad = 0.0, hull.yaw_rad = 0.5 * std::numbers::pi;
  EXPECT_GT(hull.foot(0).y_m, 1.6);  // and a yaw of a quarter turn points north
  EXPECT_NEAR(hull.orientation().z, std::sqrt(0.5), 1e-15);
}

// By the quaternion's matrix, which is written out by hand: q v q* for v = (a, l, -d).
TEST(ExampleHull, FeetAreWhereTheOrientationTurnsThem) {
  Hull hull;
  hull.x_m = 3.0, hull.y_m = -2.0, hull.z_m = 0.4;
  hull.yaw_rad = 1.1, hull.pitch_rad = -0.3, hull.roll_rad = 0.4;
  const auto [x, y, z, w] = hull.orientation();
  for (std::size_t n = 0; n < kColumnCount; ++n) {
    const double a = kColumns[n].ahead_m, l = kColumns[n].left_m, u = -Hull::kDraught_m;
    const Hull::Place at = hull.foot(n);
    EXPECT_NEAR(at.x_m - 3.0,
                (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - z * w) * l + 2 * (x * z + y * w) * u,
                1e-12);
    EXPECT_NEAR(at.y_m + 2.0,
                2 * (x * y + z * w) * a + (1 - 2 * (x * x + z * z)) * l + 2 * (y * z - x * w) * u,
                1e-12);
    EXPECT_NEAR(at.z_m - 0.4,
                2 * (x * z - y * w) * a + 2 * (y * z + x * w) * l + (1 - 2 * (x * x + y * y)) * u,
                1e-12);
  }
}

}  // namespace
