// The sea on a flat mesh, so that waves show in the shading only, for tests of what is shaded.
#pragma once

#include "render/frame.h"
#include "render/workspace.h"
#include "scene/scene.h"

namespace swell::render {

inline scene::Scene shading_scene(double eye_z_m) {
  scene::Scene scene;
  scene.camera.eye_m = {0.0, 0.0, eye_z_m};
  scene.camera.pitch_rad = scene::radians(-40.0);
  scene.detail.triangulation = scene::Triangulation::kPlane;
  scene.sea.resolution = 16;
  return scene;
}

// A small frame. The world it was drawn from has to outlive it.
struct DrawnWater {
  Workspace workspace;
  Target target;
  const Shading& shading() const { return workspace.state().shading; }
  const Water& water() const { return shading().material<Water>(); }
};

inline void draw(const World& world, double t_s, DrawnWater& drawn) {
  Workers workers(1);
  const View view = scene::camera_view(world.scene().camera, t_s, 64, 48);
  render_frame(world, view, t_s, {}, drawn.workspace, drawn.target, workers);
}

}  // namespace swell::render
