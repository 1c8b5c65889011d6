// The sea on a flat mesh, so that waves show in the shading only, for tests of what is shaded.
#pragma once

#include "render/shot.h"
#include "scene/scene.h"

namespace swell::render {

inline scene::Scene shading_scene(double eye_z_m) {
  scene::Scene scene;
  scene.camera.eye_m = {0.0, 0.0, eye_z_m};
  scene.camera.pitch_rad = radians(-40.0);
  scene.detail.triangulation = scene::Triangulation::kPlane;
  scene.sea.resolution = 16;
  return scene;
}

// A small frame, on one thread.
struct DrawnWater : Shot {
  DrawnWater() : Shot(1) {}
  DrawnWater(const World& world, double t_s) : DrawnWater() { draw_small(world, t_s); }
  void draw_small(const World& world, double t_s) { draw(world, view_of(world, t_s, 64, 48), t_s); }

  const Shading& shading() const { return state().shading; }
  const Water& water() const { return shading().material<Water>(); }
};

}  // namespace swell::render
