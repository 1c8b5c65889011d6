#include "render/world/world_view.h"

#include "render/world/sea_maps.h"
#include "scene/camera.h"

namespace swell::render {

View world_view(const World& world, double t_s, int width_px, int height_px, ocean::SeaFrame& sea,
                Workers& workers) {
  const World::State& w = world.state();
  if (!scene::camera_mount(w.scene))
    return scene::camera_view(w.scene.camera, t_s, width_px, height_px);
  advance_waves(w, t_s, {}, {}, sea, workers);
  return scene::camera_view(w.scene, water_surface(w, sea), t_s, width_px, height_px);
}

}  // namespace swell::render
