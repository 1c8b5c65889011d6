#include "scene/water.h"

#include "ocean/coast/swash.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/wakes/wakes.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/terrain.h"

namespace swell::scene {
namespace {

ocean::Sea sea_of(const Scene& scene) {
  const ScopedFloatEnvironment ieee;
  check_scene(scene);
  return ocean::Sea(scene.sea);
}

}  // namespace

Water::Water(const Scene& scene, int threads) : sea_(sea_of(scene)), area_(scene.area) {
  const ScopedFloatEnvironment ieee;
  disturbances_ = all_disturbances(scene);
  Workers workers(threads);
  if (std::optional<Ground> ground = build_ground(scene)) {
    terrain_ = std::move(ground->terrain);
    inland_ = build_inland_water(scene, ground->lakes, *terrain_, workers);
  }
  shore_ = build_shore(scene, terrain());
  coast_ = build_coast(scene, terrain(), shore(), workers);
  shelter_ = build_shelter(scene, shore(), workers);
  fronts_ = build_surf_fronts(scene, sea_, terrain(), shore(), shelter(), workers);
}

WaterSurface Water::at(double t_s, ocean::SeaFrame& frame, Workers& workers,
                       std::span<const ocean::Disturbance> more) const {
  const ScopedFloatEnvironment ieee;
  const double gravity = sea_.description().gravity_mps2;
  ocean::advance(sea_, t_s, frame, workers);
  ocean::advance_wakes(disturbances_, more, gravity, t_s, frame.wakes, workers, shore());
  ocean::WakeBounds wakes = ocean::wake_bounds(disturbances_, gravity);
  wakes.include(ocean::wake_bounds(more, gravity));
  return WaterSurface({&sea_, area_, terrain(), coast(), wakes, shelter(), inland(), fronts()},
                      frame);
}

bool Water::wets(const WaterSurface& surface, glm::dvec2 p_world) const {
  const ScopedFloatEnvironment ieee;
  if (!terrain()) return true;
  const double ground_m = terrain::height_at(*terrain(), p_world);
  if (ground_m < static_cast<double>(surface.height(p_world))) return true;
  const ocean::Swash swash = ocean::make_swash(sea_, coast(), shelter());
  const double t_s = ocean::wave_time_s(sea_.description(), surface.t_s());
  return swash.reach_m > 0.0 && ground_m < ocean::swash_edge_m(swash, t_s, p_world);
}

}  // namespace swell::scene
