// Whether a frame's eye is where it can see something.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render/frame.h"

namespace swell::render {

enum class EyePlace : std::uint8_t { kAir, kWater, kGround };

// Where the eye is; kGround below the land or the sea floor of a terrain's square.
struct EyeReport {
  EyePlace place = EyePlace::kAir;
  double surface_m = 0.0;  // z of the water or the ground that the eye is below, above it
};

// Looks at the water and the ground of the last frame that was drawn in `workspace`, of `world`.
// What lies below the ground is not drawn: a picture from there shows it from behind. 1 us.
EyeReport find_eye(const World& world, const Workspace& workspace, glm::dvec3 eye_world);

}  // namespace swell::render
