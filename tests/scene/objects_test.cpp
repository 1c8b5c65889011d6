// Floating objects: how the sea carries them.
#include "scene/objects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

Scene one_sine(double amplitude_m, double wavelength_m) {
  Scene scene;
  scene.sea.spectrum = false;
  scene.sea.sines = {{amplitude_m, wavelength_m, 0.5 * kPi, 0.0, 5.0}};  // to the east
  return scene;
}

std::vector<ObjectPose> poses_at(const Scene& scene, std::span<const FloatingObject> objects,
                                 double t_s) {
  const Water water(scene);
  Workers workers(1);
  ocean::SeaFrame frame;
  std::vector<ObjectPose> poses(objects.size());
  object_poses(objects, water.at(t_s, frame, workers), poses);
  return poses;
}

FloatingObject box_at(glm::dvec2 position_m, double side_m) {
  FloatingObject box;
  box.kind = ObjectKind::kBox;
  box.position_m = position_m;
  box.size_m = glm::dvec3(side_m);
  return box;
}

TEST(ObjectPoses, OnFlatWaterAnObjectStandsUprightAndLooksAlongItsHeading) {
  FloatingObject object = box_at({12.0, -7.0}, 3.0);
  object.heading_rad = 0.5 * kPi;
  const ObjectPose pose = poses_at(one_sine(0.0, 10.0), {&object, 1}, 3.0)[0];
  EXPECT_EQ(pose.position_world, glm::dvec3(12.0, -7.0, 0.0));
  const glm::dmat3& axes = pose.world_from_object;
  EXPECT_NEAR(glm::distance(axes[0], glm::dvec3(0, -1, 0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(axes[1], glm::dvec3(1, 0, 0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(axes[2], glm::dvec3(0, 0, 1)), 0.0, 1e-15);
}

// Height and slope of a sin(2 pi (x / L - t / 5)), for hulls small against L. The second order of
// the hull's size takes k^2 (r^2 + (r/2)^2) / 8 = 1e-3 of the height.
TEST(ObjectPoses, OnLongWavesAnObjectRidesTheSurfaceAndLeansWithPartOfItsSlope) {
  const double amplitude_m = 2.0, length_m = 100.0, k = 2.0 * kPi / length_m;
  std::vector<FloatingObject> objects;
  for (int i = 0; i < 40; ++i) {
    objects.push_back(box_at({300.0 * (random_uniform(9, i) - 0.5), 0.0}, 2.0));
    objects.back().heading_rad = 6.28 * random_uniform(10, i);
  }
  const double t_s = 1.7;
  const auto poses = poses_at(one_sine(amplitude_m, length_m), objects, t_s);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const double phase = k * objects[i].position_m.x - 2.0 * kPi * t_s / 5.0;
    EXPECT_NEAR(poses[i].position_world.z, amplitude_m * std::sin(phase), 2.5e-3 * amplitude_m);
    const glm::dvec3 up = poses[i].world_from_object[2];
    EXPECT_NEAR(-up.x / up.z, kTiltShare * amplitude_m * k * std::cos(phase), 5e-4);
    EXPECT_NEAR(up.y, 0.0, 1e-6);
  }
}

TEST(ObjectPoses, WavesShorterThanTheHullHardlyLiftIt) {
  const double amplitude_m = 0.3;
  const Scene scene = one_sine(amplitude_m, 7.0);
  double large_square = 0.0, small_square = 0.0;
  const FloatingObject objects[] = {box_at({0.0, 0.0}, 12.0), box_at({0.0, 0.0}, 0.5)};
  for (int i = 0; i < 20; ++i) {
    const auto poses = poses_at(scene, objects, 0.25 * i);
    large_square += poses[0].position_world.z * poses[0].position_world.z;
    small_square += poses[1].position_world.z * poses[1].position_world.z;
  }
  EXPECT_NEAR(std::sqrt(small_square / 20.0), amplitude_m / std::sqrt(2.0), 0.01);
  EXPECT_LT(std::sqrt(large_square), 0.35 * std::sqrt(small_square));
}

TEST(ObjectPoses, AxesAreOrthonormalAndRightHandedOnAnySea) {
  Scene scene;
  scene.sea.resolution = 64;
  std::vector<FloatingObject> objects;
  for (int i = 0; i < 50; ++i) {
    FloatingObject object = box_at({400.0 * random_uniform(1, i), 400.0 * random_uniform(2, i)},
                                   0.1 + 20.0 * random_uniform(3, i));
    object.heading_rad = 6.28 * random_uniform(4, i);
    objects.push_back(object);
  }
  for (const ObjectPose& pose : poses_at(scene, objects, 11.0)) {
    const glm::dmat3& axes = pose.world_from_object;
    const glm::dmat3 product = glm::transpose(axes) * axes;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, 1e-14);
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-14);
  }
}

TEST(ObjectPoses, OtherObjectsChangeNoBit) {
  Scene scene;
  scene.sea.resolution = 64;
  std::vector<FloatingObject> objects;
  for (int i = 0; i < 20; ++i) objects.push_back(box_at({17.0 * i, 5.0}, 1.0 + 0.3 * i));
  const auto together = poses_at(scene, objects, 5.0);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectPose alone = poses_at(scene, {&objects[i], 1}, 5.0)[0];
    EXPECT_EQ(alone.position_world, together[i].position_world);
    EXPECT_EQ(alone.world_from_object, together[i].world_from_object);
  }
}

TEST(ObjectPoses, AFixedObjectStandsUprightAtItsHeightWhateverTheWavesAre) {
  FloatingObject pier = common_object(ObjectKind::kPier);
  EXPECT_EQ(pier.motion, Motion::kFixed);
  pier.position_m = {3.0, 4.0};
  pier.height_m = 0.25;
  pier.size_m = {0.5, 0.5, 7.0};
  const Scene scene = one_sine(1.0, 60.0);
  for (const double t_s : {0.0, 1.3, 2.9}) {
    const ObjectPose pose = poses_at(scene, {&pier, 1}, t_s)[0];
    EXPECT_EQ(pose.position_world, glm::dvec3(3.0, 4.0, 0.25));
    EXPECT_EQ(pose.world_from_object[2], glm::dvec3(0.0, 0.0, 1.0));
    // What mirrors it is the water, all the same.
    EXPECT_NEAR(pose.water_m, std::sin(2.0 * kPi * (3.0 / 60.0 - t_s / 5.0)), 2e-3);
  }
}

TEST(ObjectPoses, AFixedObjectThatRollsLowersItsRightSide) {
  FloatingObject aircraft = box_at({5.0, 6.0}, 4.0);
  aircraft.motion = Motion::kFixed;
  aircraft.heading_rad = 0.5 * kPi;  // east: its right is south
  aircraft.roll_rad = radians(30.0);
  const Scene scene = one_sine(1.0, 60.0);
  const glm::dmat3 axes = poses_at(scene, {&aircraft, 1}, 1.3)[0].world_from_object;
  const double c = std::sqrt(0.75);
  EXPECT_NEAR(glm::distance(axes[0], glm::dvec3(0.0, -c, -0.5)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(axes[1], glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(axes[2], glm::dvec3(0.0, -0.5, c)), 0.0, 1e-12);
  aircraft.motion = Motion::kFloat;
  const glm::dmat3 afloat = poses_at(scene, {&aircraft, 1}, 1.3)[0].world_from_object;
  EXPECT_GT(afloat[2].z, 0.99) << "the water alone tilts it";
}

// A square of 40 m, gone round at 2 m/s by a boat of 4 m.
TEST(ObjectPoses, OnAPathAnObjectGoesAtItsSpeedAndTurnsAsLongAsItIs) {
  FloatingObject boat = box_at({1e5, 1e5}, 4.0);
  boat.path_m = {{0, 0}, {0, 40}, {40, 40}, {40, 0}};
  boat.speed_mps = 2.0;
  const PlanPose start = plan_pose(boat, 10.0);
  EXPECT_NEAR(glm::distance(start.position_m, glm::dvec2(0, 20)), 0.0, 1e-12);
  EXPECT_NEAR(start.heading_rad, 0.0, 1e-12);
  const PlanPose east = plan_pose(boat, 30.0);
  EXPECT_NEAR(glm::distance(east.position_m, glm::dvec2(20, 40)), 0.0, 1e-12);
  EXPECT_NEAR(east.heading_rad, 0.5 * kPi, 1e-12);
  // At the corner bow and stern are each 2 m from it.
  const PlanPose corner = plan_pose(boat, 20.0);
  EXPECT_NEAR(glm::distance(corner.position_m, glm::dvec2(1, 39)), 0.0, 1e-12);
  EXPECT_NEAR(corner.heading_rad, 0.25 * kPi, 1e-12);
  // Round and round, backwards in time too.
  for (const double t_s : {10.0, 33.0, 71.5}) {
    for (const double rounds : {-3.0, 1.0, 250.0}) {
      const PlanPose once = plan_pose(boat, t_s), again = plan_pose(boat, t_s + 80.0 * rounds);
      EXPECT_NEAR(glm::distance(once.position_m, again.position_m), 0.0, 1e-9);
      EXPECT_NEAR(std::remainder(once.heading_rad - again.heading_rad, 2.0 * kPi), 0.0, 1e-9);
    }
  }
  double last_rad = plan_pose(boat, 0.0).heading_rad;
  for (int i = 1; i <= 8000; ++i) {
    const PlanPose now = plan_pose(boat, 0.01 * i), before = plan_pose(boat, 0.01 * (i - 1));
    EXPECT_LT(glm::distance(now.position_m, before.position_m), 0.0201);
    EXPECT_LT(std::abs(std::remainder(now.heading_rad - last_rad, 2.0 * kPi)), 0.02);
    last_rad = now.heading_rad;
  }
  boat.path_closed = false;
  EXPECT_EQ(plan_pose(boat, 61.0).position_m, plan_pose(boat, 1e6).position_m);
  EXPECT_NEAR(glm::distance(plan_pose(boat, 1e6).position_m, glm::dvec2(40, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(plan_pose(boat, -1e6).position_m, glm::dvec2(0, 0)), 0.0, 1e-12);
}

}  // namespace
}  // namespace swell::scene
