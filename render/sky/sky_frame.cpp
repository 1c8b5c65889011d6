#include "render/sky/sky_frame.h"

#include <algorithm>

#include "math/elementary.h"
#include "math/for_each_row.h"
#include "render/sky/sky_maps.h"
#include "render/sky/volume_clouds.h"
#include "render/world/world_state.h"
#include "sky/atmosphere.h"

namespace swell::render {
namespace {

// Roots of light, as maps hold it, that falls with the height as the density of air does lie on
// straight lines over this.
float part_between(double low_m, double high_m, double height_m) {
  constexpr double kHeight_m = 2.0 * 8000.0;
  const double low = exp(-low_m / kHeight_m), high = exp(-high_m / kHeight_m);
  return static_cast<float>((low - exp(-height_m / kHeight_m)) / (low - high));
}

// The map and the discs between the two heights that were worked out next to height_m.
void set_heights(const SkyMaps& maps, double height_m, SkyFrame& sky, Workers& workers) {
  const auto above = std::ranges::upper_bound(maps.heights, height_m, {}, &SkyAtHeight::height_m);
  const SkyAtHeight& low = *std::prev(above);
  const SkyAtHeight& high = above == maps.heights.end() ? low : *above;
  sky.map = &low.map;
  sky.disc_radiance = low.disc_radiance;
  float exposure = low.exposure;
  glm::vec3 sun_disc = low.sun_disc_radiance;
  if (height_m > low.height_m && high.height_m > low.height_m) {
    const float part = part_between(low.height_m, high.height_m, height_m);
    sky.disc_radiance = glm::mix(low.disc_radiance, high.disc_radiance, part);
    sun_disc = glm::mix(low.sun_disc_radiance, high.sun_disc_radiance, part);
    exposure = glm::mix(low.exposure, high.exposure, part);
    if (sky.between.width == 0) sky.between = low.map;
    constexpr int kRowsAtOnce = 32;
    workers.for_each((kSkyRows + kAirRows) / kRowsAtOnce, [&](std::size_t i, int) {
      const int row = static_cast<int>(i) * kRowsAtOnce;
      blend_rows(low.map, high.map, part, row, row + kRowsAtOnce, sky.between);
    });
    sky.map = &sky.between;
  }
  sky.exposure = maps.exposure * exposure;
  sky.to_disc = maps.to_light;
  if (maps.to_sun.z > sky.horizon_sine - static_cast<float>(sky::kSunRadius_rad)) {
    sky.to_disc = maps.to_sun;
    sky.disc_radiance = sun_disc;
  }
}

}  // namespace

double sky_height_m(const View& view, PartSet without) {
  return without.has(Part::kAltitude) ? 0.0 : std::max(view.eye_world.z, 0.0);
}

void advance_clouds(const WorldState& world, const Clouds& mirrored, double t_s, glm::dvec2 eye,
                    PartSet without, SkyFrame& sky, const StageRun& run) {
  constexpr float kTexel = 2.0f / CloudSky::kSide;
  VolumeClouds volume = make_volume_clouds(world, t_s, {eye, 0.0}, kTexel, without);
  // Blurred clouds take no more than long steps and large forms.
  volume.steps = {128.0f, 2048.0f};
  volume.small_forms = false;
  const scene::Sky& air = world.scene.sky;
  draw_cloud_sky(volume,
                 {world.sky->horizon, static_cast<float>(1.0 / air.haze_distance_m),
                  static_cast<float>(1.0 / air.haze_height_m)},
                 sky.clouds, run);
  advance_cloud_shadow(world, mirrored, volume, {eye, 0.0}, without, sky.shadow, run);
}

void advance_sky(const WorldState& world, const Clouds& mirrored, const Fog& fog, double height_m,
                 PartSet without, SkyFrame& sky, const StageRun& run) {
  const SkyMaps& maps = *world.sky;
  const bool is_flat = drop_per_m2(world.earth_radius_m(without)) == 0.0f;
  sky.horizon_sine = is_flat ? 0.0f : static_cast<float>(sky::horizon_sine(height_m));
  set_heights(maps, height_m, sky, run.workers);
  sky.mirrored = sky.mirrored_clear = &maps.soft;
  sky.layer = mirrored;
  if (!mirrored.any && !sky.clouds.any && !fog.on) return;
  for (texture::RgbaImage* const codes : {&sky.codes_clear, &sky.codes})
    if (codes->width != kSoftSkySize) texture::resize_image(kSoftSkySize, kSoftSkySize, *codes);
  Fog shaded = fog;
  shaded.clouds = sky.shadow.any ? &sky.shadow : nullptr;
  for_each_row(kSoftSkySize, run.workers, [&](int y) {
    write_soft_sky_row(maps, mirrored, sky.clouds, shaded, y, sky.codes_clear, sky.codes);
  });
  texture::pack_rgb(sky.codes_clear, sky.soft_clear);
  sky.mirrored = sky.mirrored_clear = &sky.soft_clear;
  if (!fog.on) return;
  texture::pack_rgb(sky.codes, sky.soft);
  sky.mirrored = &sky.soft;
}

}  // namespace swell::render
