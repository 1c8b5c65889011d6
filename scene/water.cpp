#include "scene/water.h"

#include "ocean/coast/swash.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/wakes/wakes.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/terrain.h"

namespace swell::scene {
namespace {

// Null: there is none.
template <class Part>
std::shared_ptr<const Part> shared(std::optional<Part> part) {
  return part ? std::make_shared<const Part>(*std::move(part)) : nullptr;
}

}  // namespace

Water::Water(const Scene& scene, int threads) {
  const ScopedFloatEnvironment ieee;
  check_scene(scene);
  parts_.sea = std::make_shared<const ocean::Sea>(scene.sea);
  parts_.area = scene.area;
  parts_.disturbances = all_disturbances(scene);
  Workers workers(threads);
  if (std::optional<Ground> ground = build_ground(scene, workers)) {
    parts_.terrain = std::make_shared<const terrain::HeightGrid>(std::move(ground->terrain));
    parts_.inland = shared(build_inland_water(scene, ground->lakes, *terrain(), workers));
  }
  parts_.shore = shared(build_shore(scene, terrain()));
  parts_.coast = shared(build_coast(scene, terrain(), shore(), workers));
  parts_.shelter = shared(build_shelter(scene, shore(), workers));
  parts_.fronts = shared(build_surf_fronts(scene, sea(), terrain(), shore(), shelter(), workers));
}

WaterSurface Water::at(double t_s, ocean::SeaFrame& frame, Workers& workers,
                       std::span<const ocean::Disturbance> more,
                       ocean::MakeWakes wakes_made) const {
  const ScopedFloatEnvironment ieee;
  const double gravity = sea().description().gravity_mps2;
  ocean::advance(sea(), t_s, frame, workers);
  ocean::advance_wakes(parts_.disturbances, more, gravity, t_s, frame.wakes, workers, shore(),
                       wakes_made);
  ocean::WakeBounds wakes = ocean::wake_bounds(parts_.disturbances, gravity);
  wakes.include(ocean::wake_bounds(more, gravity));
  return WaterSurface(
      {&sea(), parts_.area, terrain(), coast(), wakes, shelter(), inland(), fronts()}, frame);
}

bool Water::wets(const WaterSurface& surface, glm::dvec2 p_world) const {
  const ScopedFloatEnvironment ieee;
  if (!terrain()) return true;
  const double ground_m = terrain::height_at(*terrain(), p_world);
  if (ground_m < static_cast<double>(surface.height(p_world))) return true;
  const ocean::Swash swash = ocean::make_swash(sea(), coast(), shelter());
  const double t_s = ocean::wave_time_s(sea().description(), surface.t_s());
  return swash.reach_m > 0.0 && ground_m < ocean::swash_edge_m(swash, t_s, p_world);
}

}  // namespace swell::scene
