// What disturbs the water besides the wind: things that fall or step into it, hulls under way,
// rotors above it. A list of these says all that wakes (ocean/wakes/wakes.h) are made from.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "math/enum_table.h"

namespace swell::ocean {

enum class DisturbanceKind : std::uint8_t {
  kDrop,      // a hump that is there at one moment, still, and then runs apart in rings
  kFootstep,  // a hollow with as much water around it as is missing in it
  kHull,      // a ship's that goes along a path
  kRotor,     // gusts under something that hovers
};
inline constexpr auto kDisturbanceKindNames = enum_words<DisturbanceKind>({
    {DisturbanceKind::kDrop, "drop"},
    {DisturbanceKind::kFootstep, "footstep"},
    {DisturbanceKind::kHull, "hull"},
    {DisturbanceKind::kRotor, "rotor"},
});

struct Disturbance {
  DisturbanceKind kind = DisturbanceKind::kDrop;

  // All but a hull.
  glm::dvec2 position_m{0.0};  // of its middle: east, north
  double t_s = 0.0;            // when it is there, or a rotor begins
  double duration_s = 60.0;    // of a rotor, [0, 1e6]
  double radius_m = 0.25;      // a drop's hump is h exp(-r^2 / radius^2); [0.02, 50]
  double height_m = 0.1;       // its h, below 0 a hollow; of a rotor's gusts the most; [-10, 10]

  // A hull: along this line, from the first point at t = 0, at one speed.
  std::vector<glm::dvec2> path_m{};
  double speed_mps = 3.0;               // [0, 1000]
  bool path_closed = true;              // round and round, always; false: it stops at the last
  glm::dvec3 hull_m = {2.9, 9.2, 0.5};  // beam, length, draught; [0.05, 500] each
  double depth_m = 0.0;                 // of the water, for dispersion; 0: deep, else [0.1, 1e4]

  bool operator==(const Disturbance&) const = default;
};

// |dz/dx| and |dz/dy| of wakes.
inline constexpr float kMostWakeSlope = 0.6f;

// What their waves stay within.
struct WakeBounds {
  float height_m = 0.0f;      // |z|
  float slope = 0.0f;         // in any direction
  double wavelength_m = 0.0;  // of the longest that are not small, 0 without any

  void include(const WakeBounds& other);
};

// Drops: twice as high as they begin, since several may meet. Hulls: the height to which water
// rises that meets them at their speed, U^2 / 2g, at most twice their draught.
WakeBounds wake_bounds(std::span<const Disturbance> disturbances, double gravity_mps2);

}  // namespace swell::ocean
