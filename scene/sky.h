// The sky as a function of direction: what the renderer tabulates once per scene.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "texture/perlin.h"

namespace swell::scene {

// How far the gradient goes on beyond sky.horizon: at the horizon itself the sky's radiance is
// (1 + kBeyondHorizon) horizon - kBeyondHorizon zenith, which must not be negative.
inline constexpr float kBeyondHorizon = 0.15f;

// The unit vector towards azimuth_rad (clockwise from north) and elevation_rad (up positive).
glm::vec3 sun_direction(double azimuth_rad, double elevation_rad);

// Linear RGB radiance of the sky in `direction` (world, any length but 0), finite and >= 0:
// a gradient from horizon to zenith, warm and bright around the sun, with thin clouds. No sun
// disc. Below the horizon: the horizon's colour. `clouds` is the noise of sky.cloud_seed. Thread
// safe.
glm::vec3 sky_radiance(const Sky& sky, const texture::PerlinNoise& clouds, glm::vec3 direction);

// The same; builds the noise each time, so for single directions.
glm::vec3 sky_radiance(const Sky& sky, glm::vec3 direction);

}  // namespace swell::scene
