// Foam, on broken waves and on the sheets of water that they send up the beach.
#pragma once

#include <glm/glm.hpp>

#include "render/materials/inputs.h"
#include "render/materials/slope_layer.h"

namespace swell::render {

struct Foam {
  SlopeLayer pattern;     // thresholds of foam in [-1, 1], not slopes
  glm::vec3 light{0.0f};  // radiance of foam
};

// Foam lies still. For worlds with a coast.
Foam make_foam(const MaterialInputs& in, glm::dvec2 eye);

}  // namespace swell::render
