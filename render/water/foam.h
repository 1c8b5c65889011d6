// Foam, on broken waves and on the sheets of water that they send up the beach.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"

namespace swell::render {

struct Foam {
  SlopeLayer pattern;  // thresholds of foam in [-1, 1], not slopes
  // Radiance of foam, of the sky and of a sun that nothing hides.
  glm::vec3 sky_light{0.0f}, sun_light{0.0f};
};

inline constexpr float kFoamAlbedo = 0.8f;
inline constexpr double kFoamPeriod_m = 9.0;      // of broken waves
inline constexpr double kHullFoamPeriod_m = 2.5;  // of what splashes about hulls

// Foam lies still.
Foam make_foam(const MaterialInputs& in, glm::dvec2 eye, double period_m = kFoamPeriod_m);

}  // namespace swell::render
