#include "apps/view/eye_floor.h"

#include <algorithm>

#include "render/world/world_state.h"

namespace swell::view {

double eye_floor_m(const render::World& world, glm::dvec3 eye_m, double t_s, ocean::SeaFrame& sea,
                   Workers& workers) {
  const render::World::State& w = world.state();
  const glm::dvec2 p(eye_m);
  double top_m = static_cast<double>(w.water_bounds().height_m);
  if (eye_m.z < top_m + kEyeClearance_m) {
    ocean::advance(*w.sea, t_s, sea, workers);
    top_m = static_cast<double>(render::water_surface(w, sea).height(p));
  }
  if (w.terrain) {
    float ground_m = 0.0f;
    terrain::sample_heights(*w.terrain, {&p, 1}, {&ground_m, 1});
    top_m = std::max(top_m, static_cast<double>(ground_m));
  }
  return top_m + kEyeClearance_m;
}

}  // namespace swell::view
