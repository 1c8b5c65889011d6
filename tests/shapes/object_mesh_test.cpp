// Shapes of objects as triangles.
#include "shapes/object_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "math/elementary.h"
#include "scene/file/implicit_file.h"
#include "scene/objects.h"
#include "scene/obstacles.h"
#include "scene/scene.h"
#include "shapes/implicit_mesh.h"

namespace swell::shapes {
namespace {

using scene::common_object;
using scene::kObjectKindNames;
using scene::ObjectKind;
using scene::TopMark;

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

// What rivers part before (scene/obstacles.h) holds the waterlines that pictures show.
TEST(ObjectMesh, PlansThatRiversPartBeforeHoldTheWaterlines) {
  ocean::River river;
  river.path_m = {{0.0, -500.0}, {0.0, 500.0}};
  river.width_m = {400.0};
  river.surface_m = {0.0, 0.0};
  for (const ObjectKind kind :
       {ObjectKind::kBuoy, ObjectKind::kSphere, ObjectKind::kBox, ObjectKind::kBoat,
        ObjectKind::kSailboat, ObjectKind::kPier, ObjectKind::kLighthouse, ObjectKind::kRock}) {
    SCOPED_TRACE(kObjectKindNames[kind]);
    scene::Scene scene;
    scene.rivers = {river};
    scene.objects = {common_object(kind)};
    const auto obstacles = scene::river_obstacles(scene, {scene.rivers, scene.lakes});
    int parts = 0;
    for (const MeshPart& part :
         mesh_parts(scene.objects[0], make_object_mesh(kind, TopMark::kCan, 24))) {
      if (part.half.x <= 0.0f) continue;
      const glm::dvec2 size(scene.objects[0].size_m), middle = glm::dvec2(part.middle) * size;
      double least = 1e9;
      for (const ocean::Obstacle& o : obstacles) {
        double most = 0.0;
        for (int k = 0; k < 24; ++k) {
          const SinCos turn = sin_cos_turns(k / 24.0);
          const glm::dvec2 way = glm::dvec2(part.half) * size * glm::dvec2(turn.cos, turn.sin);
          most = std::max(most, ocean::sizes_from(o, middle + way));
        }
        least = std::min(least, most);
      }
      EXPECT_LT(least, 1.02);
      ++parts;
    }
    EXPECT_EQ(static_cast<std::size_t>(parts), obstacles.size());
  }
}

TEST(ObjectMesh, BoatsPiersLighthousesAndRocksFillTheirBoxes) {
  for (const ObjectKind kind : {ObjectKind::kBoat, ObjectKind::kSailboat, ObjectKind::kPier,
                                ObjectKind::kLighthouse, ObjectKind::kRock}) {
    for (const int segments : {8, 24}) {
      SCOPED_TRACE(kObjectKindNames[kind]);
      const ObjectMesh mesh = make_object_mesh(kind, TopMark::kCan, segments);
      ASSERT_EQ(mesh.indices.size(), 3 * mesh.triangles.size());
      EXPECT_LE(mesh.triangles.size(), 2048u);
      glm::vec3 low(9.0f), high(-9.0f);
      for (const glm::vec3& q : mesh.position) low = glm::min(low, q), high = glm::max(high, q);
      const glm::vec3 wanted_low(-0.5f, -0.5f, 0.0f), wanted_high(0.5f, 0.5f, 1.0f);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(low[c], wanted_low[c] - 1e-5f);
        EXPECT_LE(low[c], wanted_low[c] + 0.03f);
        EXPECT_LE(high[c], wanted_high[c] + 1e-5f);
        EXPECT_GE(high[c], wanted_high[c] - 0.03f);
      }
      for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const glm::vec3 a = corner(mesh, n, 0), b = corner(mesh, n, 1), c = corner(mesh, n, 2);
        const glm::vec3 smooth = normal_at(mesh.triangles[n], (a + b + c) / 3.0f);
        ASSERT_TRUE(std::isfinite(glm::dot(smooth, smooth)));
        ASSERT_GT(glm::dot(mesh.triangles[n].flat_normal, smooth), 0.0f) << "triangle " << n;
      }
      // Each triangle is in one part.
      std::uint32_t next = 0;
      for (const MeshPart& part : mesh_parts(common_object(kind), mesh)) {
        EXPECT_EQ(part.first_triangle, next);
        next += part.triangles;
      }
      EXPECT_EQ(next, mesh.triangles.size());
    }
  }
}

// A boat's waterline is as long and as broad as its hull is there; a pier's are its posts'.
TEST(ObjectMesh, PartsKnowWhereTheyCutTheWater) {
  const auto parts_of = [](ObjectKind kind) {
    return mesh_parts(common_object(kind), make_object_mesh(kind, TopMark::kCan, 24));
  };
  const auto boat = parts_of(ObjectKind::kBoat);
  ASSERT_EQ(boat.size(), 1u);
  EXPECT_GT(boat[0].half.x, 0.25f);
  EXPECT_LT(boat[0].half.x, 0.48f);
  EXPECT_NEAR(boat[0].middle.x, 0.0f, 1e-3f);
  const auto pier = parts_of(ObjectKind::kPier);
  ASSERT_EQ(pier.size(), 19u);
  EXPECT_EQ(pier[0].half, glm::vec2(0.0f)) << "the deck";
  for (std::size_t i = 1; i < pier.size(); ++i)
    EXPECT_NEAR(pier[i].half.x * common_object(ObjectKind::kPier).size_m.x, 0.16, 1e-4);
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

// 100 times fewer bytes than triangles that lie as near: the paper's figure.
TEST(ImplicitSurface, ShippedImplicitsAreSmall) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(SWELL_SOURCE_DIR) / "scenes/forms")) {
    EXPECT_LT(entry.file_size(), 4096u) << entry.path();
    const MeshOfFile mesh = with_meshes(scene::load_implicit(entry.path().string()));
    EXPECT_GT(mesh.levels.front().triangles.size(), 1000u);
    ++count;
  }
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace swell::shapes
