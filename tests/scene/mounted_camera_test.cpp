// Cameras that floating objects carry.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "scene/expect_near.h"
#include "scene/objects.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

constexpr int kWidth_px = 640, kHeight_px = 360;

// A buoy somewhere, and a boat that carries the camera.
Scene scene_with_boat() {
  Scene scene;
  scene.sea.resolution = 64;
  scene.sea.wind_speed_mps = 14.0;
  scene.objects.resize(2);
  scene.objects[0].name = "buoy";
  FloatingObject& boat = scene.objects[1];
  boat = {.kind = ObjectKind::kBox, .position_m = {40.0, -25.0}, .size_m = {2.0, 6.0, 2.0}};
  boat.heading_rad = 0.5 * kPi;
  boat.name = "boat";
  scene.camera.mount = "boat";
  scene.camera.mount_offset_m = {0.5, 2.0, 1.5};
  return scene;
}

struct Moment {
  View view;
  ObjectPose boat;
};
Moment at_time(const Scene& scene, double t_s) {
  const Water water(scene);
  Workers workers(1);
  ocean::SeaFrame frame;
  const WaterSurface surface = water.at(t_s, frame, workers);
  std::vector<ObjectPose> poses(scene.objects.size());
  object_poses(scene.objects, surface, poses);
  return {camera_view(scene, surface, t_s, kWidth_px, kHeight_px), poses[1]};
}

glm::dvec2 project(const View& view, glm::dvec3 p_world) {
  const glm::dvec4 clip =
      glm::dmat4(view.clip_from_rel) * glm::dvec4(p_world - view.eye_world, 1.0);
  return {(1.0 + clip.x / clip.w) * 0.5 * view.width_px,
          (1.0 - clip.y / clip.w) * 0.5 * view.height_px};
}

// The boat lies at (40, -25) and looks east.
TEST(MountedCamera, OnFlatWaterLooksFromItsPlaceOnTheObject) {
  Scene scene = scene_with_boat();
  scene.sea.spectrum = false;
  const View ahead = at_time(scene, 3.0).view;
  expect_near(ahead.eye_world, {42.0, -25.5, 1.5}, 1e-12);
  expect_near(ahead.forward, {1, 0, 0}, 1e-7);
  expect_near(ahead.up, {0, 0, 1}, 1e-7);
  scene.camera.heading_rad = 0.5 * kPi;  // to the right of the boat
  scene.camera.pitch_rad = kPi / 6.0;
  expect_near(at_time(scene, 3.0).view.forward, {0, -std::sqrt(0.75), 0.5}, 1e-7);
  scene.camera.turn_rad_s = 0.5 * kPi;
  scene.camera.pitch_rad = 0.0;
  expect_near(at_time(scene, 1.0).view.forward, {-1, 0, 0}, 1e-7);
  scene.camera.quaternion = glm::dvec4(1.0, 0.0, 0.0, 0.0);  // the picture's right is the boat's
  expect_near(at_time(scene, 1.0).view.right, {0, -1, 0}, 1e-7);
  expect_near(at_time(scene, 1.0).view.forward, {0, 0, 1}, 1e-7);
}

TEST(MountedCamera, APointOfTheObjectStaysAtItsPixel) {
  Scene scene = scene_with_boat();
  scene.camera.heading_rad = 0.2;
  scene.camera.pitch_rad = -0.3;
  scene.camera.roll_rad = 0.1;
  const glm::dvec3 bow(0.7, 6.0, 0.4);
  std::vector<glm::dvec2> at_px;
  double low_m = INFINITY, high_m = -INFINITY, most_roll = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Moment now = at_time(scene, 0.7 * i);
    at_px.push_back(project(now.view, now.boat.position_world + now.boat.world_from_object * bow));
    EXPECT_NEAR(glm::distance(at_px.back(), at_px.front()), 0.0, 1e-3) << i;
    low_m = std::min(low_m, now.view.eye_world.z);
    high_m = std::max(high_m, now.view.eye_world.z);
    most_roll = std::max(most_roll, std::abs(now.boat.world_from_object[0].z));
  }
  EXPECT_GT(at_px[0].x, 0.0);
  EXPECT_LT(at_px[0].x, kWidth_px);
  EXPECT_GT(high_m - low_m, 0.5);  // while it goes up and down and rolls
  EXPECT_GT(most_roll, 0.02);
}

TEST(MountedCamera, IsCarriedByTheObjectOfItsNameWhereverItStandsInTheList) {
  Scene scene = scene_with_boat();
  const View before = at_time(scene, 5.0).view;
  std::swap(scene.objects[0], scene.objects[1]);
  const Water water(scene);
  Workers workers(1);
  ocean::SeaFrame frame;
  const View after = camera_view(scene, water.at(5.0, frame, workers), 5.0, kWidth_px, kHeight_px);
  EXPECT_EQ(before.eye_world, after.eye_world);
  EXPECT_EQ(before.clip_from_rel, after.clip_from_rel);
}

TEST(MountedCamera, OnTwoTrianglesStaysAtTheMeanLevelAsItsObjectDoes) {
  Scene scene = scene_with_boat();
  scene.detail.triangulation = Triangulation::kPlane;
  const Moment now = at_time(scene, 5.0);
  const glm::dvec3 offset = now.boat.world_from_object * scene.camera.mount_offset_m;
  EXPECT_NEAR(now.view.eye_world.z, offset.z, 1e-12);
}

TEST(MountedCamera, WithoutAMountTheViewIsTheCamerasOwn) {
  Scene scene = scene_with_boat();
  scene.camera.mount.clear();
  scene.camera.mount_offset_m = {};
  scene.camera.velocity_mps = {3.0, 1.0, 0.0};
  const View view = at_time(scene, 5.0).view;
  const View own = camera_view(scene.camera, 5.0, kWidth_px, kHeight_px);
  EXPECT_EQ(view.eye_world, own.eye_world);
  EXPECT_EQ(view.clip_from_rel, own.clip_from_rel);
}

}  // namespace
}  // namespace swell::scene
