// The sun's glitter by a picture that it throws on the water, as shaders look it up
// (glitter-inl.h). The projector stands where flat water mirrors the sun.
#pragma once

#include <glm/glm.hpp>

#include "render/tile/inputs.h"

namespace swell::render {

struct Glitter {
  const texture::RgbaImage* sun_texture = nullptr;  // null: by the statistics of slopes
  // The projector's axes: unit, world. `ahead` leads from the eye to the mirrored sun.
  glm::vec3 right{1, 0, 0}, up{0, 0, 1}, ahead{0, 1, 0};
  float per_slope = 2.0f;      // Cp
  float disc_variance = 0.0f;  // of the sun's disc, along an axis
  float brightness = 1.0f;     // of the texture's middle, for a spot of radius 1
};

Glitter make_glitter(const MaterialInputs& in);

}  // namespace swell::render
