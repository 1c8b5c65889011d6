#include "render/measure/lidar_targets.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "render/labels/label_channels.h"
#include "render/measure/lidar_ground.h"
#include "render/world/world_state.h"
#include "shapes/implicit_mesh.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

// p_world = bottom + world_from_unit p of a mesh, whose box is [-1/2, 1/2]^2 x [0, 1].
struct Placed {
  glm::dmat3 world_from_unit;
  glm::dvec3 bottom_world;
};

Placed placed(const scene::FloatingObject& object, const scene::ObjectPose& pose) {
  const glm::dmat3& axes = pose.world_from_object;
  const glm::dmat3 scaled(axes[0] * object.size_m.x, axes[1] * object.size_m.y,
                          axes[2] * object.size_m.z);
  return {scaled, pose.position_world + axes * glm::dvec3(object.middle_m, 0.0) -
                      object.draught * scaled[2]};
}

Box box_of(const Placed& object, glm::dvec3 origin_world) {
  Box box;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, i >> 2);
    box.include(glm::vec3(object.bottom_world - origin_world + object.world_from_unit * corner));
  }
  // What rounding to floats may take away.
  const glm::vec3 margin = 1e-6f * (1.0f + glm::max(glm::abs(box.low), glm::abs(box.high)));
  return {box.low - margin, box.high + margin};
}

double grey_of(glm::vec3 colour) {
  return static_cast<double>(colour.r + colour.g + colour.b) / 3.0;
}

double paint(const scene::FloatingObject& object, glm::vec3 tint, bool is_painted) {
  return std::clamp(grey_of(is_painted ? tint * object.colour : tint), 0.0, 1.0);
}

double cos_incidence(glm::dvec3 normal, glm::dvec3 along) {
  const double length = glm::length(normal);
  return length > 0.0 ? std::min(std::abs(glm::dot(normal, along)) / length, 1.0) : 1.0;
}

void meet_mesh(const scene::FloatingObject& object, const scene::ObjectPose& pose,
               const shapes::ObjectMesh& mesh, const BoxTree& triangles,
               const shapes::WorldRay& ray, LidarTarget& target) {
  const auto hit = shapes::intersect_ray(object, pose, mesh, triangles, ray);
  if (!hit) return;
  const shapes::ObjectTriangle& triangle = mesh.triangles[static_cast<std::size_t>(hit->triangle)];
  const glm::dvec3 normal =
      pose.world_from_object * (glm::dvec3(triangle.flat_normal) / object.size_m);
  target.distance_m = hit->distance_m;
  target.cos_incidence = cos_incidence(normal, ray.along);
  target.reflectance = paint(object, triangle.tint, triangle.painted);
}

// Distances along a ray to an implicit surface, and along four beside it, which go aside by
// `aside_m` where they pass its middle.
struct Fan {
  static constexpr std::size_t kRays = 16;  // of a packet; the first five count
  std::array<float, kRays> x{}, y{}, z{};
  std::array<std::uint32_t, kRays> part{};
};

std::array<glm::dvec3, 2> across(glm::dvec3 along) {
  const glm::dvec3 size = glm::abs(along);
  const glm::dvec3 axis = size.x < size.y
                              ? (size.x < size.z ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1))
                              : (size.y < size.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
  const glm::dvec3 right = glm::normalize(glm::cross(along, axis));
  return {right, glm::cross(right, along)};
}

// The slope of the distance for an angle, from the rays on both sides as far as they meet the part.
double slope_between(const Fan& fan, std::size_t less, std::size_t more, double angle,
                     const std::array<double, 5>& distance_m) {
  const auto is_there = [&](std::size_t i) {
    return fan.part[i] == fan.part[0] &&
           std::abs(distance_m[i] - distance_m[0]) < 30.0 * angle * distance_m[0];
  };
  if (is_there(less) && is_there(more))
    return (distance_m[more] - distance_m[less]) / (2.0 * angle);
  if (is_there(more)) return (distance_m[more] - distance_m[0]) / angle;
  if (is_there(less)) return (distance_m[0] - distance_m[less]) / angle;
  return 0.0;
}

void meet_implicit(const scene::FloatingObject& object, const Placed& at,
                   const scene::ImplicitSurface& implicit, const PosedImplicit& posed,
                   const shapes::WorldRay& ray, LidarTarget& target) {
  constexpr float kNear_m = 1e-3f;
  constexpr double kAside = 1e-3;  // of the object's size
  const glm::dvec3 size = implicit.high - implicit.low;
  const glm::dvec3 base(0.5 * (implicit.low.x + implicit.high.x),
                        0.5 * (implicit.low.y + implicit.high.y), implicit.low.z);
  glm::dmat3 from_world = glm::inverse(at.world_from_unit);
  for (int k = 0; k < 3; ++k) from_world[k] *= size;
  const glm::dvec3 to_middle = at.bottom_world + 0.5 * at.world_from_unit[2] - ray.origin;
  const double middle_m = std::max(glm::dot(to_middle, ray.along), static_cast<double>(kNear_m));
  const double angle = kAside * glm::length(object.size_m) / middle_m;
  const auto [right, up] = across(ray.along);
  RayBlock block{};
  block.middle =
      glm::vec3(base + from_world * (ray.origin + middle_m * ray.along - at.bottom_world));
  block.ray = glm::vec3(from_world * ray.along);
  block.ray_dx = glm::vec3(from_world * right);
  block.ray_dy = glm::vec3(from_world * up);
  block.middle_depth_m = static_cast<float>(middle_m);
  block.near_m = kNear_m;
  std::array<std::uint16_t, scene::kMostImplicitParts> parts;
  std::iota(parts.begin(), parts.end(), std::uint16_t{0});
  Fan fan;
  fan.x[1] = fan.y[3] = static_cast<float>(-angle);
  fan.x[2] = fan.y[4] = static_cast<float>(angle);
  const double farthest_m = std::min(ray.farthest_m, 1e6);
  fan.z.fill(static_cast<float>(static_cast<double>(kNear_m) / farthest_m));
  fan.part.fill(~0u);
  cast_rays({posed, std::span(parts).first(posed.parts.size()), 0}, block, fan.x, fan.y, fan.z,
            fan.part);
  if (fan.part[0] == ~0u) return;
  std::array<double, 5> distance_m;
  for (std::size_t i = 0; i < distance_m.size(); ++i)
    distance_m[i] = static_cast<double>(kNear_m / fan.z[i]);
  // Points are depth (along + x right + y up): the normal is across both derivatives.
  const double s = distance_m[0];
  const glm::dvec3 by_x = slope_between(fan, 1, 2, angle, distance_m) * ray.along + s * right;
  const glm::dvec3 by_y = slope_between(fan, 3, 4, angle, distance_m) * ray.along + s * up;
  const scene::ImplicitPart& part = implicit.parts[fan.part[0]];
  target.distance_m = s;
  target.cos_incidence = cos_incidence(glm::cross(by_x, by_y), ray.along);
  target.reflectance = paint(object, part.colour, part.painted);
}

}  // namespace

LidarShapes make_lidar_shapes(const WorldState& world, Workers& workers) {
  LidarShapes result;
  if (world.terrain) result.ground.emplace(*world.terrain);
  const std::vector<ObjectShape>& shapes = world.objects.of_object;
  std::vector<const shapes::MeshOfFile*> meshes;  // each once
  for (const ObjectShape& shape : shapes)
    if (!shape->implicit && std::ranges::find(meshes, shape.get()) == meshes.end())
      meshes.push_back(shape.get());
  std::vector<std::shared_ptr<const BoxTree>> trees(meshes.size());
  workers.for_each(meshes.size(), [&](std::size_t i, int) {
    trees[i] =
        std::make_shared<const BoxTree>(shapes::make_triangle_tree(meshes[i]->levels.front()));
  });
  for (const ObjectShape& shape : shapes) {
    const auto at = std::ranges::find(meshes, shape.get());
    result.triangles.push_back(
        at == meshes.end() ? nullptr : trees[static_cast<std::size_t>(at - meshes.begin())]);
  }
  return result;
}

void place_targets(const WorldState& world, double t_s, glm::dvec3 origin_world,
                   ObjectTargets& targets) {
  const std::vector<scene::FloatingObject>& objects = world.scene.objects;
  targets.origin_world = origin_world;
  targets.implicit_of.assign(objects.size(), kNoImplicit);
  std::map<const shapes::DrawnImplicit*, std::size_t> number_of;
  std::vector<Box> boxes;
  for (std::size_t n = 0; n < objects.size(); ++n) {
    boxes.push_back(box_of(placed(objects[n], targets.poses[n]), origin_world));
    const shapes::DrawnImplicit* const implicit = world.objects.of_object[n]->implicit.get();
    if (!implicit) continue;
    const auto [at, is_new] = number_of.emplace(implicit, number_of.size());
    targets.implicit_of[n] = at->second;
    if (!is_new) continue;
    targets.implicits.resize(std::max(targets.implicits.size(), at->second + 1));
    pose_implicit(implicit->implicit, t_s, targets.implicits[at->second]);
  }
  targets.boxes = BoxTree(boxes);
}

void meet_objects(const WorldState& world, const LidarShapes& shapes, const ObjectTargets& objects,
                  const shapes::WorldRay& ray, LidarTarget& target) {
  shapes::WorldRay reaching = ray;
  objects.boxes.visit(
      ray.origin - objects.origin_world, ray.along, reaching.farthest_m, [&](std::uint32_t n) {
        const scene::FloatingObject& object = world.scene.objects[n];
        const shapes::MeshOfFile& shape = *world.objects.of_object[n];
        LidarTarget found;
        if (shape.implicit)
          meet_implicit(object, placed(object, objects.poses[n]), shape.implicit->implicit,
                        objects.implicits[objects.implicit_of[n]], reaching, found);
        else
          meet_mesh(object, objects.poses[n], shape.levels.front(), *shapes.triangles[n], reaching,
                    found);
        found.id = kFirstObjectId + n;
        found.klass = world.object_classes[n];
        // Of two at one distance the first of the scene.
        if (found.distance_m < target.distance_m ||
            (found.distance_m == target.distance_m && found.id < target.id))
          target = found;
        reaching.farthest_m = std::min(reaching.farthest_m, target.distance_m);
      });
}

void meet_ground(const LidarShapes& shapes, const shapes::WorldRay& ray, LidarTarget& target) {
  if (!shapes.ground) return;
  const auto met = shapes.ground->meet(ray.origin, ray.along, ray.farthest_m);
  if (!met || *met >= target.distance_m) return;
  target = {.distance_m = *met, .id = kLandId, .klass = kTerrainClass};
}

void look_at_ground(const WorldState& world, const shapes::WorldRay& ray, LidarTarget& target) {
  const glm::dvec3 p = ray.origin + target.distance_m * ray.along;
  const glm::dvec2 slope = terrain::slope_at(*world.terrain, glm::dvec2(p));
  target.cos_incidence = cos_incidence(glm::dvec3(-slope, 1.0), ray.along);
  target.reflectance = ground_reflectance(world, p);
}

}  // namespace swell::render
