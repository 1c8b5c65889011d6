// Light in a layer of fog over the sea, by optical depth: what a way through it loses, and what it
// scatters to the eye of the light of the sun, each time from one direction, and of that of the
// sky. The renderer's kernels (render/sky/fog-inl.h) follow the same forms.
//
// Source: R. V. Klassen, Modeling the effect of the atmosphere on light, 1987 (two sources, the sun
// and the sky); J. F. Blinn, Light reflection functions for simulation of clouds and dusty
// surfaces, 1982 (the phase function); H. Koschmieder, Theorie der horizontalen Sichtweite, 1924.
#pragma once

#include <glm/glm.hpp>

#include "sky/sky.h"

namespace swell::sky {

// Contrast that is left at the range that is called visibility.
inline constexpr double kVisibleContrast = 0.02;

// Rain fills the air up to here, and what fog there is with it.
inline constexpr double kRainTop_m = 1500.0;

// What rain takes a metre, of all colours alike, its drops being large: that at a rate of R mm/h
// 2 % of the contrast are left at 11.6 R^-0.63 km. Source: D. Atlas, Optical extinction by
// rainfall, 1953.
double rain_per_m(double rain_mm_h);

// What is lost a metre at sea level, 0 without fog and rain: B = ln 50 / visibility, and the
// rain's.
glm::dvec3 fog_per_m(const FoggyAir& air);

// How high fog reaches, and rain, if there is some.
double fog_layer_top_m(const FoggyAir& air);

// The fog above a height, as metres of that at sea level; heights below 0 are in the fog of sea
// level.
double fog_above_m(const FoggyAir& air, double height_m);

// Blinn's S, 1 straight on for l = 0, and the same per steradian: its integral over the sphere
// is 1. l: in (-1, 1), below 0.99.
double blinn_phase(double cos_theta, double l);
double fog_phase(double cos_theta, double l);

// A straight way through fog, all of it as optical depths.
struct FogWay {
  double depth = 0.0;  // of the way
  double above = 0.0;  // of the fog over its near end, straight up
  double rise = 0.0;   // sine of its elevation, away from the eye
};

// What a way scatters to the eye of light from the sine sun_sine > 0, whose irradiance over the fog
// and phase function are 1. Exact for single scattering by fog whose density is any function of the
// height.
double scattered_once(const FogWay& way, double sun_sine);

// Returns what it scatters when each point has the ground's light, through all of the fog: `whole`,
// straight up. Source: Vyatkin, Dolgovesov, 2019, equation 15, with S that has B.
double scattered_by_paper(const FogWay& way, double whole, double sun_sine);

// What fog makes of light that falls on it. Radiances and irradiances in the unit of what falls.
struct FogLight {
  // Radiance of an endless way, besides the sun's light that was scattered once: the sky's, and the
  // sun's that was scattered more than once, as if evenly. No light is lost: what the sun's beam
  // loses leaves the layer.
  double even = 0.0;
  double sun_passes = 1.0;  // part of the sun's beam that comes through to the sea
  double ambient = 0.0;     // mean radiance from above, weighted by the cosine, at the sea
};

// depth: of the whole layer straight up. sun: irradiance over the fog of a surface turned to it.
// sky, below: mean radiance from above the fog and from under it.
FogLight light_in_fog(double depth, double forward, double sun_sine, double sun, double sky,
                      double below);

}  // namespace swell::sky
