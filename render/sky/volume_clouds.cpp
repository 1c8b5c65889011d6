#include "render/sky/volume_clouds.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/earth.h"
#include "math/elementary.h"
#include "ocean/open_sea/sea_state.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr float kMostDepth = 0.5f;    // of a step in the middle of a cloud
constexpr float kStepsAcross = 4.0f;  // pixels between rays
constexpr float kGroundPart = 0.3f;   // of the sky's light that reaches the middle of clouds

// x in [0, period).
double wrap(double x, double period) { return x - period * std::floor(x / period); }

float power_of_two_up_to(float x) {
  return static_cast<float>(std::bit_floor(static_cast<unsigned>(x * 256.0f))) / 256.0f;
}

}  // namespace

glm::dvec2 volume_drift_m(const scene::Scene& scene, double period_m, double t_s) {
  const ocean::SeaDescription& sea = scene.sea;
  const double travel = sea.wind_from_rad + kPi;
  const glm::dvec2 velocity =
      scene.clouds.wind_factor * sea.wind_speed_mps * glm::dvec2(sin(travel), cos(travel));
  if (sea.loop_s == 0.0) return velocity * t_s;
  if (scene.clouds.kind == scene::CloudKind::kPlaced) return glm::dvec2(0.0);
  // A sea that loops has clouds that drift by whole periods or stand still.
  const glm::dvec2 periods = velocity * (sea.loop_s / period_m);
  return glm::dvec2(std::nearbyint(periods.x), std::nearbyint(periods.y)) *
         (period_m * (ocean::wave_time_s(sea, t_s) / sea.loop_s));
}

VolumeClouds make_volume_clouds(const WorldState& world, double t_s, glm::dvec3 eye,
                                float pixel_angle, PartSet without) {
  VolumeClouds clouds;
  if (!world.cloud_volume || without.has(Part::kVolumeClouds)) return clouds;
  const CloudVolume& volume = *world.cloud_volume;
  const scene::CloudField& field = world.scene.clouds;
  clouds.volume = &volume;
  clouds.eye_z = static_cast<float>(eye.z);
  const glm::dvec2 drift_m = volume_drift_m(world.scene, volume.side_m(), t_s);
  glm::dvec2 eye_voxel = (glm::dvec2(eye) - volume.corner_m - drift_m) / volume.voxel_m;
  if (volume.repeats)
    eye_voxel = {wrap(eye_voxel.x, volume.form.side()), wrap(eye_voxel.y, volume.form.side())};
  clouds.eye_voxel = glm::vec2(eye_voxel);

  // Small forms go with the cloud and rise through it. A sea that loops has them rise by whole
  // periods.
  const double period_m = volume.detail_period_m;
  double risen_m = field.change_mps * t_s;
  const ocean::SeaDescription& sea = world.scene.sea;
  if (sea.loop_s > 0.0)
    risen_m = std::nearbyint(field.change_mps * sea.loop_s / period_m) * period_m *
              (ocean::wave_time_s(sea, t_s) / sea.loop_s);
  const glm::dvec3 place_m(glm::dvec2(eye) - drift_m, -risen_m);
  for (int c = 0; c < 3; ++c)
    clouds.detail_at_eye[c] = static_cast<float>(wrap(place_m[c] / period_m, 1.0) *
                                                 static_cast<double>(volume.detail.side()));

  clouds.drop_per_m2 = drop_per_m2(world.earth_radius_m(without));
  CloudSteps& steps = clouds.steps;
  steps.step_m = power_of_two_up_to(std::min(kMostDepth / volume.extinction_per_m, 64.0f));
  // High above a layer all of it is far, and short steps through it are few.
  const float across_m = steps.step_m / (kStepsAcross * pixel_angle);
  const float above_m = clouds.eye_z - volume.top_m;
  steps.far_m =
      power_of_two_up_to(std::clamp(std::max(across_m, 0.25f * above_m), 2048.0f, 16384.0f));
  steps.most_depth = kMostDepth * steps.far_m / steps.step_m;
  clouds.rays = field.rays == scene::CloudRays::kRays;
  clouds.powder = field.powder;
  const SkyMaps& sky = *world.sky;
  clouds.to_light = sky.to_light;
  clouds.sun = sky.cloud_light.forward;
  clouds.sky = sky.ambient;
  clouds.ground = kGroundPart * sky.ambient;
  return clouds;
}

}  // namespace swell::render
