#include "scene/obstacles.h"

#include <optional>

#include "math/elementary.h"

namespace swell::scene {
namespace {

// A part of an object's plan, right and ahead of its place.
struct Plan {
  glm::dvec2 middle_m{0.0}, half_m{1.0};
  bool is_round = true;
};

std::vector<Plan> plans_of(const FloatingObject& object) {
  const glm::dvec2 size = object.size_m;
  const ObjectKindFacts& facts = kObjectKinds[object.kind];
  if (facts.plan != PlanShape::kPosts)
    return {{object.middle_m, 0.5 * size, facts.plan == PlanShape::kRound}};
  std::vector<Plan> posts;
  for (int pair = 0; pair < kPierPosts.pairs; ++pair)
    for (const double side : {-1.0, 1.0}) {
      const double along = static_cast<double>(pair) / (kPierPosts.pairs - 1);
      posts.push_back(
          {size * glm::dvec2(side * kPierPosts.aside, (2.0 * along - 1.0) * kPierPosts.ahead),
           size * kPierPosts.half});
    }
  return posts;
}

// Whether it passes the surface of the water there.
bool passes(const FloatingObject& object, double level_m) {
  if (object.motion == Motion::kFloat) return true;
  const double low_m = object.height_m - object.draught * object.size_m.z;
  return low_m < level_m && level_m < low_m + object.size_m.z;
}

}  // namespace

std::vector<ocean::Obstacle> river_obstacles(const Scene& scene,
                                             const ocean::RiverNetwork& network) {
  std::vector<ocean::Obstacle> obstacles;
  if (scene.rivers.empty()) return obstacles;
  for (const FloatingObject& object : scene.objects) {
    if (object.drift || !object.path_m.empty()) continue;
    const glm::dvec2 ahead(sin(object.heading_rad), cos(object.heading_rad));
    const glm::dvec2 right(ahead.y, -ahead.x);
    for (const Plan& plan : plans_of(object)) {
      const glm::dvec2 middle =
          object.position_m + plan.middle_m.x * right + plan.middle_m.y * ahead;
      const std::optional<ocean::WaterPlace> water = network.water_near(middle);
      const bool is_in = water && water->width_m > 0.0 && water->sea_share < 1.0 &&
                         water->outside_m < glm::length(plan.half_m);
      if (is_in && passes(object, water->level_m) && plan.half_m.x > 0.0 && plan.half_m.y > 0.0)
        obstacles.push_back({middle, ahead, plan.half_m, plan.is_round});
    }
  }
  return obstacles;
}

}  // namespace swell::scene
