// What a shore does to the sea before it: what land takes away of the waves in its lee, and fronts
// of foam that run to shores where no wave trains break.
//
// There are four fronts with a phase of their own each. A front comes every fourth wave of the sea,
//   turns = t / (4 T) + tau(s) / (4 T) + n / 4 + lag_n(x, y),      n = 0, 1, 2, 3
// where tau = 2 sqrt(s / (g slope)) is the time that shallow water's waves need to the shore from
// the distance s over a beach of one slope; it is at whole turns, and leaves foam that drains until
// the next. So foam is a pure function of place and time, and its lines lie along the shore.
#pragma once

#include <glm/glm.hpp>

#include "render/materials/inputs.h"
#include "render/materials/slope_layer.h"

namespace swell::render {

inline constexpr int kSurfFronts = 4;

struct SurfFronts {
  bool on = false;
  float cycles = 0.0f;       // t / (4 T)
  float reach_turns = 0.0f;  // tau / (4 T) of the reach of NearShoreMap
  float level_lost = 0.0f;   // of footprints in which fronts are too close to be seen
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
