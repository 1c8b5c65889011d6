// A world's water, as queries have it.
#include "ocean/water_surface.h"
#include "render/world/near_shore_map.h"
#include "render/world/world_state.h"
#include "scene/water.h"

namespace swell::render {

ocean::WaterParts WorldState::water(std::span<const ocean::Disturbance> more) const {
  ocean::WakeBounds wakes = ocean::wake_bounds(disturbances, scene.sea.gravity_mps2);
  wakes.include(ocean::wake_bounds(more, scene.sea.gravity_mps2));
  const ocean::SurfFronts* const fronts =
      near_shore && near_shore->fronts ? &*near_shore->fronts : nullptr;
  return {sea.get(), scene.area,    terrain.get(), coast.get(),
          wakes,     shelter.get(), inland.get(),  fronts};
}

ocean::WaterBounds WorldState::water_bounds(std::span<const ocean::Disturbance> more) const {
  return ocean::WaterBody(water(more)).bounds();
}

scene::Water World::water() const {
  const WorldState& s = state();
  const ocean::SurfFronts* const fronts =
      s.near_shore && s.near_shore->fronts ? &*s.near_shore->fronts : nullptr;
  return scene::Water({.sea = s.sea,
                       .area = s.scene.area,
                       .terrain = s.terrain,
                       .shore = s.shore,
                       .inland = s.inland,
                       .coast = s.coast,
                       .shelter = s.shelter,
                       .fronts = {s.near_shore, fronts},
                       .disturbances = s.disturbances});
}

ocean::WaterSurface water_surface(const WorldState& world, const ocean::SeaFrame& sea) {
  return {world.water(), sea};
}

}  // namespace swell::render
