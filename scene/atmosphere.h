// How clear air dims and scatters the light of the sun or the moon: tables for an eye at sea level.
// Molecules, haze droplets and ozone over a round earth whose shadow makes the twilight.
//
// Source: E. Bruneton, F. Neyret, Precomputed Atmospheric Scattering, 2008 (the air, the
// transmittance table, orders of scattering); S. Hillaire, A Scalable and Production Ready Sky and
// Atmosphere Rendering Technique, 2020 (light scattered more than once as if from all sides alike;
// ozone). Unlike Hillaire's each order is gathered along whole rays, not from the place itself,
// for in twilight all light comes from far away.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "scene/air.h"

namespace swell::scene {

// Half the angle that the sun and the moon measure.
inline constexpr double kSunRadius_rad = 0.004654;

// Of light that comes from one direction with irradiance 1 outside the air.
struct Atmosphere {
  Air air;
  std::vector<glm::vec3> transmittance;  // by height and distance to the air's top
  std::vector<glm::vec3> multiple;       // by height and sine of the light's elevation:
                                         // mean radiance of what was scattered once or more
};

// The same bits with any workers. About 40 ms on two threads.
Atmosphere make_atmosphere(double turbidity, Workers& workers);

// The part of a light's rays that reach a height [0, kAirTop_m] from the sine of an elevation; 0
// from below the earth's edge. A point of light.
glm::vec3 transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation);

// The same of a disc half a degree across: less where the earth's edge hides a part of it.
glm::vec3 disc_transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation);

// The sky that one light makes for an eye at sea level, by elevation and azimuth from the light.
struct SkyTable {
  glm::dvec3 to_light{0, 0, 1};
  std::vector<glm::vec3> rayleigh, mie;  // scattered once, to be multiplied by the phase function
  std::vector<glm::vec3> multiple;       // scattered more than once
};

// to_light: unit. The same bits with any workers.
SkyTable make_sky_table(const Atmosphere& atmosphere, glm::dvec3 to_light, Workers& workers);

// Radiance of the sky in a unit direction, of light with irradiance 1 outside the air; below the
// horizon, that of the horizon. Light scattered less than 0.3 degrees is not resolved.
glm::vec3 sky_radiance(const SkyTable& table, glm::dvec3 direction);

}  // namespace swell::scene
