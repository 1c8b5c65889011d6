#include "apps/view/camera_controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "constants.h"
#include "math/elementary.h"

namespace swell::view {
namespace {

CameraPose at(double heading_rad, double pitch_rad, double height_m = 10.0) {
  return {{100.0, 200.0, height_m}, heading_rad, pitch_rad};
}

TEST(CameraControls, ForwardAtHeadingZeroGoesNorthAndAtAQuarterTurnEast) {
  const glm::dvec3 north = fly(at(0, 0), {.forward = true}, 0.05).eye_m - at(0, 0).eye_m;
  EXPECT_NEAR(north.x, 0.0, 1e-12);
  EXPECT_GT(north.y, 0.1);
  const glm::dvec3 east = fly(at(kTurn / 4, 0), {.forward = true}, 0.05).eye_m - at(0, 0).eye_m;
  EXPECT_GT(east.x, 0.1);
  EXPECT_NEAR(east.y, 0.0, 1e-12);
}

TEST(CameraControls, RightIsEastWhenLookingNorth) {
  const glm::dvec3 moved = fly(at(0, 0), {.right = true}, 0.05).eye_m - at(0, 0).eye_m;
  EXPECT_GT(moved.x, 0.1);
  EXPECT_EQ(moved.z, 0.0);
}

TEST(CameraControls, ForwardFollowsThePitchAndUpDoesNot) {
  const double pitch = -0.7;
  const glm::dvec3 forward = fly(at(0, pitch), {.forward = true}, 0.05).eye_m - at(0, 0).eye_m;
  EXPECT_NEAR(forward.z / forward.y, std::tan(pitch), 1e-9);
  const glm::dvec3 up = fly(at(0, pitch), {.up = true}, 0.05).eye_m - at(0, 0).eye_m;
  EXPECT_EQ(up.x, 0.0);
  EXPECT_EQ(up.y, 0.0);
  EXPECT_GT(up.z, 0.1);
}

TEST(CameraControls, ADiagonalIsAsFastAsAStraightLine) {
  const double straight =
      glm::length(fly(at(1, 0), {.forward = true}, 0.05).eye_m - at(1, 0).eye_m);
  const CameraInput diagonal{.forward = true, .right = true, .up = true};
  EXPECT_NEAR(glm::length(fly(at(1, 0), diagonal, 0.05).eye_m - at(1, 0).eye_m), straight, 1e-12);
}

TEST(CameraControls, OppositeKeysCancel) {
  const CameraInput all{
      .forward = true, .back = true, .left = true, .right = true, .up = true, .down = true};
  EXPECT_TRUE(is_idle(all));
  EXPECT_EQ(fly(at(1, 0.3), all, 0.05).eye_m, at(1, 0.3).eye_m);
}

TEST(CameraControls, ShiftIsFasterAndHeightIsFaster) {
  const auto distance = [](double height_m, bool fast) {
    const CameraPose pose = at(0, 0, height_m);
    return glm::length(fly(pose, {.forward = true, .fast = fast}, 0.05).eye_m - pose.eye_m);
  };
  EXPECT_GT(distance(5, true), 3 * distance(5, false));
  EXPECT_GT(distance(500, false), 3 * distance(5, false));
}

TEST(CameraControls, AStallDoesNotThrowTheCameraAway) {
  const CameraInput forward{.forward = true};
  EXPECT_EQ(fly(at(0, 0), forward, 30.0).eye_m, fly(at(0, 0), forward, 0.1).eye_m);
  EXPECT_EQ(fly(at(0, 0), forward, -1.0).eye_m, at(0, 0).eye_m);
}

TEST(CameraControls, MouseRightTurnsClockwiseAndMouseUpLooksUp) {
  const CameraPose pose = fly(at(1, 0), {.look_x_px = 10, .look_y_px = -10}, 0.0);
  EXPECT_GT(pose.heading_rad, 1.0);
  EXPECT_GT(pose.pitch_rad, 0.0);
}

TEST(CameraControls, AnyMouseMotionKeepsTheAnglesInRange) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> motion(-5000.0, 5000.0);
  CameraPose pose = at(0, 0);
  for (int i = 0; i < 2000; ++i) {
    pose = fly(pose, {.look_x_px = motion(random), .look_y_px = motion(random)}, 0.01);
    ASSERT_GE(pose.heading_rad, 0.0);
    ASSERT_LT(pose.heading_rad, kTurn);
    ASSERT_LE(std::abs(pose.pitch_rad), kPitchLimit_rad);
  }
}

TEST(CameraControls, APoseComesBackFromItsView) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> heading(0.01, 6.27), pitch(-1.5, 1.5);
  for (int i = 0; i < 200; ++i) {
    const CameraPose pose = at(heading(random), pitch(random));
    const View view = make_view(pose.eye_m, pose.heading_rad, pose.pitch_rad, 1.0, 0.1f, 64, 48);
    EXPECT_EQ(pose_of(view).eye_m, pose.eye_m);
    EXPECT_NEAR(pose_of(view).heading_rad, pose.heading_rad, 3e-6);
    EXPECT_NEAR(pose_of(view).pitch_rad, pose.pitch_rad, 3e-6);
  }
}

TEST(CameraControls, TheRollOfAViewIsKnown) {
  for (const double roll_rad : {-3.0, -1.2, -0.1, 0.0, 0.4, 2.5}) {
    const View view = make_view({1.0, 2.0, 3.0}, camera_axes(0.7, -0.3, roll_rad),
                                lens_of_fov(1.0, 64, 48), 0.25f, 64, 48);
    const CameraPose pose = pose_of(view);
    EXPECT_NEAR(pose.heading_rad, 0.7, 1e-6);
    EXPECT_NEAR(pose.pitch_rad, -0.3, 1e-6);
    EXPECT_NEAR(pose.roll_rad, roll_rad, 1e-6);
    EXPECT_EQ(fly(pose, {.forward = true, .look_x_px = 30.0}, 0.1).roll_rad, pose.roll_rad);
  }
}

TEST(CameraControls, AVerticalViewHasTheHeadingOfItsUpperEdge) {
  for (const double pitch_rad : {-kPi / 2.0, kPi / 2.0}) {
    const CameraPose pose = pose_of(make_view({}, 0.7, pitch_rad, 1.0, 0.25f, 64, 48));
    EXPECT_NEAR(pose.heading_rad, 0.7, 1e-6);
    EXPECT_NEAR(pose.roll_rad, 0.0, 1e-6);
    EXPECT_EQ(std::abs(pose.pitch_rad), kPitchLimit_rad);
  }
}

}  // namespace
}  // namespace swell::view
