// How the water moves at a place below the surface: the numbers that the sources of the water add
// up (ocean/water.h).
//
// Linear theory. A wave of height h at the surface over water of depth d has, s below the surface,
//   the head h c, velocities (i k / |k| h' / tanh kd) c and h' w, and their rates as accelerations,
//   c = cosh k(d - s) / cosh kd and w = sinh k(d - s) / sinh kd; both exp(-k s) in deep water.
// s is stretched, so that it is 0 at the surface, under crests and troughs alike, and d at the
// ground: s = (surface - z) d / (d + surface).
// Sources: Airy, Tides and Waves, 1845; Wheeler, Method for Calculating Forces Produced by
// Irregular Waves, 1970 (the stretching).
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace swell::ocean {

enum MotionField : std::size_t {
  kVelocityX,  // m/s: east, north, up
  kVelocityY,
  kVelocityZ,
  kAccelerationX,  // m/s2: their rates at a place that stands still
  kAccelerationY,
  kAccelerationZ,
  kHead,  // m: dynamic pressure over density and gravity, at the surface the height
  kMotionFields,
};
using Motion = std::array<float, kMotionFields>;

// What is asked for.
struct MotionParts {
  bool velocity = true, acceleration = true, pressure = true;

  bool has(MotionField field) const {
    return field == kHead ? pressure : field <= kVelocityZ ? velocity : acceleration;
  }
};

// The water over a place of the ground, as heights [m]: its surface, the still water and the
// ground, which is at -infinity where there is none.
struct WaterColumn {
  float surface_m = 0.0f, level_m = 0.0f, ground_m = 0.0f;
};

// Points of one length: places, how far they are below the surface, stretched, in [0, depth], and
// the depth of the still water there, infinite without a ground.
struct PointsBelow {
  std::span<const glm::dvec2> p_world;
  std::span<const float> below_m, depth_m;
  MotionParts parts;

  PointsBelow part(std::size_t first, std::size_t count) const {
    return {p_world.subspan(first, count), below_m.subspan(first, count),
            depth_m.subspan(first, count), parts};
  }
};

}  // namespace swell::ocean
