#include "shapes/object_ray.h"

#include "math/check.h"
#include "math/ray_triangle.h"

namespace swell::shapes {
namespace {

// In the unit box of the mesh, where the same s is at the same place.
Ray ray_in_mesh(const scene::FloatingObject& object, const scene::ObjectPose& pose,
                glm::dvec3 origin_world, glm::dvec3 along_world) {
  const glm::dmat3 object_from_world = glm::transpose(pose.world_from_object);
  const glm::dvec3 origin = object_from_world * (origin_world - pose.position_world);
  const glm::dvec3 waterline(0.0, 0.0, object.draught), middle(object.middle_m, 0.0);
  return make_ray((origin - middle) / object.size_m + waterline,
                  (object_from_world * along_world) / object.size_m);
}

// Whether the ray's line passes through the ball around the box, of radius sqrt(3) / 2.
bool passes_near(const Ray& ray) {
  constexpr double kRadius2 = 0.75 + 1e-3;
  const glm::dvec3 aside = glm::cross(ray.origin - glm::dvec3(0.0, 0.0, 0.5), ray.along);
  return glm::dot(aside, aside) <= kRadius2 * glm::dot(ray.along, ray.along);
}

std::array<glm::dvec3, 3> corners_of(const ObjectMesh& mesh, std::size_t triangle) {
  const std::uint32_t* v = &mesh.indices[3 * triangle];
  return {mesh.position[v[0]], mesh.position[v[1]], mesh.position[v[2]]};
}

}  // namespace

std::optional<ObjectHit> intersect_ray(const scene::FloatingObject& object,
                                       const scene::ObjectPose& pose, const ObjectMesh& mesh,
                                       glm::dvec3 origin_world, glm::dvec3 direction) {
  const double length = glm::length(direction);
  SWELL_CHECK(length > 0.0, "direction=({}, {}, {})", direction.x, direction.y, direction.z);
  const Ray ray = ray_in_mesh(object, pose, origin_world, direction / length);
  std::optional<ObjectHit> nearest;
  if (!passes_near(ray)) return nearest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto crossing = cross_triangle(ray, corners_of(mesh, t));
    if (!crossing || crossing->s < 0.0 || (nearest && crossing->s >= nearest->distance_m)) continue;
    nearest = {crossing->s, static_cast<int>(t)};
  }
  return nearest;
}

std::optional<ObjectHit> intersect_ray(const scene::FloatingObject& object,
                                       const scene::ObjectPose& pose, const ObjectMesh& mesh,
                                       const BoxTree& triangles, const WorldRay& ray) {
  const Ray in_mesh = ray_in_mesh(object, pose, ray.origin, ray.along);
  std::optional<ObjectHit> nearest;
  if (!passes_near(in_mesh)) return nearest;
  double farthest = ray.farthest_m;
  triangles.visit(in_mesh.origin, in_mesh.along, farthest, [&](std::uint32_t triangle) {
    const auto crossing = cross_triangle(in_mesh, corners_of(mesh, triangle));
    if (!crossing || crossing->s < 0.0 || crossing->s > farthest) return;
    const auto number = static_cast<int>(triangle);
    if (nearest && crossing->s == nearest->distance_m && number > nearest->triangle) return;
    nearest = {crossing->s, number};
    farthest = crossing->s;
  });
  return nearest;
}

BoxTree make_triangle_tree(const ObjectMesh& mesh) {
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) boxes[t].include(mesh.position[mesh.indices[3 * t + k]]);
  return BoxTree(boxes);
}

}  // namespace swell::shapes
