// The world that sensors are in: its water at a time, where bodies are, what a beam meets.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "apps/sim/frames.h"
#include "apps/sim/input_poses.h"
#include "apps/sim/simulation.h"
#include "math/parallel.h"
#include "ocean/open_sea/sea.h"
#include "ocean/water_surface.h"
#include "scene/file/rig.h"
#include "scene/objects.h"
#include "scene/water.h"

namespace swell::render {
class Lidar;
class World;
}  // namespace swell::render
namespace swell::terrain {
class GroundRays;
}

namespace swell::apps {

class InputDisturbances;

// Answers depend on the world, the rig and the time alone. Used by one thread at a time.
class SimWorld {
 public:
  // All of these have to outlive it; check_mounts() passes the rig. `inputs` has the poses of
  // bodies that come from outside; one without it never has a pose. `disturbances`: from outside,
  // too.
  SimWorld(const render::World& world, const scene::Rig& rig, Workers& workers,
           const InputPoses* inputs = nullptr, const InputDisturbances* disturbances = nullptr);
  ~SimWorld();

  SimWorld(const SimWorld&) = delete;
  SimWorld& operator=(const SimWorld&) = delete;

  const render::World& world() const { return world_; }
  const scene::Rig& rig() const { return rig_; }
  Workers& workers() { return workers_; }

  // The water at a time. It stays until kKept other times have been asked for.
  const ocean::WaterSurface& water_at(const Moment& moment);

  // Whether a body's pose at a moment is known. Those from outside are from the first one on.
  bool knows(const scene::RigBody& body, const Moment& moment) const;

  // When a body's poses from outside are to be differenced (input_poses.h).
  std::optional<InputPoses::Window> motion_window(const scene::RigBody& body,
                                                  const Moment& moment) const;

  // In "map": of a body, and of a sensor. Their body's pose is known.
  FramePose body_at(const scene::RigBody& body, const Moment& moment);
  FramePose sensor_at(const scene::Sensor& sensor, const Moment& moment);

  // The objects that bodies from outside are, where these are: for what draws or meets them.
  std::vector<scene::GivenPose> given_poses(const Moment& moment) const;

  // What disturbs the water from outside: for what draws or scans it.
  std::vector<ocean::Disturbance> disturbances(const Moment& moment) const;

  // How far a beam, a unit direction, goes until it meets the ground, under water too; infinity
  // where it meets none within far_m, 0 where it begins under it.
  double ground_distance(const glm::dvec3& from, const glm::dvec3& direction, double far_m);

  // What scans the world, for all lidars: made for the first one.
  render::Lidar& lidar();

 private:
  // Those that an IMU of 100 Hz comes back to: 40 ms before and after. Each has some MB.
  static constexpr std::size_t kKept = 10;
  struct KeptWater {
    std::int64_t t_ns = 0;
    std::vector<ocean::Disturbance> disturbances;
    ocean::SeaFrame sea;
    std::optional<ocean::WaterSurface> surface;
  };

  const render::World& world_;
  const scene::Rig& rig_;
  Workers& workers_;
  const InputPoses* inputs_;
  const InputDisturbances* disturbances_;
  scene::Water water_;
  std::unique_ptr<terrain::GroundRays> ground_;  // made for the first that asks
  std::unique_ptr<render::Lidar> lidar_;
  std::array<KeptWater, kKept> kept_;
  std::size_t next_ = 0;  // of them to be used again
};

}  // namespace swell::apps
