// Linear pictures of one world, one after the other, for tests.
#pragma once

#include "render/shot.h"
#include "scene/scene.h"
#include "sky/sky_light.h"

namespace swell::render {

// A flat sea under the sun, with a fixed exposure.
inline scene::Scene calm_scene(double sun_deg, double cloud_cover, double azimuth_deg = 70.0) {
  scene::Scene scene;
  scene.sky.sun_elevation_rad = radians(sun_deg);
  scene.sky.sun_azimuth_rad = radians(azimuth_deg);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.sky.cloud_cover = cloud_cover;
  scene.sky.exposure = 1.0;
  scene.sea.spectrum = false;
  scene.detail.water_triangles = 3000;
  scene.picture.edge_samples = 0;
  return scene;
}

struct LinearRenderer : Shot {
  explicit LinearRenderer(const scene::Scene& scene) : world(world_of(scene)) {}

  void draw_view(const View& seen, double t_s) { draw(world, seen, t_s, options); }

  World world;
  FrameOptions options = {.keep_linear = true};
};

}  // namespace swell::render
