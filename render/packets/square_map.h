// A map of one channel over a square of the land, as shaders sample it.
#pragma once

#include <glm/glm.hpp>

#include "texture/packed_map.h"

namespace swell::render {

struct SquareMap {
  const texture::PackedMap1* map = nullptr;  // 2 x - 1; none: x is what it is outside
  float texels_fx8_per_m = 1.0f;             // 1/256 texels of level 0
  float x_eye_fx8 = 0.0f, y_eye_fx8 = 0.0f;  // under the eye
  float log2_texels_per_m = 0.0f;
};

// from_corner: the eye's place in the square [m].
SquareMap make_square_map(const texture::PackedMap1& map, double size_m, glm::dvec2 from_corner);

}  // namespace swell::render
