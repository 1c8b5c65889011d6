// A lidar, or a depth sensor of single beams: what each beam of a pattern gets back from a world at
// a time.
//
//   render::Lidar lidar(world, workers);
//   const auto beams = render::spinning_beams("os1-64", {.columns = 1024});  // lidar_patterns.h
//   std::vector<render::LidarReturn> returns(beams.size());
//   lidar.scan({.t_s = 3.0, .begin = {eye_world, world_from_sensor}, .beams = beams}, returns,
//              workers);
//
// Beams meet the surfaces that queries answer for, not a picture's triangles: waves as
// WaterSurface::heights(), ground as terrain::height_at(), the finest meshes of objects where they
// are at that time, forms by their functions, trees with all their leaves turned to the sensor;
// within 1 mm at 100 m. The world is flat, as it is for queries: a picture of a round earth shows
// what is 100 m away 0.7 mm lower.
//
// The sensor's frame is that of REP 103: x ahead, y left, z up. Intensities are of light of 905 nm
// (render/measure/lidar_echo.h), of which water lets nothing return from below its surface.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <span>

#include "math/parallel.h"
#include "ocean/wakes/disturbance.h"
#include "scene/objects.h"

namespace swell::render {

class World;

// Where a beam points: `azimuth` from x towards y, `elevation` from there towards z. It leaves at
// t_s + time_s.
struct LidarBeam {
  double azimuth_rad = 0.0, elevation_rad = 0.0;
  double time_s = 0.0;
};

struct SensorPose {
  glm::dvec3 position_world{0.0};            // each coordinate within 1e6 m
  glm::dquat world_from_sensor{1, 0, 0, 0};  // of length 1
};

// What a beam got back.
struct LidarReturn {
  float range_m = 0.0f;             // along the beam; infinity: nothing came back
  float intensity = 0.0f;           // in [0, 1]: that of a white matt surface met squarely is 1
  float incidence_rad = 0.0f;       // between the beam and the surface's normal, in [0, pi / 2]
  std::uint32_t id = 0, klass = 0;  // as in the labels "id" and "class"; the sky's: nothing
  glm::vec3 p_sensor{0.0f};         // in the sensor's frame as the beam left; NaN: nothing
};

struct LidarScan {
  double t_s = 0.0;  // within 1e12
  SensorPose begin = {};
  // Where the sensor is at t_s + duration_s > t_s, for a turn with a rolling shutter: each beam
  // leaves from between the poses, on a straight line and by normalised linear interpolation of the
  // quaternions. None: it stays.
  std::optional<SensorPose> end = {};
  double duration_s = 0.0;
  // The world stands still at so many moments of the duration, in [1, 64], each beam being of the
  // one that is due: 1: at t_s; n: in the middles of n equal parts. A moment costs what a frame's
  // waves cost, some ms.
  int moments = 1;
  std::span<const LidarBeam> beams = {};
  double least_m = 0.0, most_m = 120.0;  // ranges that it tells, 0 <= least < most <= 1e5
  // How far a surface of reflectance 0.1 that is met squarely is seen half of the time; what sends
  // back less is lost sooner (is_detected()). 0: every beam that meets something has a return.
  double reach_m = 0.0;
  double range_noise_m = 0.0;  // standard deviation of what is added to ranges, in [0, 10]
  // Of the noise and of what is lost: a function of (seed, index of the beam, t_s) alone.
  std::uint64_t seed = 1;
  // As FrameOptions has them.
  std::span<const scene::GivenPose> poses = {};
  std::span<const ocean::Disturbance> disturbances = {};
};

// What is made of a world once to scan it, and storage; one scan at a time.
class Lidar {
 public:
  // The world has to outlive it. 5 ns a sample of the land, 0.5 us a triangle and a tree.
  Lidar(const World& world, Workers& workers);
  ~Lidar();
  Lidar(const Lidar&) = delete;
  Lidar& operator=(const Lidar&) = delete;

  // Fills the returns, one a beam. The same bits with any workers and SIMD target. Aborts with a
  // message for values out of their ranges, or spans of two lengths.
  void scan(const LidarScan& scan, std::span<LidarReturn> returns, Workers& workers);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swell::render
