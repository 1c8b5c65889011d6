// A sea at one time, to be asked below its surface.
#pragma once

#include <vector>

#include "ocean/below_frame.h"
#include "ocean/wakes/wakes.h"
#include "ocean/water_surface.h"

namespace swell::ocean {

struct SeaBelow {
  SeaBelow(const WaterParts& of, double t_s, int threads = 1,
           std::span<const Disturbance> disturbances = {})
      : parts(of), workers(threads) {
    advance(*parts.sea, t_s, frame, workers);
    const double gravity = parts.sea->description().gravity_mps2;
    advance_wakes(disturbances, {}, gravity, t_s, frame.wakes, workers);
    parts.wakes = wake_bounds(disturbances, gravity);
    advance_velocity(*parts.sea, frame, velocity, workers);
    begin_below(*parts.sea, frame, &velocity, below);
  }

  WaterSurface surface() const { return {parts, frame}; }

  std::vector<WaterMotion> motions(std::span<const glm::dvec3> p_world, MotionParts asked = {}) {
    std::vector<WaterMotion> motion(p_world.size());
    surface().motions(p_world, asked, kSeaDensity_kg_m3, below, workers, motion);
    return motion;
  }
  WaterMotion motion(glm::dvec3 p_world) { return motions({&p_world, 1})[0]; }

  HullLoads loads(const HullMesh& hull, glm::dvec3 about) {
    return surface().hull_loads(hull, about, kSeaDensity_kg_m3, below, workers);
  }

  WaterParts parts;
  Workers workers;
  SeaFrame frame;
  VelocityFrame velocity;
  BelowFrame below;
};

inline bool operator==(const WaterMotion& a, const WaterMotion& b) {
  return a.place == b.place && a.velocity_mps == b.velocity_mps &&
         a.acceleration_mps2 == b.acceleration_mps2 && a.pressure_pa == b.pressure_pa;
}

}  // namespace swell::ocean
