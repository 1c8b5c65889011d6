// How low the eye may go: the ground is drawn from above alone.
#pragma once

#include <glm/glm.hpp>

#include "render/frame.h"

namespace swell::view {

// Over the ground, so that it does not come nearer than the picture's near plane.
inline constexpr double kEyeClearance_m = 0.5;
// Where there is no ground; daylight does not reach so far down.
inline constexpr double kDeepestEye_m = 300.0;

// The z below which an eye at eye_m may not be.
double eye_floor_m(const render::World& world, glm::dvec3 eye_m);

}  // namespace swell::view
