// Linear pictures of one world, one after the other, for tests.
#pragma once

#include <glm/glm.hpp>

#include "render/frame.h"
#include "scene/scene.h"
#include "scene/sky.h"

namespace swell::render {

// A flat sea under the sun, with a fixed exposure.
inline scene::Scene calm_scene(double sun_deg, double cloud_cover, double azimuth_deg = 70.0) {
  scene::Scene scene;
  scene.sky.sun_elevation_rad = scene::radians(sun_deg);
  scene.sky.sun_azimuth_rad = scene::radians(azimuth_deg);
  scene.sky.sun_direction =
      scene::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.sky.cloud_cover = cloud_cover;
  scene.sky.exposure = 1.0;
  scene.sea.spectrum = false;
  scene.detail.water_triangles = 3000;
  scene.picture.edge_samples = 0;
  return scene;
}

struct LinearRenderer {
  explicit LinearRenderer(const scene::Scene& scene) : world(scene, 2) {
    options.keep_linear = true;
  }

  void draw_view(const View& seen, double t_s) {
    view = seen;
    render_frame(world, view, t_s, options, workspace, target, workers);
  }
  glm::vec3 at(int x, int y) const {
    const float* p = target.linear.data() + 3 * (y * view.width_px + x);
    return {p[0], p[1], p[2]};
  }
  // Of the middle of a pixel's ray, of length 1.
  glm::vec3 direction(int x, int y) const {
    return glm::normalize(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  }

  World world;
  Workers workers{2};
  FrameOptions options;
  Workspace workspace;
  Target target;
  View view;
};

}  // namespace swell::render
