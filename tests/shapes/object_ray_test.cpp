// Rays against floating objects.
#include "shapes/object_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "math/elementary.h"
#include "math/random.h"

namespace swell::shapes {
namespace {

struct Placed {
  scene::FloatingObject object;
  scene::ObjectPose pose;
  ObjectMesh mesh;

  std::optional<ObjectHit> hit(glm::dvec3 origin, glm::dvec3 direction) const {
    return intersect_ray(object, pose, mesh, origin, direction);
  }
};

// Upright, looking north.
Placed placed(scene::ObjectKind kind, glm::dvec3 size_m, double draught,
              glm::dvec3 waterline_world) {
  Placed result;
  result.object.kind = kind;
  result.object.size_m = size_m;
  result.object.draught = draught;
  result.pose.position_world = waterline_world;
  result.mesh = make_object_mesh(kind, scene::TopMark::kCan, 24);
  return result;
}

// A die that gives numbers in [-1, 1).
struct RayDice {
  std::uint64_t next = 0;
  double roll() { return 2.0 * random_uniform(31, next++) - 1.0; }
  glm::dvec3 point() {
    const double x = roll(), y = roll();
    return {x, y, roll()};
  }
};

TEST(ObjectRay, HitsTheFacesOfABoxWhereTheyAre) {
  Placed box = placed(scene::ObjectKind::kBox, {2.0, 4.0, 3.0}, 0.5, {10.0, 20.0, 0.7});
  // Turned to look east: 4 m from west to east, 2 m from south to north.
  box.pose.world_from_object = glm::dmat3({0, -1, 0}, {1, 0, 0}, {0, 0, 1});
  const auto distance_m = [&](glm::dvec3 origin, glm::dvec3 direction) {
    const auto hit = box.hit(origin, direction);
    return hit ? hit->distance_m : -1.0;
  };
  EXPECT_NEAR(distance_m({30.0, 20.3, 0.9}, {-1, 0, 0}), 18.0, 1e-12);
  EXPECT_NEAR(distance_m({9.0, 0.0, 1.1}, {0, 1, 0}), 19.0, 1e-12);
  EXPECT_NEAR(distance_m({9.0, 0.0, 1.1}, {0, 250, 0}), 19.0, 1e-12) << "a longer direction";
  EXPECT_NEAR(distance_m({8.5, 20.5, 50.0}, {0, 0, -1}), 47.8, 1e-12);
  EXPECT_NEAR(distance_m({10.0, 20.0, 0.7}, {0, 0, 1}), 1.5, 1e-12) << "from inside";
  EXPECT_EQ(distance_m({30.0, 20.3, 0.9}, {1, 0, 0}), -1.0) << "behind";
  EXPECT_EQ(distance_m({30.0, 21.1, 0.9}, {-1, 0, 0}), -1.0) << "beside";
}

// Where the ray first meets a sphere, by the quadratic formula.
std::optional<double> sphere_distance(glm::dvec3 centre, double radius, glm::dvec3 origin,
                                      glm::dvec3 along) {
  const glm::dvec3 from = origin - centre;
  const double half_b = glm::dot(from, along), c = glm::dot(from, from) - radius * radius;
  const double discriminant = half_b * half_b - c;
  if (discriminant < 0.0) return std::nullopt;
  return -half_b - std::sqrt(discriminant);
}

// Sides 15 degrees wide both ways lie between the sphere and one of cos^2(7.5 deg) = 0.983 of its
// size.
TEST(ObjectRay, HitsASphereBetweenTheSpheresThatItsTrianglesLieBetween) {
  RayDice dice;
  int hits = 0, misses = 0;
  for (int i = 0; i < 2000; ++i) {
    const double radius = 0.2 + std::abs(3.0 * dice.roll());
    Placed ball = placed(scene::ObjectKind::kSphere, glm::dvec3(2.0 * radius),
                         0.5 + 0.4 * dice.roll(), 5e3 * dice.point());
    const glm::dvec3 up = glm::normalize(glm::dvec3(0, 0, 2) + dice.point());
    const glm::dvec3 right = glm::normalize(glm::cross(dice.point(), up));
    ball.pose.world_from_object = {right, glm::cross(up, right), up};
    const glm::dvec3 centre =
        ball.pose.position_world + (1.0 - 2.0 * ball.object.draught) * radius * up;

    const glm::dvec3 origin = centre + 40.0 * radius * glm::normalize(dice.point());
    const glm::dvec3 along = glm::normalize(centre + 1.2 * radius * dice.point() - origin);
    const auto hit = ball.hit(origin, along);
    const auto outer = sphere_distance(centre, radius * (1.0 + 1e-6), origin, along);
    const auto inner = sphere_distance(centre, radius * 0.982, origin, along);
    ASSERT_TRUE(outer || !hit);
    ASSERT_TRUE(hit || !inner);
    hits += hit.has_value(), misses += !hit;
    if (!hit) continue;
    ASSERT_GE(hit->distance_m, *outer);
    ASSERT_LE(hit->distance_m, inner.value_or(1e9));
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 200);
}

TEST(ObjectRay, NoneSlipsBetweenTriangles) {
  const Placed ball = placed(scene::ObjectKind::kSphere, glm::dvec3(1.0), 0.5, glm::dvec3(0.0));
  const glm::dvec3 middle(0.0, 0.0, 0.5);
  for (std::size_t n = 0; n < ball.mesh.indices.size(); ++n) {
    const std::size_t after = n % 3 == 2 ? n - 2 : n + 1;
    const glm::dvec3 a(ball.mesh.position[ball.mesh.indices[n]]);
    const glm::dvec3 b(ball.mesh.position[ball.mesh.indices[after]]);
    for (const double share : {0.0, 0.3, 0.5}) {
      const glm::dvec3 outward = glm::mix(a, b, share) - middle;
      ASSERT_TRUE(ball.hit(9.0 * outward, -outward)) << "corner " << n << ", " << share;
    }
  }
}

TEST(ObjectRay, TellsTheTriangleThatIsHit) {
  const Placed box = placed(scene::ObjectKind::kBox, glm::dvec3(2.0), 0.0, glm::dvec3(0.0));
  for (const double x : {-0.5, 0.5}) {
    const auto hit = box.hit({x, 0.0, 9.0}, {0, 0, -1});
    ASSERT_TRUE(hit);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = box.mesh.indices[static_cast<std::size_t>(3 * hit->triangle + i)];
      EXPECT_EQ(box.mesh.position[v].z, 1.0f) << "a triangle of the top";
    }
  }
}

TEST(ObjectRay, TheTreeOfTrianglesAnswersAsAllOfThem) {
  for (const auto kind : {scene::ObjectKind::kBox, scene::ObjectKind::kBoat,
                          scene::ObjectKind::kSailboat, scene::ObjectKind::kPier}) {
    const Placed thing = placed(kind, {3.0, 6.0, 4.0}, 0.3, {10.0, 20.0, 0.7});
    const BoxTree triangles = make_triangle_tree(thing.mesh);
    RayDice dice;
    int hits = 0;
    for (int n = 0; n < 2000; ++n) {
      const glm::dvec3 origin = thing.pose.position_world + 12.0 * dice.point();
      const glm::dvec3 along =
          glm::normalize(thing.pose.position_world + 3.0 * dice.point() - origin);
      const auto expected = thing.hit(origin, along);
      const auto hit =
          intersect_ray(thing.object, thing.pose, thing.mesh, triangles, {origin, along, 1e9});
      ASSERT_EQ(hit.has_value(), expected.has_value()) << n;
      if (!hit) continue;
      ++hits;
      EXPECT_NEAR(hit->distance_m, expected->distance_m, 1e-12 * expected->distance_m) << n;
      EXPECT_EQ(hit->triangle, expected->triangle) << n;
      EXPECT_FALSE(intersect_ray(thing.object, thing.pose, thing.mesh, triangles,
                                 {origin, along, 0.999 * hit->distance_m}))
          << n;
    }
    EXPECT_GT(hits, 300) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace swell::shapes
