// What a lidar's beams meet of a world at one moment, but for its water.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "math/box_tree.h"
#include "math/parallel.h"
#include "render/view/implicit_rays.h"
#include "scene/objects.h"
#include "shapes/object_ray.h"
#include "terrain/ground_rays.h"

namespace swell::render {

struct WorldState;

// The nearest thing that a beam meets.
struct LidarTarget {
  double distance_m = HUGE_VAL;
  double cos_incidence = 1.0;
  double reflectance = 0.0;
  std::uint32_t id = 0, klass = 0;
};

// What is made of a world once.
struct LidarShapes {
  std::vector<std::shared_ptr<const BoxTree>> triangles;  // by object; null: an implicit surface
  std::optional<terrain::GroundRays> ground;              // none: there is no land
};
LidarShapes make_lidar_shapes(const WorldState& world, Workers& workers);

// The objects where they are at a time.
struct ObjectTargets {
  std::vector<scene::ObjectPose> poses;
  glm::dvec3 origin_world{0.0};  // of the boxes
  BoxTree boxes;
  std::vector<PosedImplicit> implicits;  // of each shape that is one
  std::vector<std::size_t> implicit_of;  // by object; else kNoImplicit
};
inline constexpr std::size_t kNoImplicit = SIZE_MAX;

// Sets all but the poses, which are of t_s.
void place_targets(const WorldState& world, double t_s, glm::dvec3 origin_world,
                   ObjectTargets& targets);

// Each puts what it has in place of a target that is farther away. `ray` reaches as far as the
// target. Of the ground only the place is found: most of it may be under water.
void meet_objects(const WorldState& world, const LidarShapes& shapes, const ObjectTargets& objects,
                  const shapes::WorldRay& ray, LidarTarget& target);
void meet_ground(const LidarShapes& shapes, const shapes::WorldRay& ray, LidarTarget& target);

// Finds the incidence on the ground that a ray has met, and its reflectance.
void look_at_ground(const WorldState& world, const shapes::WorldRay& ray, LidarTarget& target);

}  // namespace swell::render
