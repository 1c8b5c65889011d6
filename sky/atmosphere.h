// How clear air dims and scatters the light of the sun or the moon: tables for an eye at a height.
// Molecules, haze droplets and ozone over a round earth whose shadow makes the twilight.
//
// Source: E. Bruneton, F. Neyret, Precomputed Atmospheric Scattering, 2008 (the air, the
// transmittance table, orders of scattering); S. Hillaire, A Scalable and Production Ready Sky and
// Atmosphere Rendering Technique, 2020 (what molecules scatter more than once, as if from all sides
// alike; ozone). Each order is gathered along whole rays, for in twilight all light comes from far
// away, and haze throws it forward again.
#pragma once

#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "sky/air.h"

namespace swell::sky {

// Half the angle that the sun and the moon measure.
inline constexpr double kSunRadius_rad = 0.004654;

// The tables are for light that comes from one direction with irradiance 1 outside the air.
struct Atmosphere {
  Air air;
  std::vector<glm::vec3> transmittance;  // by height and distance to the air's top
  // These describe the light that was scattered once or more, by height and sine of the light's
  // elevation: its mean radiance over all directions; the moments (2, m) of what molecules make of
  // it; and all moments of what haze does (sky/light_moments.h).
  std::vector<glm::vec3> multiple, uneven, haze;

  auto fields() { return std::tie(air, transmittance, multiple, uneven, haze); }
};

// Makes the tables: the same bits with any workers. About 60 ms on two threads.
Atmosphere make_atmosphere(double turbidity, Workers& workers);

// The part of a light's rays that reach a height [0, kAirTop_m] from the sine of an elevation; 0
// from below the earth's edge. A point of light.
glm::vec3 transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation);

// Returns that part for a disc half a degree across: less where the earth's edge hides some of it.
glm::vec3 disc_transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation);

// By angle from the horizon and azimuth from the light.
struct ScatteredLight {
  std::vector<glm::vec3> rayleigh, mie;  // scattered once, to be multiplied by the phase function
  std::vector<glm::vec3> multiple;       // scattered more than once
};

// The air that an eye sees in the light of one source. Directions are as they seem: the air's
// bending lifts the horizon (math/earth.h), and between there and the zenith the sky is stretched
// evenly.
struct SkyTable {
  glm::dvec3 to_light{0, 0, 1};
  double horizon_sine = 0.0;
  ScatteredLight sky;
  // Between the eye and the sea, over the part of the sea's light that is lost there; none for an
  // eye at sea level.
  ScatteredLight below;
};

// to_light: unit. height_m: [0, kAirTop_m); 0 has its horizon at eye height. The same bits with any
// workers.
SkyTable make_sky_table(const Atmosphere& atmosphere, glm::dvec3 to_light, double height_m,
                        Workers& workers);

// Radiance of the sky in a unit direction, of light with irradiance 1 outside the air. Below the
// horizon: of air that hides the sea wholly, and scatters as that before it does; at sea level,
// that of the horizon. Light scattered less than 0.3 degrees is not resolved.
glm::vec3 sky_radiance(const SkyTable& table, glm::dvec3 direction);

// Sine of the elevation at which the sea ends, as it seems to an eye at height_m >= 0.
double horizon_sine(double height_m);

// As disc_transmittance(), of a disc at a height in [0, kAirTop_m] above the sea's edge as a whole,
// that seems to stand at a sine.
glm::vec3 whole_disc_transmittance(const Atmosphere& atmosphere, double height_m, double sine);

}  // namespace swell::sky
