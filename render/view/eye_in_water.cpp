// Whether a frame's eye is under water.
#include <algorithm>
#include <cmath>

#include "ocean/water_surface.h"
#include "render/frame/options.h"
#include "render/sea/sea_maps.h"
#include "render/view/render_view.h"
#include "render/view/wave_reach.h"
#include "render/world/world_state.h"

namespace swell::render {

EyeInWater find_eye_in_water(const WorldState& world, const SeaMaps& sea, const View& view,
                             const FrameOptions& options) {
  constexpr float kLeastToSurface_m = 0.05f;
  const double eye_z = view.eye_world.z;
  double surface_m = 0.0;
  if (world.scene.detail.triangulation != scene::Triangulation::kPlane &&
      std::abs(eye_z) < static_cast<double>(world.water_bounds(options.disturbances).height_m))
    surface_m = static_cast<double>(water_surface(world, sea).height(glm::dvec2(view.eye_world)));
  EyeInWater eye;
  const bool in_air = options.without.has(Part::kUnderwater) || options.without.has(Part::kWater);
  eye.submerged = !in_air && eye_z < surface_m;
  const double to_level_m = eye.submerged ? -eye_z : eye_z;
  // In a crest or a trough the level is on the other side of the eye.
  const double away_m = std::max(to_level_m, 0.5 * std::abs(eye_z - surface_m));
  eye.to_surface_m = std::max(static_cast<float>(away_m), kLeastToSurface_m);
  return eye;
}

}  // namespace swell::render
