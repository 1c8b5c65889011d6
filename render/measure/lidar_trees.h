// Trees as a lidar's beams meet them: those of a picture that is taken from where it is, as large
// as they are and with all their leaves.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "math/box_tree.h"
#include "math/parallel.h"
#include "render/measure/lidar_targets.h"
#include "render/world/forest.h"
#include "shapes/object_ray.h"

namespace swell::render {

// Boxes that hold a forest's trees however they sway and face, from Trees::origin.
BoxTree make_tree_boxes(const Forest& forest);

// The triangles of those trees that beams come near, at one time.
class TreeTargets {
 public:
  // Adds to `near` the trees whose boxes the ray touches.
  static void list_near(const Forest& forest, const BoxTree& boxes, const shapes::WorldRay& ray,
                        std::vector<std::uint32_t>& near);

  // `trees`: ascending, each once. 0.3 ms a tree.
  void place(const WorldState& world, double t_s, glm::dvec3 eye_world,
             std::span<const std::uint32_t> trees, Workers& workers);

  // Puts the nearest leaf or trunk in place of a target that is farther away.
  void meet(const WorldState& world, const BoxTree& boxes, const shapes::WorldRay& ray,
            LidarTarget& target) const;

 private:
  struct Placed {
    std::uint32_t crown = 0;   // triangles of leaves, the first ones
    std::vector<glm::vec3> p;  // three corners a triangle, from the eye
    BoxTree triangles;
  };
  void meet_tree(std::size_t placed, const shapes::WorldRay& from_eye, LidarTarget& target) const;

  glm::dvec3 eye_world_{0.0};
  std::vector<std::uint32_t> trees_;
  std::vector<Placed> placed_;  // of the same
};

}  // namespace swell::render
