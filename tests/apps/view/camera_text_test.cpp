#include "apps/view/camera_text.h"

#include <gtest/gtest.h>

#include <random>

namespace swell::view {
namespace {

TEST(CameraText, ASceneFileReadsTheSamePose) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1e6, 1e6), heading(0.0, 6.28318), pitch(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const CameraPose pose = {{place(random), place(random), 1e-3 * place(random)},
                             heading(random),
                             kPitchLimit_rad * pitch(random)};
    const scene::Camera lens = {.fov_y_rad = 0.2 + heading(random) / 3.0, .near_m = 0.125};
    const scene::Camera read = scene::parse_scene(camera_toml(pose, lens), "copied.toml").camera;
    ASSERT_EQ(read.eye_m, pose.eye_m);
    ASSERT_DOUBLE_EQ(read.heading_rad, pose.heading_rad);  // not all are a number of degrees
    ASSERT_DOUBLE_EQ(read.pitch_rad, pose.pitch_rad);
    ASSERT_DOUBLE_EQ(read.fov_y_rad, lens.fov_y_rad);
    ASSERT_EQ(read.near_m, lens.near_m);
  }
}

TEST(CameraText, TheFarthestPoseOfAFlightCanBeRead) {
  CameraPose pose = {{1e6, -1e6, 1e6}, 0.0, kPitchLimit_rad};
  pose = fly(pose, {.right = true, .up = true, .fast = true}, 0.1);
  EXPECT_EQ(scene::parse_scene(camera_toml(pose, {}), "copied.toml").camera.eye_m, pose.eye_m);
}

TEST(CameraText, SaysNoMoreThanIsNeeded) {
  const CameraPose pose = {{-15.0, -290.0, 5.0}, scene::radians(3.0), scene::radians(-6.0)};
  EXPECT_EQ(camera_toml(pose, {}),
            "[camera]\n"
            "eye_m = [-15.0, -290.0, 5.0]\n"
            "heading_deg = 3.0\n"
            "pitch_deg = -6.0\n"
            "fov_y_deg = 50.0\n"
            "near_m = 0.25\n");
}

TEST(CameraText, ACameraThatStandsStillIsCopiedInItsOwnNumbers) {
  scene::Camera camera = {.heading_rad = 0.1, .pitch_rad = 0.2};
  const View view = scene::camera_view(camera, 3.0, 64, 48);
  EXPECT_EQ(pose_of_scene(camera, view).pitch_rad, 0.2);
  camera.turn_rad_s = 0.1;
  const View later = scene::camera_view(camera, 3.0, 64, 48);
  EXPECT_NEAR(pose_of_scene(camera, later).heading_rad, 0.4, 3e-6);
}

}  // namespace
}  // namespace swell::view
