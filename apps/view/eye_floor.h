// How low the eye may go: nothing is drawn from under water or from inside the land.
#pragma once

#include <glm/glm.hpp>

#include "math/parallel.h"
#include "ocean/sea.h"
#include "render/frame.h"

namespace swell::view {

// Over the water and the land, so that neither comes nearer than the picture's near plane.
inline constexpr double kEyeClearance_m = 0.5;

// The z below which an eye at eye_m may not be at t_s. Looks at the waves only if the eye is so low
// that one could reach it; fills `sea` then, in as long as a frame's stage "sea" takes.
double eye_floor_m(const render::World& world, glm::dvec3 eye_m, double t_s, ocean::SeaFrame& sea,
                   Workers& workers);

}  // namespace swell::view
