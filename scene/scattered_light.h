// Light in the air that was scattered once or more, at each place and in each direction.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "scene/air_paths.h"
#include "scene/light_moments.h"

namespace swell::scene {

// Of Atmosphere::multiple, zonal and haze: of a round earth while the light is down, of level
// layers when it is up.
void fill_scattered_light(Atmosphere& atmosphere, Workers& workers);

// What air makes, in a path's direction, of the light at its steps; for light of the elevations
// that the path meets.
struct PathSources {
  std::vector<glm::vec3> air;  // molecules: by height and sine of the light's elevation
  // Haze, by mode of the azimuth: by height, and so many of the sines.
  int first_column = 0, columns = 0;
  std::array<std::vector<glm::vec3>, kModes> haze;
};
PathSources sources_along(const Atmosphere& atmosphere, const Path& path, double light_sine);

// As scatter_again() of all light, at the azimuth of `light`, whose cosine is given.
glm::vec3 scatter_light_again(const PathSources& sources, double cos_azimuth, const Path& path,
                              LightAngles light);

}  // namespace swell::scene
