#include "render/water/near_shore.h"

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/coast/surf_fronts.h"
#include "render/frame/parts.h"
#include "render/world/near_shore_map.h"
#include "render/world/world_state.h"
#include "terrain/shore_map.h"

namespace swell::render {
namespace {

// Foam of waves of up to the first mean period is lace, of the second and more it is torn.
constexpr double kFoamLasts_s = 10.0, kLacePeriod_s = 5.7, kTornPeriod_s = 6.15;

SurfFronts make_fronts(const MaterialInputs& in, const NearShoreMap& shore, glm::dvec2 eye) {
  const ocean::SurfZone& zone = shore.zone;
  SurfFronts fronts;
  fronts.on = true;
  const ocean::FrontClock clock = ocean::make_front_clock(zone, in.world.scene.sea, in.t_s, eye);
  fronts.cycles = clock.cycles;
  fronts.reach_turns = clock.reach_turns;
  fronts.lag_a = clock.lag_a;
  fronts.lag_b = clock.lag_b;
  fronts.lag_c = clock.lag_c;
  // Half of the mean distance between two fronts.
  const double apart_m = zone.reach_m * zone.period_s / zone.reach_s;
  fronts.level_lost = static_cast<float>(log(0.5 * apart_m) * 1.4426950408889634);
  // Bubbles rise and burst within ten seconds: a front of long waves leaves foam for a part of the
  // time alone.
  const float per_cycle = static_cast<float>(4.0 * zone.period_s / kFoamLasts_s);
  if (per_cycle > fronts.drain) {
    fronts.mean *= fronts.drain / per_cycle;
    fronts.drain = per_cycle;
  }
  fronts.torn = static_cast<float>(smoothstep(kLacePeriod_s, kTornPeriod_s, zone.period_s));
  if (!shore.fronts) return fronts;
  const glm::dvec2 from_corner = eye - shore.min_world;
  fronts.lift = make_square_layer(shore.lift, shore.size_m, from_corner);
  fronts.seaward = make_square_layer(shore.seaward, shore.size_m, from_corner);
  fronts.lift_m = shore.lift_m;
  fronts.per_reach_m = static_cast<float>(1.0 / zone.reach_m);
  return fronts;
}

}  // namespace

NearShore make_near_shore(const MaterialInputs& in, glm::dvec2 eye) {
  NearShore near;
  const NearShoreMap* const shore = in.world.near_shore.get();
  const bool has_fronts = shore && shore->zone.reach_m > 0.0 && !in.without.has(Part::kSurfFronts);
  const bool has_shelter = shore && !in.without.has(Part::kShelter);
  if (!has_fronts && !has_shelter) return near;
  near.map = make_square_layer(shore->map, shore->size_m, eye - shore->min_world);
  near.taken_gain = has_shelter ? 1.0f : 0.0f;
  if (has_fronts) near.fronts = make_fronts(in, *shore, eye);
  return near;
}

}  // namespace swell::render
