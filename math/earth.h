// The earth's curve, as a camera near the sea sees it.
//
// The world is flat: x east, y north, z above the sea. A picture sinks what it shows by
// r^2 / (2 R') at the horizontal distance r from the eye. That is a sphere's curve to 1 part in
// 4 (R' / r)^2: to 110 m of the 40 km that the horizon of an eye 40 km up has sunk.
#pragma once

namespace swell {

// The radius that makes up for the air's bending of light: R / (1 - k) with R = 6371 km and the
// coefficient of refraction k = 0.13 of the standard atmosphere. The horizon then lies at
// sqrt(2 R' h), 3.827 km times the root of the eye's height in metres, and sqrt(2 h / R') below the
// level.
inline constexpr double kEffectiveEarthRadius_m = 6371e3 / (1.0 - 0.13);

// r^2 times this is how far the sea has sunk; of a flat earth (infinity) 0.
constexpr float drop_per_m2(double earth_radius_m) {
  return static_cast<float>(0.5 / earth_radius_m);
}

}  // namespace swell
