#include "render/measure/lidar_trees.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/ray_triangle.h"
#include "render/labels/label_channels.h"
#include "render/measure/lidar_echo.h"
#include "render/view/tree_corners.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// The mean cosine for leaves in all directions: the triangles that stand for them face the beams.
constexpr double kLeafCosine = 0.5;

// How far a crown's triangles reach: from the trunk and up in its box's units, and from their
// middles, in radii and in heights of a crown.
struct CrownReach {
  float aside = 0.0f, up = 0.0f, right = 0.0f, high = 0.0f;
};

CrownReach reach_of(const shapes::TreeShape& shape) {
  const float size = shapes::leaf_size(shape, static_cast<float>(shape.leaves.size()));
  CrownReach reach;
  for (const shapes::TreeLeaf& leaf : shape.leaves) {
    const glm::vec3 middle = shapes::leaf_middle(shape, leaf, size);
    reach.aside = std::max(reach.aside, std::sqrt(middle.x * middle.x + middle.y * middle.y));
    reach.up = std::max(reach.up, middle.z);
    for (const glm::vec2& corner : leaf.corner) {
      const glm::vec2 c = glm::abs(shapes::leaf_corner(shape, corner, size, 1.0f));
      reach.right = std::max(reach.right, c.x);
      reach.high = std::max(reach.high, c.y);
    }
  }
  return reach;
}

Box box_of(const terrain::Tree& tree, const shapes::TreeShape& shape, const CrownReach& reach) {
  const float crown_m = tree.height_m * (1.0f - shape.crown_begin);
  const float leaf_m = reach.high * (crown_m + 2.0f * tree.radius_m);
  const float sway_m = 0.1f * tree.height_m * (1.0f + reach.high * reach.high);
  const float aside_m = tree.radius_m * (reach.aside + reach.right) + leaf_m + sway_m;
  const float up_m = tree.height_m - crown_m + reach.up * crown_m + leaf_m;
  return {tree.foot - glm::vec3(aside_m, aside_m, 0.1f * tree.height_m + leaf_m),
          tree.foot + glm::vec3(aside_m, aside_m, std::max(up_m, tree.height_m))};
}

// As drawn_tree() has a tree that is large in the picture.
DrawnTree whole_tree(const Forest& forest, std::uint32_t number, glm::dvec3 eye_world) {
  const TreeColumns& trees = forest.columns;
  DrawnTree drawn{.foot_rel = glm::vec3(forest.trees.origin - eye_world) +
                              glm::vec3(trees.x_m[number], trees.y_m[number], trees.z_m[number]),
                  .height_m = trees.height_m[number],
                  .radius_m = trees.radius_m[number],
                  .sways = 1.0f,
                  .tree = number,
                  .looks = trees.looks[number],
                  .species = trees.looks[number] >> 24};
  const shapes::TreeShape& shape = forest.shapes[drawn.species];
  drawn.leaves = static_cast<float>(shape.leaves.size());
  drawn.leaf_size = shapes::leaf_size(shape, drawn.leaves);
  drawn.trunk_m = shape.trunk * drawn.height_m;
  drawn.triangles = crown_triangles(drawn) + (shape.trunk > 0.0f ? 2 : 0);
  drawn.crown_begin_m = shape.crown_begin * drawn.height_m;
  return drawn;
}

}  // namespace

BoxTree make_tree_boxes(const Forest& forest) {
  std::array<CrownReach, terrain::kTreeSpecies> reach;
  for (std::size_t i = 0; i < reach.size(); ++i) reach[i] = reach_of(forest.shapes[i]);
  std::vector<Box> boxes;
  boxes.reserve(forest.trees.trees.size());
  for (const terrain::Tree& tree : forest.trees.trees) {
    const auto species = static_cast<std::size_t>(tree.species);
    boxes.push_back(box_of(tree, forest.shapes[species], reach[species]));
  }
  return BoxTree(boxes);
}

void TreeTargets::list_near(const Forest& forest, const BoxTree& boxes, const shapes::WorldRay& ray,
                            std::vector<std::uint32_t>& near) {
  double farthest_m = ray.farthest_m;
  boxes.visit(ray.origin - forest.trees.origin, ray.along, farthest_m,
              [&](std::uint32_t tree) { near.push_back(tree); });
}

void TreeTargets::place(const WorldState& world, double t_s, glm::dvec3 eye_world,
                        std::span<const std::uint32_t> trees, Workers& workers) {
  const Forest& forest = *world.forest;
  const Sway sway = sway_at(world.scene.sea, t_s);
  eye_world_ = eye_world;
  trees_.assign(trees.begin(), trees.end());
  placed_.resize(std::max(placed_.size(), trees.size()));
  workers.for_each(trees.size(), [&](std::size_t i, int) {
    const DrawnTree drawn = whole_tree(forest, trees[i], eye_world);
    Placed& placed = placed_[i];
    placed.crown = crown_triangles(drawn);
    placed.p.resize(std::size_t{3} * drawn.triangles);
    write_corners(forest, sway, drawn, placed.p.data());
    std::vector<Box> boxes(drawn.triangles);
    for (std::size_t k = 0; k < placed.p.size(); ++k) boxes[k / 3].include(placed.p[k]);
    placed.triangles = BoxTree(boxes);
  });
}

void TreeTargets::meet_tree(std::size_t number, const shapes::WorldRay& from_eye,
                            LidarTarget& target) const {
  const Placed& placed = placed_[number];
  const Ray ray = make_ray(from_eye.origin, from_eye.along);
  double farthest_m = from_eye.farthest_m;
  placed.triangles.visit(ray.origin, ray.along, farthest_m, [&](std::uint32_t triangle) {
    const glm::vec3* const p = &placed.p[std::size_t{3} * triangle];
    const auto crossing = cross_triangle(ray, {p[0], p[1], p[2]});
    if (!crossing || crossing->s < 0.0 || crossing->s >= farthest_m) return;
    farthest_m = crossing->s;
    const bool is_leaf = triangle < placed.crown;
    target.distance_m = crossing->s;
    target.cos_incidence = is_leaf ? kLeafCosine : 1.0;
    target.reflectance = is_leaf ? kLeafReflectance : kBarkReflectance;
  });
}

void TreeTargets::meet(const WorldState& world, const BoxTree& boxes, const shapes::WorldRay& ray,
                       LidarTarget& target) const {
  shapes::WorldRay reaching = ray;
  boxes.visit(ray.origin - world.forest->trees.origin, ray.along, reaching.farthest_m,
              [&](std::uint32_t tree) {
                const auto at = std::ranges::lower_bound(trees_, tree);
                LidarTarget found;
                meet_tree(static_cast<std::size_t>(at - trees_.begin()),
                          {ray.origin - eye_world_, ray.along, reaching.farthest_m}, found);
                if (!(found.distance_m < target.distance_m)) return;
                target = found;
                target.id = kFirstTreeId + tree;
                target.klass = world.tree_class;
                reaching.farthest_m = found.distance_m;
              });
}

}  // namespace swell::render
