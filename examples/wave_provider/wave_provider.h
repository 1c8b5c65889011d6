// Waves for a simulator, as VRX-like hosts ask for them: elevation, normal, particle velocity and
// still-water depth at (x, y, t), and velocities below the surface, over the C interface of
// libswell. docs/do/simulators.md tells how to put it into a host.
#pragma once

#include <swell.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

struct Point {
  double x = 0.0, y = 0.0;  // east, north [m]
};

struct PlaceBelow {
  double x = 0.0, y = 0.0, z = 0.0;  // east, north, up [m]; the mean sea level is z = 0
};

// The water's surface at a point.
struct WaterSample {
  double elevation_m = 0.0;                     // over the mean sea level
  std::array<double, 3> normal{0.0, 0.0, 1.0};  // unit, up
  std::array<double, 3> velocity_mps{0.0, 0.0,
                                     0.0};  // of the water at the surface: east, north, up
};

// The waves of a scene. A new time costs the wave patches of the scene (0.4 ms), points at a time
// that is known 0.1 us each; so the provider works out the waves every step_s and blends in
// between. That is off by at most step_s^2 / 8 times the water's acceleration: under 1 mm for 1/30
// s. Used by one thread at a time; throws std::runtime_error with the library's message.
class WaveProvider {
 public:
  // start_s: the scene's time when the simulation's is 0.
  explicit WaveProvider(const std::string& scene_file, double start_s = 0.0,
                        double step_s = 1.0 / 30.0);

  // Samples the surface at simulation time t_s. Times may come in any order; those that grow slowly
  // are cheap.
  std::vector<WaterSample> samples(const std::vector<Point>& points, double t_s);

  double elevation(double x, double y, double t_s);
  std::array<double, 3> normal(double x, double y, double t_s);
  std::array<double, 3> particle_velocity(double x, double y, double t_s);

  // Velocities of the water on and below the surface, each wave with its own decay; 0 above it and
  // in the ground. Blended as the samples are.
  std::vector<std::array<double, 3>> velocities_below(const std::vector<PlaceBelow>& places,
                                                      double t_s);

  // Depth of the ground under the mean sea level: below 0 on land, infinite where the scene has no
  // terrain.
  double still_water_depth(double x, double y);

 private:
  struct Deleter {
    void operator()(swell_world* world) const { swell_world_destroy(world); }
    void operator()(swell_session* session) const { swell_session_destroy(session); }
  };

  // Of the even steps, or of the odd ones.
  swell_session* session_of(double step);
  std::vector<WaterSample> samples_at_step(const std::vector<Point>& points, double step);
  std::vector<float> velocities_at_step(const std::vector<PlaceBelow>& places, double step);

  double start_s_, step_s_;
  std::unique_ptr<swell_world, Deleter> world_;
  std::array<std::unique_ptr<swell_session, Deleter>, 2>
      sessions_;  // of the even steps and the odd
};
