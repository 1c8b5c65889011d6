// Lidars of swell.h.
#include "render/measure/lidar.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "capi/call.h"
#include "capi/camera.h"
#include "capi/disturbances.h"
#include "capi/handles.h"
#include "math/elementary.h"
#include "render/measure/lidar_patterns.h"

namespace swell::capi {
namespace {

constexpr std::size_t kMostBeams = 100'000'000;
constexpr double kMostDuration_s = 1e3, kMostRange_m = 1e5, kUsualRange_m = 120.0;

render::SensorPose pose_of(const double (&position_m)[3], const double (&wxyz)[4],
                           const char* position_name, const char* quaternion_name) {
  render::SensorPose pose;
  for (int i = 0; i < 3; ++i) {
    check_range(position_name, position_m[i], -1e6, 1e6);
    pose.position_world[i] = position_m[i];
  }
  pose.world_from_sensor = unit_quaternion(wxyz, quaternion_name);
  return pose;
}

std::vector<render::LidarBeam> beams_of(const swell_lidar& given) {
  if (given.count > kMostBeams)
    refuse("lidar.count, got {}, allowed 0 to {}", given.count, kMostBeams);
  if (given.count > 0) check_not_null(given.beams, "lidar.beams");
  std::vector<render::LidarBeam> beams(given.count);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double* const b = given.beams + 3 * i;
    if (!(std::abs(b[0]) <= 1e6 && std::abs(b[1]) <= 1e6 && std::abs(b[2]) <= kMostDuration_s))
      refuse(
          "lidar.beams[{}], got {} deg, {} deg, {} s, allowed angles within 1e6, times within {}",
          i, b[0], b[1], b[2], kMostDuration_s);
    beams[i] = {radians(b[0]), radians(b[1]), b[2]};
  }
  return beams;
}

// All but the beams, poses and disturbances.
render::LidarScan scan_of(const swell_lidar& given) {
  render::LidarScan scan;
  check_time(given.t_s);
  scan.t_s = given.t_s;
  scan.begin =
      pose_of(given.position_m, given.quaternion_wxyz, "lidar.position_m", "lidar.quaternion_wxyz");
  check_range("lidar.duration_s", given.duration_s, 0.0, kMostDuration_s);
  scan.duration_s = given.duration_s;
  if (given.duration_s > 0.0)
    scan.end = pose_of(given.end_position_m, given.end_quaternion_wxyz, "lidar.end_position_m",
                       "lidar.end_quaternion_wxyz");
  check_range("lidar.moments", given.moments, 0, 64);
  scan.moments = std::max(given.moments, 1);
  if (scan.moments > 1 && given.duration_s == 0.0)
    refuse("lidar.moments, got {} without a duration, allowed 0 and 1", given.moments);
  scan.most_m = given.most_m == 0.0 ? kUsualRange_m : given.most_m;
  check_range("lidar.most_m", scan.most_m, 1e-3, kMostRange_m);
  check_range("lidar.least_m", given.least_m, 0.0, 0.999 * scan.most_m);
  scan.least_m = given.least_m;
  check_range("lidar.reach_m", given.reach_m, 0.0, kMostRange_m);
  scan.reach_m = given.reach_m;
  check_range("lidar.range_noise_m", given.range_noise_m, 0.0, 10.0);
  scan.range_noise_m = given.range_noise_m;
  scan.seed = given.seed;
  return scan;
}

void give_returns(const std::vector<render::LidarReturn>& returns, const swell_lidar& to) {
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const render::LidarReturn& r = returns[i];
    if (to.range_m) to.range_m[i] = r.range_m;
    if (to.intensity) to.intensity[i] = r.intensity;
    if (to.incidence_deg)
      to.incidence_deg[i] = static_cast<float>(static_cast<double>(r.incidence_rad) / kRadPerDeg);
    if (to.id) to.id[i] = r.id;
    if (to.klass) to.klass[i] = r.klass;
    for (int k = 0; k < 3 && to.point_m; ++k) to.point_m[3 * i + k] = r.p_sensor[k];
  }
}

const render::SpinningModel& model_of(const char* name) {
  check_not_null(name, "model");
  if (const render::SpinningModel* const model = render::find_spinning_model(name)) return *model;
  std::string names;
  for (const render::SpinningModel& model : render::spinning_models())
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  refuse("model, got '{:.40}', allowed {}", name, names);
}

// Writes beams into just as much room.
void give_beams(const std::vector<render::LidarBeam>& made, double* beams) {
  for (const render::LidarBeam& beam : made) {
    *beams++ = beam.azimuth_rad / kRadPerDeg;
    *beams++ = beam.elevation_rad / kRadPerDeg;
    *beams++ = beam.time_s;
  }
}

void check_room(std::size_t count, std::size_t beams, const double* room) {
  if (count != beams) refuse("count, got {}, allowed {}, the number of beams", count, beams);
  check_not_null(room, "beams");
}

}  // namespace
}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_scan(swell_session* session, const swell_lidar* lidar) {
  return guarded([&] {
    const Held held(session, "session");
    const swell_lidar given = taken(lidar, "lidar");
    const render::World& world = held->named->world;
    render::LidarScan scan = scan_of(given);
    const auto beams = beams_of(given);
    const auto poses =
        given_poses(given.poses, given.pose_count, world.scene().objects.size(), "lidar.poses");
    const auto disturbances = given_disturbances(given.disturbances, given.disturbance_count);
    if (beams.empty()) return;
    scan.beams = beams;
    scan.poses = poses;
    scan.disturbances = disturbances;
    if (!held->lidar) held->lidar = std::make_unique<render::Lidar>(world, held->workers);
    std::vector<render::LidarReturn> returns(beams.size());
    held->lidar->scan(scan, returns, held->workers);
    give_returns(returns, given);
  });
}

const char* swell_lidar_name(size_t model) {
  const auto models = render::spinning_models();
  return model < models.size() ? models[model].name.data() : nullptr;
}

size_t swell_lidar_beams(const char* model) {
  const render::SpinningModel* const found = model ? render::find_spinning_model(model) : nullptr;
  return found ? static_cast<std::size_t>(found->beams) : 0;
}

swell_status swell_spinning_beams(const char* model, int32_t columns, double start_deg,
                                  double duration_s, double* beams, size_t count) {
  return guarded([&] {
    const render::SpinningModel& spinning = model_of(model);
    check_range("columns", columns, 1, 1e6);
    check_range("start_deg", start_deg, -1e5, 1e5);
    check_range("duration_s", duration_s, 0.0, kMostDuration_s);
    check_room(count, static_cast<std::size_t>(columns) * static_cast<std::size_t>(spinning.beams),
               beams);
    give_beams(spinning_beams(spinning, {.columns = columns,
                                         .duration_s = duration_s,
                                         .start_azimuth_rad = radians(start_deg)}),
               beams);
  });
}

swell_status swell_grid_beams(int32_t width, int32_t height, double fov_x_deg, double fov_y_deg,
                              double duration_s, double* beams, size_t count) {
  return guarded([&] {
    check_range("width", width, 1, 8192);
    check_range("height", height, 1, 8192);
    check_range("fov_x_deg", fov_x_deg, 1e-6, 360.0);
    check_range("fov_y_deg", fov_y_deg, 1e-6, 180.0);
    check_range("duration_s", duration_s, 0.0, kMostDuration_s);
    check_room(count, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), beams);
    give_beams(render::grid_beams({.width = width,
                                   .height = height,
                                   .width_rad = radians(fov_x_deg),
                                   .height_rad = radians(fov_y_deg),
                                   .duration_s = duration_s}),
               beams);
  });
}
