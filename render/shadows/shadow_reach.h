// Stage 3: what an object before the sun may tell on.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>

#include "render/view/shadow_casters.h"

namespace swell::render {

// Places relative to the eye between which lies all that a caster may tell on: its hull's
// surroundings, and its outline's way down the sun's direction.
struct Corners {
  std::array<glm::vec3, 24> p;
  int count = 0;

  void add(glm::vec3 corner) { p[count++] = corner; }
};

// Returns the corners of all that the caster may tell on and that lies no higher than highest_rel_m
// over the eye.
Corners corners_of(const ShadowCaster& caster, const ObjectShadows& shadows,
                   float highest_rel_m = std::numeric_limits<float>::infinity());

// How far a round earth sinks what lies between the corners at most, and what light reaches from
// there under water.
float most_drop_m(const Corners& corners, float drop_per_m2);

}  // namespace swell::render
