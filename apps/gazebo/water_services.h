// What Gazebo's programs may ask of the simulation's water.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>

#include "apps/gazebo/names.h"
#include "math/parallel.h"
#include "ocean/open_sea/sea.h"
#include "scene/water.h"

namespace swell::apps {

// From a shell:
//   ign service -s /water/heights --reqtype ignition.msgs.Pose_V --reptype ignition.msgs.Pose_V
//     --timeout 1000 --req 'pose { position { x: 10 y: 20 } } pose { position { x: 11 y: 20 } }'
//   ign service -s /water/sea_state --reqtype ignition.msgs.Empty --reptype ignition.msgs.Param
//     --timeout 1000 --req ''
// The functions may be called from many threads at once, which then wait for each other. A request
// that is not right gives false, and the first one to each service a line on standard error.
class WaterServices {
 public:
  static constexpr const char* kHeights = "/water/heights";
  static constexpr const char* kSeaState = "/water/sea_state";
  static constexpr int kMostPoints = 100'000;

  explicit WaterServices(const scene::Water& water) : water_(water) {}

  // The simulation's time, which requests without a stamp ask for.
  void set_time(std::int64_t t_ns) { now_ns_ = t_ns; }

  // At the stamp of the request's header, from 0 to 2^31 s, or now: for each pose, at most
  // kMostPoints within 1e9 m, the place on the surface over or under its position (x east, y north
  // in "map"), and the orientation that turns up (z) onto the surface's normal by the shortest way.
  // Names and ids come back. The header's stamp is the time of the answer.
  bool heights(const gz_msgs::Pose_V& request, gz_msgs::Pose_V& reply);

  // Numbers that do not change with time: significant_height_m and mean_wavelength_m of the waves
  // that are simulated, wind_speed_mps and wind_from_deg (where it comes from, clockwise from
  // north), and, where the sea has a spectrum, peak_period_s and waves_from_deg of the waves with
  // the most energy. Each wind sea or swell is a child: significant_height_m, peak_period_s,
  // from_deg.
  bool sea_state(const gz_msgs::Empty& request, gz_msgs::Param& reply);

 private:
  bool answer(const char* service, FunctionRef<void()> work);
  void find_heights(const gz_msgs::Pose_V& request, gz_msgs::Pose_V& reply);
  void describe_sea(gz_msgs::Param& reply) const;

  std::atomic<std::int64_t> now_ns_ = 0;
  std::mutex mutex_;  // of all below
  scene::Water water_;
  Workers workers_{1};
  ocean::SeaFrame sea_;
  std::set<std::string> told_;  // services
};

}  // namespace swell::apps
