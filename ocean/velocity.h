// How the water at the surface moves: linear theory of deep water, from the same waves as the
// heights. A wave of amplitude A moves it on circles of radius A, forwards on the crests. Where
// crests are sharp (ocean/open_sea/crests.h), of the water that they have brought to a place.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "ocean/open_sea/sea.h"

namespace swell::ocean {

// One component each, in m/s, in place of the frames' heights (slopes are empty): sample_heights()
// samples them.
struct VelocityFrame {
  SeaFrame x, y, z;
};

// Fills `velocity` for the time of `frame`, which advance() has filled from `sea`. A sine wave with
// a period of its own moves the water with that period. Costs what advance() does.
void advance_velocity(const Sea& sea, const SeaFrame& frame, VelocityFrame& velocity,
                      Workers& workers);

// Velocities (east, north, up) in m/s at world points; the up component is dH/dt. Spans of one
// length, otherwise as sample_heights().
void sample_velocities(const VelocityFrame& velocity, std::span<const glm::dvec2> p_world,
                       std::span<glm::vec3> velocity_mps);

}  // namespace swell::ocean
