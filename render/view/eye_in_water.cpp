// Whether a frame's eye is under water.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ocean/inland/inland_water.h"
#include "ocean/water_surface.h"
#include "render/frame/options.h"
#include "render/sea/sea_maps.h"
#include "render/view/render_view.h"
#include "render/view/wave_reach.h"
#include "render/world/world_state.h"

namespace swell::render {

namespace {

// The way from the eye to the level; in a crest or a trough that is on the other side of the eye.
float way_to_surface(double to_level_m, double to_surface_m) {
  constexpr float kLeast_m = 0.05f;
  return std::max(static_cast<float>(std::max(to_level_m, 0.5 * std::abs(to_surface_m))), kLeast_m);
}

// The level of the river or lake at p, if the eye is near enough to look from within it.
std::optional<double> inland_level(const WorldState& world, glm::dvec3 eye, PartSet without) {
  constexpr double kAbove_m = 2.0;
  if (!world.inland || without.has(Part::kRivers)) return std::nullopt;
  const auto sample = world.inland->at(glm::dvec2(eye));
  // From where waves and levels are the sea's.
  if (!sample || sample->depth_m <= 0.0f || sample->sea_share >= 1.0f) return std::nullopt;
  const auto level_m = static_cast<double>(sample->level_m);
  return eye.z < level_m + kAbove_m ? std::optional(level_m) : std::nullopt;
}

}  // namespace

WaterAtEye find_water_at_eye(const WorldState& world, const SeaMaps& sea, const View& view,
                             const FrameOptions& options) {
  const double eye_z = view.eye_world.z;
  const auto level_m = inland_level(world, view.eye_world, options.without);
  const bool has_waves = world.scene.detail.triangulation != scene::Triangulation::kPlane;
  double surface_m = 0.0;
  if (level_m ||
      (has_waves &&
       std::abs(eye_z) < static_cast<double>(world.water_bounds(options.disturbances).height_m)))
    surface_m = static_cast<double>(water_surface(world, sea).height(glm::dvec2(view.eye_world)));
  WaterAtEye water;
  const bool in_air = options.without.has(Part::kUnderwater) || options.without.has(Part::kWater);
  water.submerged = !in_air && eye_z < surface_m;
  water.is_inland = level_m.has_value();
  const double level = level_m.value_or(0.0);
  const float way_m =
      way_to_surface(water.submerged ? level - eye_z : eye_z - level, eye_z - surface_m);
  // From the air over a river or a lake it is the sea that is looked at.
  water.in_air = {false, level_m ? way_to_surface(eye_z, 0.0) : way_m, 0.0f};
  water.in_water = {true, way_m, static_cast<float>(level)};
  return water;
}

}  // namespace swell::render
