#include "render/water/near_shore.h"

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/open_sea/sea_state.h"
#include "render/frame/parts.h"
#include "render/world/near_shore_map.h"
#include "render/world/world_state.h"
#include "terrain/shore_map.h"

namespace swell::render {
namespace {

// Foam of waves of up to the first mean period is lace, of the second and more it is torn.
constexpr double kFoamLasts_s = 10.0, kLacePeriod_s = 5.7, kTornPeriod_s = 6.15;

// Far enough along the shore for fronts to lie within 10 degrees of it.
glm::vec3 lag_along(glm::dvec2 eye, double x_m, double y_m) {
  return glm::vec3(1.0 / x_m, 1.0 / y_m, fraction(eye.x / x_m + eye.y / y_m));
}

SurfFronts make_fronts(const MaterialInputs& in, const NearShoreMap& shore, glm::dvec2 eye) {
  const ocean::SeaDescription& sea = in.world.scene.sea;
  const double turns_per_s = ocean::looping_frequency(0.25 / shore.period_s, sea.loop_s);
  SurfFronts fronts;
  fronts.on = true;
  fronts.cycles = fraction(ocean::wave_time_s(sea, in.t_s) * turns_per_s);
  fronts.reach_turns = static_cast<float>(0.25 * shore.reach_s / shore.period_s);
  // Half of the mean distance between two fronts.
  const double apart_m = shore.reach_m * shore.period_s / shore.reach_s;
  fronts.level_lost = static_cast<float>(log(0.5 * apart_m) * 1.4426950408889634);
  // Bubbles rise and burst within ten seconds: a front of long waves leaves foam for a part of the
  // time alone.
  const float per_cycle = static_cast<float>(4.0 * shore.period_s / kFoamLasts_s);
  if (per_cycle > fronts.drain) {
    fronts.mean *= fronts.drain / per_cycle;
    fronts.drain = per_cycle;
  }
  fronts.torn = static_cast<float>(smoothstep(kLacePeriod_s, kTornPeriod_s, shore.period_s));
  fronts.lag_a = lag_along(eye, 410.0, 330.0);
  fronts.lag_b = lag_along(eye, -157.0, 131.0);
  fronts.lag_c = lag_along(eye, 67.0, -53.0);
  return fronts;
}

}  // namespace

NearShore make_near_shore(const MaterialInputs& in, glm::dvec2 eye) {
  NearShore near;
  const NearShoreMap* const shore = in.world.near_shore.get();
  const bool has_fronts = shore && shore->reach_m > 0.0 && !in.without.has(Part::kSurfFronts);
  const bool has_shelter = shore && !in.without.has(Part::kShelter);
  if (!has_fronts && !has_shelter) return near;
  near.map = make_square_layer(shore->map, shore->size_m, eye - shore->min_world);
  near.taken_gain = has_shelter ? 1.0f : 0.0f;
  if (has_fronts) near.fronts = make_fronts(in, *shore, eye);
  return near;
}

}  // namespace swell::render
