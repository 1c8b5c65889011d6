// Floating objects: how the sea carries them, and their shapes.
#include "scene/objects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "scene/object_mesh.h"
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

glm::vec3 corner(const ObjectMesh& mesh, std::size_t triangle, int i) {
  return mesh.position[mesh.indices[3 * triangle + static_cast<std::size_t>(i)]];
}

glm::vec3 normal_at(const ObjectTriangle& t, glm::vec3 q) {
  return t.normal_at_origin + q.x * t.normal_along_x + q.y * t.normal_along_y +
         q.z * t.normal_along_z;
}

// By the divergence theorem.
double volume_of(const ObjectMesh& mesh) {
  double sum = 0.0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    sum += static_cast<double>(
        glm::dot(corner(mesh, n, 0), glm::cross(corner(mesh, n, 1), corner(mesh, n, 2))));
  return sum / 6.0;
}

TEST(ObjectMesh, BoxAndSphereHaveTheirVolumes) {
  EXPECT_NEAR(volume_of(make_object_mesh(ObjectKind::kBox, TopMark::kCan, 8)), 1.0, 1e-6);
  // A ball of diameter 1; 32 flat sides around and 16 along take 1.6 % away.
  const double ball = volume_of(make_object_mesh(ObjectKind::kSphere, TopMark::kCan, 32));
  EXPECT_NEAR(ball / (kPi / 6.0), 0.984, 0.004);
}

TEST(ObjectMesh, EveryShapeFitsItsBoxAndItsNormalsPointOut) {
  for (const ObjectKind kind : {ObjectKind::kBuoy, ObjectKind::kSphere, ObjectKind::kBox}) {
    for (const TopMark mark : {TopMark::kCan, TopMark::kCone, TopMark::kSphere}) {
      for (const int segments : {4, 8, 24, 32}) {
        const ObjectMesh mesh = make_object_mesh(kind, mark, segments);
        ASSERT_EQ(mesh.indices.size(), 3 * mesh.triangles.size());
        float top = 0.0f, bottom = 1.0f;
        for (const glm::vec3& q : mesh.position) {
          ASSERT_LE(std::max(std::abs(q.x), std::abs(q.y)), 0.5f + 1e-6f);
          top = std::max(top, q.z), bottom = std::min(bottom, q.z);
        }
        EXPECT_NEAR(top, 1.0f, 1e-6f);
        EXPECT_NEAR(bottom, 0.0f, 1e-6f);
        for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
          const glm::vec3 a = corner(mesh, n, 0), b = corner(mesh, n, 1), c = corner(mesh, n, 2);
          const glm::vec3 flat = glm::normalize(glm::cross(b - a, c - a));
          const glm::vec3 smooth = normal_at(mesh.triangles[n], (a + b + c) / 3.0f);
          ASSERT_GT(glm::dot(flat, glm::normalize(smooth)), 0.6f) << "triangle " << n;
        }
      }
    }
  }
}

// A sphere's normals at the corners are its radii.
TEST(ObjectMesh, ASpheresCornersHaveTheNormalsOfTheSphere) {
  const ObjectMesh mesh = make_object_mesh(ObjectKind::kSphere, TopMark::kCan, 24);
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 q = corner(mesh, n, i);
      const glm::vec3 radius = 2.0f * (q - glm::vec3(0.0f, 0.0f, 0.5f));
      EXPECT_LT(glm::distance(normal_at(mesh.triangles[n], q), radius), 2e-5f);
    }
  }
}

}  // namespace
}  // namespace swell::scene
