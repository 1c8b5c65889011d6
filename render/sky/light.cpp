#include "render/sky/light.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "render/sky/sky_frame.h"
#include "render/sky/sky_maps.h"
#include "render/world/water_texture.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {

namespace {

// Below this the haze of sea level stands for all air.
constexpr double kAerialPerspective_m = 20.0;

bool shows_phase(const scene::Sky& sky, glm::vec3 to_disc) {
  return !sky::is_gradient(sky) && to_disc != sky.sun_direction && sky.moon_phase < 1.0;
}

// The moon's lit side is turned to where the sun has set, and shows as much as its phase says.
glm::vec3 moon_lit_from(const scene::Sky& sky, glm::vec3 to_disc) {
  const auto cosine = static_cast<float>(2.0 * sky.moon_phase - 1.0);  // of the phase angle
  const glm::vec3 aside = sky.sun_direction - glm::dot(sky.sun_direction, to_disc) * to_disc;
  const float length = glm::length(aside);
  const glm::vec3 any = glm::normalize(glm::vec3(to_disc.y, -to_disc.x, 1e-3f));
  return std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)) *
             (length > 1e-3f ? aside / length : any) -
         cosine * to_disc;
}

// Returns the part that `part` is of `whole`, over all channels together.
float part_of(glm::vec3 part, glm::vec3 whole) {
  return (part.x + part.y + part.z) / std::max(whole.x + whole.y + whole.z, 1e-12f);
}

}  // namespace

Light make_light(const WorldState& world, const Clouds& clouds, const SkyFrame& sky, const Fog& fog,
                 float ripple_variance) {
  const SkyMaps& maps = *world.sky;
  Light light;
  light.sun_direction = maps.to_light;
  light.sun_irradiance = maps.irradiance;
  light.ambient = maps.ambient;
  light.horizon = maps.horizon;
  light.sky_soft = sky.mirrored;
  light.haze_sky = sky.mirrored_clear;
  if (fog.on) {
    light.sun_irradiance *= fog.at_sea.sun_passes;
    light.ambient = fog.ambient;
  }
  light.sky_map = sky.map;
  light.sky_azimuth = maps.azimuth;
  light.horizon_sine = sky.horizon_sine;
  light.to_disc = sky.to_disc;
  light.disc_radiance = sky.disc_radiance;
  light.moon_has_phase = shows_phase(world.scene.sky, sky.to_disc);
  if (light.moon_has_phase) light.disc_lit_from = moon_lit_from(world.scene.sky, sky.to_disc);
  light.exposure = sky.exposure;
  light.clouds = clouds;
  if (!sky.clouds.any && !fog.on && ripple_variance < kCalmVariance)
    light.calm = {&maps.heights.front().map, maps.azimuth, sky.layer.any ? &sky.layer : nullptr};
  if (sky.shadow.any) {
    light.cloud_shadow = &sky.shadow;
    if (fog.on) light.fog_ambient = part_of(fog.ambient_sun, fog.ambient);
  }
  return light;
}

Media make_media(const WorldState& world, const Light& light, const Fog& fog, double height_m,
                 PartSet without) {
  const scene::WaterOptics& water = world.scene.water;
  Media media;
  media.fog = fog;
  media.fog.clouds = light.cloud_shadow;
  if (!without.has(Part::kHaze)) {
    media.inv_haze_m = static_cast<float>(1.0 / world.scene.sky.haze_distance_m);
    if (height_m > kAerialPerspective_m) media.molecules_per_m = world.sky->molecules_per_m;
  }
  media.cloudy = world.sky->cloud_light.overcast * part_under_clouds(height_m);
  media.inv_haze_height_m = static_cast<float>(1.0 / world.scene.sky.haze_height_m);
  media.refraction_index = static_cast<float>(water.refraction_index);
  media.paper_refraction = water.refraction == scene::RefractionModel::kPaper;
  media.absorption_per_m = water.absorption_per_m;
  // Light that enters the water: the sky's and the sun's, as radiance of a white surface.
  const glm::vec3 entering_sun =
      light.sun_irradiance * (std::max(light.sun_direction.z, 0.0f) / static_cast<float>(kPi));
  const glm::vec3 colour = mean_water_colour(world, !without.has(Part::kSequence));
  media.body = colour * (light.ambient + entering_sun);
  media.body_sun = colour * entering_sun;
  return media;
}

// What scatters to the eye on a way through water that ends nowhere is
// scattered exp(-K z) c / (c + K w), c lost a metre, K of daylight, w down a metre: from above,
// straight down, the radiance of deep water.
Media submerge(const Media& above, double eye_z, float water_level_m) {
  Media media = above;
  media.submerged = true;
  media.water_level_m = water_level_m;
  media.eye_depth_m = std::max(water_level_m - static_cast<float>(eye_z), 0.0f);
  media.daylight_lost_per_m = kDaylightSlant * media.absorption_per_m;
  media.scattered = (1.0f + kDaylightSlant) * media.body;
  for (int c = 0; c < 3; ++c) {
    const float lost = std::min(media.daylight_lost_per_m[c] * media.eye_depth_m, 80.0f);
    media.daylight_at_eye[c] = static_cast<float>(exp(-static_cast<double>(lost)));
  }
  return media;
}

}  // namespace swell::render
