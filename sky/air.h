// The earth's air: what it does to light at a height, and rays through its shell.
//
// Source: E. Bruneton, F. Neyret, Precomputed Atmospheric Scattering, 2008; S. Hillaire, A Scalable
// and Production Ready Sky and Atmosphere Rendering Technique, 2020 (ozone).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <tuple>

namespace swell::sky {

inline constexpr double kEarthRadius_m = 6360e3;
inline constexpr double kAirTop_m = 100e3;
inline constexpr double kAirTopRadius_m = kEarthRadius_m + kAirTop_m;

// Three wavelengths, 680, 550 and 440 nm, stand for linear red, green and blue; ozone counts by
// its mean over the bands of these colours.
struct Air {
  glm::dvec3 rayleigh_per_m{5.802e-6, 13.558e-6, 33.1e-6};  // at sea level, scattered
  glm::dvec3 mie_per_m{0.0};                                // at sea level, scattered and absorbed
  glm::dvec3 ozone_per_m{2.2e-6, 1.7e-6, 0.2e-6};           // at 25 km, absorbed

  auto fields() { return std::tie(rayleigh_per_m, mie_per_m, ozone_per_m); }
};

// turbidity: the optical depth of molecules and haze over that of molecules alone, at 550 nm, in
// [1, 20]; 1 is pure air.
Air make_air(double turbidity);

// At a height [0, kAirTop_m].
struct AirLight {
  glm::dvec3 rayleigh_per_m, mie_per_m;  // scattered
  glm::dvec3 lost_per_m;                 // scattered or absorbed
};
AirLight air_light(const Air& air, double height_m);

// Per steradian; their integrals over the sphere are 1.
double rayleigh_phase(double cos_theta);
double mie_phase(double cos_theta);

// The means over them of the Legendre polynomial of a degree.
double rayleigh_moment(int degree);
double mie_moment(int degree);

// Rays from radius_m about the earth's middle, towards the sine of an elevation.
double height_along(double radius_m, double sine, double t_m);
std::optional<double> distance_to_sea_m(double radius_m, double sine);  // none: the ray misses it
inline double distance_to_air_top_m(double radius_m, double sine) {
  const double in_circle =
      kAirTopRadius_m * kAirTopRadius_m - radius_m * radius_m * (1.0 - sine * sine);
  return std::max(-radius_m * sine + std::sqrt(std::max(in_circle, 0.0)), 0.0);
}

}  // namespace swell::sky
