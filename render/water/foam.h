// Foam: where its lace has holes, and its light.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

struct FoamLight {
  glm::vec3 sky{0.0f}, sun{0.0f};  // radiance of snow under the sky, facing the sun
  glm::vec3 bubbles{0.0f};         // of that, what water full of bubbles sends back
};

// How much of what is behind foam it hides: so much where it is thin, so much more where it is of
// thickness 1, and what the bubbles beside it do.
struct FoamOpacity {
  float thin = 1.0f, by_thickness = 0.0f, bubbles = 0.0f;
};

inline constexpr double kFoamPeriod_m = 9.0;      // of broken waves
inline constexpr double kHullFoamPeriod_m = 2.5;  // of what splashes about hulls

FoamLight make_foam_light(const MaterialInputs& in);

// Returns thresholds of foam in [-1, 1], which are no slopes. Foam lies still.
SlopeLayer make_foam_lace(const MaterialInputs& in, glm::dvec2 eye,
                          double period_m = kFoamPeriod_m);

}  // namespace swell::render
