// Light in the air that was scattered once or more, at each place and in each direction.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "scene/air_paths.h"

namespace swell::scene {

// Directions about a place: elevations crowd about the horizon, where haze and twilight are;
// azimuths of half a circle, from the light's.
inline constexpr int kElevations = 12, kAzimuths = 8;

// Of Atmosphere::multiple and Atmosphere::haze.
void fill_scattered_light(Atmosphere& atmosphere, Workers& workers);

// Atmosphere::haze for rays of one elevation.
struct HazeRow {
  std::array<std::vector<glm::vec3>, kAzimuths> at;  // by height and sine of the light's elevation
};
HazeRow haze_row(const Atmosphere& atmosphere, double sine);

// How to blend a row's azimuths, those at its ends mirrored.
struct AzimuthBlend {
  std::array<int, 4> azimuth;
  std::array<float, 4> weight;
};
AzimuthBlend blend_azimuths(double turns);  // from the light's, [0, 0.5]

// As scatter_again() of all light, at an azimuth.
glm::vec3 scatter_light_again(const Atmosphere& atmosphere, const HazeRow& haze,
                              const AzimuthBlend& blend, const Path& path, LightAngles light);

}  // namespace swell::scene
