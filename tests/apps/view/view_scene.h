// The scene of the viewer's tests: small enough to draw hundreds of frames.
#pragma once

#include "scene/scene.h"

namespace swell::view {

inline scene::Scene small_scene() {
  scene::Scene scene;
  scene.name = "small";
  scene.camera.eye_m = {0.0, 0.0, 6.0};
  scene.camera.velocity_mps = {3.0, 1.0, 0.0};
  scene.sea.resolution = 32;
  scene.sea.patch_lengths_m = {120.0};
  scene.sea.wind_speed_mps = 8.0;
  scene.sky.model = scene::SkyModel::kGradient;  // made in a third of the time
  scene.area.size_m = {400.0, 400.0};
  scene.detail.water_triangles = 1500;
  return scene;
}

}  // namespace swell::view
