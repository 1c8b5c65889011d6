// The ground's colour by its maps: what shaders of the land and of river beds read of it.
#pragma once

#include <glm/glm.hpp>

#include "texture/packed_map.h"

namespace swell::render {

struct WorldState;

// Colours over a square: texels per metre, and at the eye.
struct AlbedoLayer {
  const texture::RgbaImage* texels = nullptr;  // none: there is no land
  float texels_per_m = 0.0f, x_eye = 0.0f, y_eye = 0.0f;
};

struct GroundAlbedo {
  AlbedoLayer map, around;  // of the terrain's square; of that with its apron
  // The terrain's square, in 1/256 texels of its slopes.
  float texels_fx8_per_m = 1.0f, x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f, side_fx8 = 1.0f;
};

// Without land there are no texels.
GroundAlbedo make_ground_albedo(const WorldState& world, glm::dvec2 eye);

}  // namespace swell::render
