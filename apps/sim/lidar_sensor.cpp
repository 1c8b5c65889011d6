#include "apps/sim/lidar_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <span>
#include <vector>

#include "apps/sim/sim_world.h"
#include "math/check.h"
#include "render/measure/lidar_patterns.h"

namespace swell::apps {
namespace {

using render::LidarBeam;
using render::LidarReturn;

// The beams of a pattern, and where the cloud has them: that of row r and column c is
// beams[r * row_step + c * column_step].
struct Pattern {
  std::vector<LidarBeam> beams;
  std::size_t rows, columns, row_step, column_step;
};

// `duration_s`: of a scan, 0: all at once.
Pattern pattern_of(const scene::LidarSettings& lidar, double duration_s) {
  const auto columns = static_cast<std::size_t>(lidar.columns);
  if (lidar.pattern == scene::LidarPattern::kGrid)
    return {render::grid_beams({.width = lidar.columns,
                                .height = lidar.rows,
                                .width_rad = lidar.fov_x_rad,
                                .height_rad = lidar.fov_y_rad,
                                .duration_s = duration_s}),
            static_cast<std::size_t>(lidar.rows), columns, columns, 1};
  const std::string_view name = scene::kLidarPatterns[lidar.pattern];
  const render::SpinningModel* const model = render::find_spinning_model(name);
  SWELL_CHECK(model, "pattern {} has no model", name);
  const auto rows = static_cast<std::size_t>(model->beams);
  return {render::spinning_beams(*model, {.columns = lidar.columns, .duration_s = duration_s}),
          rows, columns, 1, rows};
}

// A point's bytes. Those of `klass` and `id` are named only where they are wanted.
struct PointBytes {
  float x, y, z, intensity;
  std::uint32_t t_ns;
  std::uint16_t ring, klass;
  std::uint32_t id;
};
constexpr std::uint32_t kBytesWithoutId = offsetof(PointBytes, id);

std::vector<msg::PointField> fields_of(const scene::Sensor& sensor) {
  using Field = msg::PointField;
  std::vector<Field> fields;
  const auto add = [&](const char* name, std::size_t offset, std::uint8_t type) {
    fields.push_back({name, static_cast<std::uint32_t>(offset), type, 1});
  };
  add("x", offsetof(PointBytes, x), Field::kFloat32);
  add("y", offsetof(PointBytes, y), Field::kFloat32);
  add("z", offsetof(PointBytes, z), Field::kFloat32);
  add("intensity", offsetof(PointBytes, intensity), Field::kFloat32);
  add("t", offsetof(PointBytes, t_ns), Field::kUint32);
  add("ring", offsetof(PointBytes, ring), Field::kUint16);
  if (sensor.classes) add("class", offsetof(PointBytes, klass), Field::kUint16);
  if (sensor.ids) add("id", offsetof(PointBytes, id), Field::kUint32);
  return fields;
}

render::SensorPose sensor_pose(const FramePose& pose) {
  return {pose.position_m, glm::normalize(glm::quat_cast(pose.axes))};
}

class LidarSensor {
 public:
  LidarSensor(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation)
      : sensor_(sensor),
        world_(world),
        duration_s_(sensor.lidar.rolling_shutter ? 1.0 / sensor.rate_hz : 0.0),
        pattern_(pattern_of(sensor.lidar, duration_s_)),
        returns_(pattern_.beams.size()),
        topic_(simulation.topic("/" + sensor.name + "/points", msg::PointCloud2::kType)) {
    const scene::RigBody* body = world.rig().find_body(sensor.body);
    if (body && body->is_input && sensor.lidar.rolling_shutter)
      scene::refuse_key(world.rig(), sensor_key(world.rig(), sensor) + ".rolling_shutter",
                        "got true on a body whose pose comes from outside, allowed false: where it "
                        "will be is not known");
  }

  void publish(const Moment& moment, const Emit& emit) {
    scan(moment);
    emit(topic_, cloud(moment));
  }

 private:
  void scan(const Moment& moment) {
    const scene::LidarSettings& lidar = sensor_.lidar;
    render::LidarScan scan;
    scan.t_s = moment.t_s();
    scan.begin = sensor_pose(world_.sensor_at(sensor_, moment));
    if (lidar.rolling_shutter) {
      const Moment end = {moment.t_ns + std::llround(duration_s_ * 1e9)};
      scan.end = sensor_pose(world_.sensor_at(sensor_, end));
      scan.duration_s = duration_s_;
    }
    scan.moments = lidar.moments;
    scan.beams = pattern_.beams;
    scan.least_m = sensor_.nearest_m, scan.most_m = sensor_.farthest_m;
    scan.reach_m = lidar.reach_m;
    scan.range_noise_m = lidar.range_noise_m;
    scan.seed = lidar.seed;
    const std::vector<scene::GivenPose> poses = world_.given_poses(moment);
    scan.poses = poses;
    const std::vector<ocean::Disturbance> disturbances = world_.disturbances(moment);
    scan.disturbances = disturbances;
    world_.lidar().scan(scan, returns_, world_.workers());
  }

  msg::PointCloud2 cloud(const Moment& moment) const {
    msg::PointCloud2 cloud;
    cloud.header = {moment.stamp(), sensor_frame(sensor_)};
    cloud.height = static_cast<std::uint32_t>(pattern_.rows);
    cloud.width = static_cast<std::uint32_t>(pattern_.columns);
    cloud.point_fields = fields_of(sensor_);
    cloud.point_step = sensor_.ids ? std::uint32_t{sizeof(PointBytes)} : kBytesWithoutId;
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
    std::uint8_t* to = cloud.data.data();
    for (std::size_t row = 0; row < pattern_.rows; ++row)
      for (std::size_t column = 0; column < pattern_.columns; ++column) {
        const PointBytes point = point_of(row, column);
        std::memcpy(to, &point, cloud.point_step);
        to += cloud.point_step;
      }
    cloud.is_dense = std::ranges::all_of(
        returns_, [](const LidarReturn& r) { return std::isfinite(r.range_m); });
    return cloud;
  }

  PointBytes point_of(std::size_t row, std::size_t column) const {
    const std::size_t beam = row * pattern_.row_step + column * pattern_.column_step;
    const LidarReturn& r = returns_[beam];
    return {.x = r.p_sensor.x,
            .y = r.p_sensor.y,
            .z = r.p_sensor.z,
            .intensity = r.intensity,
            .t_ns = static_cast<std::uint32_t>(std::llround(pattern_.beams[beam].time_s * 1e9)),
            .ring = static_cast<std::uint16_t>(row),
            .klass = sensor_.classes ? static_cast<std::uint16_t>(r.klass) : std::uint16_t{0},
            .id = r.id};
  }

  const scene::Sensor& sensor_;
  SimWorld& world_;
  double duration_s_;
  Pattern pattern_;
  std::vector<LidarReturn> returns_;
  std::size_t topic_;
};

}  // namespace

Publish lidar(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const auto made = std::make_shared<LidarSensor>(sensor, world, simulation);
  return [made](const Moment& moment, const Emit& emit) { made->publish(moment, emit); };
}

}  // namespace swell::apps
