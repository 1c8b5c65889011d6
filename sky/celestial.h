// Where sun, moon and stars stand, by time and place.
//
// Source: J. Meeus, Astronomical Algorithms, 2nd edition, 1998, chapters 7, 12, 13, 22 and 25 (the
// sun, to 0.01 degrees from 1900 to 2100); The Astronomical Almanac, page D46, low-precision
// formulae for the moon (0.3 degrees); NOAA, Solar Calculation Details (refraction;
// under the horizon ours).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "sky/sky.h"

namespace swell::sky {

// Days from noon of 2000-01-01, universal time, of "2026-06-21T12:00:00Z"; seconds may have a
// fraction. None for any other text, and for years outside [1900, 2100].
std::optional<double> parse_time_utc(std::string_view text);

// In degrees: right ascension and declination, of the equator of date.
struct EquatorialPlace {
  double right_ascension_deg = 0.0, declination_deg = 0.0;
  double distance_km = 0.0;
};
EquatorialPlace sun_place(double days);
EquatorialPlace moon_place(double days);

// Returns the sidereal time of Greenwich's meridian, in [0, 360).
double sidereal_degrees(double days);

// As seen from a place on the earth, clockwise from north and above the horizon.
struct HorizontalPlace {
  double azimuth_rad = 0.0, elevation_rad = 0.0;
};
// Geometric: without the air's refraction, seen from the earth's middle.
HorizontalPlace horizontal_place(const EquatorialPlace& place, double days, double latitude_rad,
                                 double longitude_rad);

// By how much the air lifts what stands at an elevation.
double refraction_rad(double elevation_rad);

// The lit part of the moon's disc, [0, 1].
double moon_lit_part(const EquatorialPlace& sun, const EquatorialPlace& moon);

// Sets azimuth and elevation of sun and moon, as they are seen through the air and from the earth's
// surface, and the moon's phase; not sun_direction.
void place_sun_and_moon(double days, Sky& sky);

// To the axes of the sky of stars (x: the equinox on the equator, z: the pole) from those of the
// world (east, north, up).
glm::dmat3 stars_from_world(double sidereal_rad, double latitude_rad);

}  // namespace swell::sky
