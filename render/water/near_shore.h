// What a shore does to the sea before it: what land takes away of the waves in its lee, and fronts
// of foam that run to shores where no wave trains break.
//
// There are four fronts with a phase of their own each. A front comes every fourth wave of the sea,
//   turns = t / (4 T) + tau(s) / (4 T) + n / 4 + lag_n(x, y),      n = 0, 1, 2, 3
// where tau = 2 sqrt(s / (g slope)) is the time that shallow water's waves need to the shore from
// the distance s over a beach of one slope; it is at whole turns, and leaves foam that drains until
// the next, within ten seconds at most. So foam is a pure function of place and time, and its lines
// lie along the shore. That of long waves, whose fronts are far apart, lies there as whitecaps do:
// torn, with water full of bubbles between.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

inline constexpr int kSurfFronts = 4;

struct SurfFronts {
  bool on = false;
  float cycles = 0.0f;       // t / (4 T)
  float reach_turns = 0.0f;  // tau / (4 T) of the reach of NearShoreMap
  float level_lost = 0.0f;   // of footprints in which fronts are too close to be seen
  float drain = 1.6f;        // what drains of a front's foam until the next, over all of it
  float mean = 0.11f;        // of the foam of one front, over time and place
  float torn = 0.0f;         // part that is torn as whitecaps are; the rest is lace
  // Lags along the shore: cycles by x, by y, under the eye.
  glm::vec3 lag_a{0.0f}, lag_b{0.0f}, lag_c{0.0f};
};

struct NearShore {
  SlopeLayer map;           // NearShoreMap; no map: the open sea
  float taken_gain = 1.0f;  // 0: waves as if no land were there
  SurfFronts fronts;
};

NearShore make_near_shore(const MaterialInputs& in, glm::dvec2 eye);

}  // namespace swell::render
