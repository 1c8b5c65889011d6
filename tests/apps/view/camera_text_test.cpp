#include "apps/view/camera_text.h"

#include <gtest/gtest.h>

#include <random>

#include "math/elementary.h"

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
  const CameraPose pose = {{-15.0, -290.0, 5.0}, radians(3.0), radians(-6.0)};
  EXPECT_EQ(camera_toml(pose, {}),
            "[camera]\n"
            "eye_m = [-15.0, -290.0, 5.0]\n"
            "heading_deg = 3.0\n"
            "pitch_deg = -6.0\n"
            "fov_y_deg = 50.0\n"
            "near_m = 0.25\n");
}

TEST(CameraText, RollAndTheMatrixKComeBackToo) {
  const CameraPose pose = {{1.0, 2.0, 3.0}, 0.5, -0.25, radians(7.0)};
  const scene::Camera lens = {.near_m = 0.5,
                              .focal_px = glm::dvec2(912.5, 910.75),
                              .principal_px = glm::dvec2(644.0, 352.5),
                              .size_px = glm::dvec2(1280.0, 720.0)};
  const std::string text = camera_toml(pose, lens);
  EXPECT_EQ(text.find("fov"), std::string::npos) << text;
  const scene::Camera read = scene::parse_scene(text, "copied.toml").camera;
  EXPECT_DOUBLE_EQ(read.roll_rad, pose.roll_rad);
  EXPECT_EQ(read.focal_px, lens.focal_px);
  EXPECT_EQ(read.principal_px, lens.principal_px);
  EXPECT_EQ(read.size_px, lens.size_px);
  EXPECT_EQ(read.near_m, 0.5);
}

TEST(CameraText, ACameraThatStandsStillIsCopiedInItsOwnNumbers) {
  scene::Camera camera = {.heading_rad = 0.1, .pitch_rad = 0.2};
  const View view = scene::camera_view(camera, 3.0, 64, 48);
  EXPECT_EQ(pose_of_scene(camera, view).pitch_rad, 0.2);
  camera.turn_rad_s = 0.1;
  const View later = scene::camera_view(camera, 3.0, 64, 48);
  EXPECT_NEAR(pose_of_scene(camera, later).heading_rad, 0.4, 3e-6);
  camera.turn_rad_s = 0.0;
  camera.roll_rad = 0.3;
  EXPECT_EQ(pose_of_scene(camera, view).roll_rad, 0.3);
}

TEST(CameraText, AQuaternionIsReadFromTheView) {
  scene::Camera camera;
  camera.quaternion = {0.5, -0.5, 0.5, -0.5};  // looks east
  const CameraPose pose = pose_of_scene(camera, scene::camera_view(camera, 0.0, 64, 48));
  EXPECT_NEAR(pose.heading_rad, kPi / 2.0, 1e-6);
  EXPECT_NEAR(pose.pitch_rad, 0.0, 1e-6);
  EXPECT_NEAR(pose.roll_rad, 0.0, 1e-6);
}

}  // namespace
}  // namespace swell::view
