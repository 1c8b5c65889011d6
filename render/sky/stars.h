// Stars of the night sky: as many as an eye sees, where a hash has them.
#pragma once

#include <glm/glm.hpp>

#include "render/frame/parts.h"

namespace swell::render {

struct WorldState;

struct Stars {
  bool on = false;
  glm::mat3 from_world{1.0f};  // to the axes of the sky of stars
  float brightness = 0.0f;     // of a star of magnitude 6 [radiance of 1 sr, exposed]
  float pixel_angle = 1e-3f;
};

// By day there are none. They turn with the earth, a function of t_s.
Stars make_stars(const WorldState& world, double t_s, PartSet without);

}  // namespace swell::render
