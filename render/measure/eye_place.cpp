#include "render/measure/eye_place.h"

#include "ocean/water_surface.h"
#include "render/workspace.h"
#include "render/world/world_state.h"

namespace swell::render {

EyeReport find_eye(const World& world, const Workspace& workspace, glm::dvec3 eye_world) {
  const ScopedFloatEnvironment ieee;
  const WorldState& w = world.state();
  const glm::dvec2 p(eye_world);
  if (w.terrain) {
    float ground_m = 0.0f;
    terrain::sample_heights(*w.terrain, {&p, 1}, {&ground_m, 1});
    if (eye_world.z < static_cast<double>(ground_m))
      return {EyePlace::kGround, static_cast<double>(ground_m)};
  }
  const double surface_m =
      static_cast<double>(water_surface(w, workspace.state().sea->frame).height(p));
  if (eye_world.z < surface_m) return {EyePlace::kWater, surface_m};
  return {EyePlace::kAir, surface_m};
}

}  // namespace swell::render
