// Light in the air that was scattered once or more, at each place and in each direction.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "sky/air_paths.h"
#include "sky/light_moments.h"

namespace swell::sky {

// Fills Atmosphere::multiple, uneven and haze: by a round earth while the light is down, by level
// layers from 1.9 degrees up, and by a blend between.
void fill_scattered_light(Atmosphere& atmosphere, Workers& workers);

// What air makes, in a path's direction, of the light at its steps; for light of the elevations
// that the path meets.
struct PathSources {
  // By sine of the light's elevation, of which there are so many.
  struct Columns {
    int first = 0, count = 0;
  };
  // Molecules and haze, by mode of the azimuth: by step of the path, and by height.
  Columns air_columns, haze_columns;
  std::array<std::vector<glm::vec3>, kRayleighModes> air;
  std::vector<glm::vec3> haze;  // all modes in a row
};
PathSources sources_along(const Atmosphere& atmosphere, const Path& path, double light_sine);

using ModeCosines = std::array<float, kModes>;  // cos(m phi)

// Returns what a path sends on of `sources`, with their haze of all modes by height and column.
glm::vec3 scatter_sources(const PathSources& sources, const ModeCosines& modes,
                          const glm::vec3* haze, const Path& path, LightAngles light);

// As scatter_again() of all light, at the azimuth of `light`, whose cosine is given.
glm::vec3 scatter_light_again(const PathSources& sources, double cos_azimuth, const Path& path,
                              LightAngles light);

}  // namespace swell::sky
