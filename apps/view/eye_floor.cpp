#include "apps/view/eye_floor.h"

#include <algorithm>

#include "render/world/world_state.h"

namespace swell::view {

double eye_floor_m(const render::World& world, glm::dvec3 eye_m) {
  const render::WorldState& w = world.state();
  if (!w.terrain) return -kDeepestEye_m;
  const glm::dvec2 p(eye_m);
  float ground_m = 0.0f;
  terrain::sample_heights(*w.terrain, {&p, 1}, {&ground_m, 1});
  return std::max(static_cast<double>(ground_m) + kEyeClearance_m, -kDeepestEye_m);
}

}  // namespace swell::view
