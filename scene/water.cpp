#include "scene/water.h"

#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/terrain.h"

namespace swell::scene {
namespace {

const Scene& checked(const Scene& scene) {
  check_scene(scene);
  return scene;
}

}  // namespace

Water::Water(const Scene& scene)
    : sea_(checked(scene).sea),
      area_(scene.area),
      terrain_(build_terrain(scene)),
      coast_(build_coast(scene, terrain())) {}

WaterSurface Water::at(double t_s, ocean::SeaFrame& frame, Workers& workers) const {
  ocean::advance(sea_, t_s, frame, workers);
  return WaterSurface({&sea_, area_, terrain(), coast()}, frame);
}

}  // namespace swell::scene
