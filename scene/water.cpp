#include "scene/water.h"

#include "ocean/wakes.h"
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
      coast_(build_coast(scene, terrain())),
      disturbances_(all_disturbances(scene)) {}

WaterSurface Water::at(double t_s, ocean::SeaFrame& frame, Workers& workers,
                       std::span<const ocean::Disturbance> more) const {
  const double gravity = sea_.description().gravity_mps2;
  ocean::advance(sea_, t_s, frame, workers);
  ocean::advance_wakes(disturbances_, more, gravity, t_s, frame.wakes, workers);
  ocean::WakeBounds wakes = ocean::wake_bounds(disturbances_, gravity);
  wakes.include(ocean::wake_bounds(more, gravity));
  return WaterSurface({&sea_, area_, terrain(), coast(), wakes}, frame);
}

}  // namespace swell::scene
