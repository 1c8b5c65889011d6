#include "render/materials/light.h"

#include <algorithm>

#include "math/elementary.h"

namespace swell::render {

Light make_light(const World::State& world, const Clouds& clouds, const texture::RgbMap& soft) {
  const SkyMaps& sky = *world.sky;
  Light light;
  light.sun_direction = sky.to_light;
  light.sun_irradiance = sky.irradiance;
  light.disc_radiance = sky.disc_radiance;
  light.ambient = sky.ambient;
  light.horizon = sky.horizon;
  light.sky_clear = &sky.clear;
  light.sky_soft = clouds.any ? &soft : &sky.soft;
  light.clouds = clouds;
  return light;
}

Media make_media(const World::State& world, const Light& light, PartSet without) {
  const scene::WaterOptics& water = world.scene.water;
  Media media;
  if (!without.has(Part::kHaze))
    media.inv_haze_m = static_cast<float>(1.0 / world.scene.sky.haze_distance_m);
  media.inv_haze_height_m = static_cast<float>(1.0 / world.scene.sky.haze_height_m);
  media.refraction_index = static_cast<float>(water.refraction_index);
  media.absorption_per_m = water.absorption_per_m;
  // Light that enters the water: the sky's and the sun's, as radiance of a white surface.
  const glm::vec3 entering_sun =
      light.sun_irradiance * (std::max(light.sun_direction.z, 0.0f) / static_cast<float>(kPi));
  media.body = water.body_colour * (light.ambient + entering_sun);
  media.body_sun = water.body_colour * entering_sun;
  return media;
}

}  // namespace swell::render
