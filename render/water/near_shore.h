// What a shore does to the sea before it: what land takes away of the waves in its lee, and fronts
// of surf that run to shores where no wave trains break (ocean/coast/surf_fronts.h). All fronts
// leave foam, which drains until the next, within ten seconds at most; where they lift the water
// (coast.model = "fronts") they have slopes, too, and take the place of the sea's waves. Foam of
// long waves, whose fronts are far apart, lies there as whitecaps do: torn, with water full of
// bubbles between.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

struct SurfFronts {
  bool on = false;
  // As ocean::FrontClock has them, of places relative to the eye.
  float cycles = 0.0f, reach_turns = 0.0f;
  glm::vec3 lag_a{0.0f}, lag_b{0.0f}, lag_c{0.0f};
  float level_lost = 0.0f;  // of footprints in which fronts are too close to be seen
  float drain = 1.6f;       // what drains of a front's foam until the next, over all of it
  float mean = 0.11f;       // of the foam of one front, over time and place
  float torn = 0.0f;        // part that is torn as whitecaps are; the rest is lace
  // The maps of NearShoreMap where fronts lift the water; no map: they do not.
  SlopeLayer lift, seaward;
  float lift_m = 0.0f, per_reach_m = 0.0f;
  bool lifts() const { return lift.map != nullptr; }
};

struct NearShore {
  SlopeLayer map;           // NearShoreMap; no map: the open sea
  float taken_gain = 1.0f;  // 0: waves as if no land were there
  SurfFronts fronts;
};

NearShore make_near_shore(const MaterialInputs& in, glm::dvec2 eye);

}  // namespace swell::render
