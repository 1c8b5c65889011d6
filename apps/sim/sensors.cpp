#include "apps/sim/sensors.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "apps/sim/camera.h"
#include "apps/sim/geodetic.h"
#include "apps/sim/lidar_sensor.h"
#include "apps/sim/sim_world.h"
#include "math/elementary.h"
#include "math/enum_table.h"
#include "render/world/world.h"

namespace swell::apps {
namespace {

using scene::Rig;
using scene::RigBody;
using scene::Sensor;
using scene::SensorKind;

constexpr const char *kMap = "map", *kOdom = "odom";

std::string topic_name(const Sensor& sensor, const char* more = "") {
  return "/" + sensor.name + more;
}

msg::Header sensor_header(const Sensor& sensor, const Moment& moment) {
  return {moment.stamp(), sensor_frame(sensor)};
}

// The motion in "map" of what `pose_at` places, on a body or on none. Of a body whose poses come
// from outside it is worked out of those that have come; nothing while there are too few.
template <class PoseAt>
std::optional<FrameMotion> motion_of(const SimWorld& world, const RigBody* body,
                                     const PoseAt& pose_at, const Moment& moment) {
  if (body && body->is_input) {
    const auto window = world.motion_window(*body, moment);
    if (!window) return std::nullopt;
    const auto [end, step_ns] = *window;
    return motion_behind(pose_at({end.t_ns - 2 * step_ns}), pose_at({end.t_ns - step_ns}),
                         pose_at(end), static_cast<double>(step_ns) / 1e9);
  }
  const Moment before = {moment.t_ns - kMotionStep_ns}, after = {moment.t_ns + kMotionStep_ns};
  return motion_between(pose_at(before), pose_at(moment), pose_at(after),
                        static_cast<double>(kMotionStep_ns) / 1e9);
}

// ---- Sensors by kind

float range_of(const Sensor& sensor, SimWorld& world, const Moment& moment) {
  const FramePose pose = world.sensor_at(sensor, moment);
  const glm::dvec3 ahead = pose.axes[0];
  double distance_m = world.ground_distance(pose.position_m, ahead, sensor.farthest_m);
  if (sensor.kind == SensorKind::kAltimeter)
    if (const auto hit =
            world.water_at(moment).intersect(pose.position_m, ahead, sensor.farthest_m))
      distance_m = std::min(distance_m, hit->distance_m);
  if (distance_m < sensor.nearest_m) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(distance_m);
}

// Altimeters see water and ground, echo sounders the ground alone.
Publish range_sensor(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor), msg::Range::kType);
  return [&sensor, &world, topic](const Moment& moment, const Emit& emit) {
    emit(topic,
         msg::Range{sensor_header(sensor, moment),
                    sensor.kind == SensorKind::kAltimeter ? msg::Range::kInfrared
                                                          : msg::Range::kUltrasound,
                    static_cast<float>(sensor.beam_rad), static_cast<float>(sensor.nearest_m),
                    static_cast<float>(sensor.farthest_m), range_of(sensor, world, moment)});
  };
}

// The point of the water's surface above or below the sensor.
Publish wave_probe(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor), msg::PointStamped::kType);
  return [&sensor, &world, topic](const Moment& moment, const Emit& emit) {
    const glm::dvec2 at(world.sensor_at(sensor, moment).position_m);
    const double z = static_cast<double>(world.water_at(moment).height(at));
    emit(topic, msg::PointStamped{{moment.stamp(), kMap}, {at.x, at.y, z}});
  };
}

Publish imu(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor, "/data"), msg::Imu::kType);
  return [&sensor, &world, topic](const Moment& moment, const Emit& emit) {
    const auto pose_at = [&](const Moment& at) { return world.sensor_at(sensor, at); };
    const FramePose pose = pose_at(moment);
    const auto motion = motion_of(world, world.rig().find_body(sensor.body), pose_at, moment);
    if (!motion) return;
    const double gravity_mps2 = world.world().scene().sea.gravity_mps2;
    const glm::dvec3 felt = motion->acceleration_mps2 + glm::dvec3(0.0, 0.0, gravity_mps2);
    msg::Imu message;
    message.header = sensor_header(sensor, moment);
    message.orientation = quaternion_message(pose.axes);
    message.angular_velocity = vector_message(motion->turn_rad_s);
    message.linear_acceleration = vector_message(glm::transpose(pose.axes) * felt);
    emit(topic, message);
  };
}

Publish gnss(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor, "/fix"), msg::NavSatFix::kType);
  return [&sensor, &world, topic](const Moment& moment, const Emit& emit) {
    const Rig& rig = world.rig();
    const Geodetic at = geodetic_of({rig.latitude_rad, rig.longitude_rad, rig.altitude_m},
                                    world.sensor_at(sensor, moment).position_m);
    msg::NavSatFix message;
    message.header = sensor_header(sensor, moment);
    message.latitude = at.latitude_rad / kRadPerDeg;
    message.longitude = at.longitude_rad / kRadPerDeg;
    message.altitude = at.altitude_m;
    emit(topic, message);
  };
}

Publish odometry(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor), msg::Odometry::kType);
  const RigBody& body = *world.rig().find_body(sensor.body);
  return [&body, &world, topic](const Moment& moment, const Emit& emit) {
    const auto pose_at = [&](const Moment& at) { return world.body_at(body, at); };
    const FramePose pose = pose_at(moment);
    const auto motion = motion_of(world, &body, pose_at, moment);
    if (!motion) return;
    msg::Odometry message;
    message.header = {moment.stamp(), kOdom};
    message.child_frame_id = body.frame;
    message.pose.pose = pose_message(pose);
    message.twist.twist = {vector_message(glm::transpose(pose.axes) * motion->velocity_mps),
                           vector_message(motion->turn_rad_s)};
    emit(topic, message);
  };
}

Publish pose_sensor(const Sensor& sensor, SimWorld& world, Simulation& simulation) {
  const std::size_t topic = simulation.topic(topic_name(sensor), msg::PoseStamped::kType);
  return [&sensor, &world, topic](const Moment& moment, const Emit& emit) {
    emit(topic,
         msg::PoseStamped{{moment.stamp(), kMap}, pose_message(world.sensor_at(sensor, moment))});
  };
}

// What makes a kind's messages: it adds its topics. Those that are slow come last of a moment.
struct Maker {
  Publish (*make)(const Sensor&, SimWorld&, Simulation&);
  bool is_slow = false;
};
constexpr auto kMakers = enum_table<SensorKind, Maker>({
    {SensorKind::kCamera, {camera, true}},
    {SensorKind::kLidar, {lidar, true}},
    {SensorKind::kAltimeter, {range_sensor}},
    {SensorKind::kEchoSounder, {range_sensor}},
    {SensorKind::kWaveProbe, {wave_probe}},
    {SensorKind::kImu, {imu}},
    {SensorKind::kGnss, {gnss}},
    {SensorKind::kOdometry, {odometry}},
    {SensorKind::kPose, {pose_sensor}},
});

// What is on a body publishes nothing while its pose is not known.
Publish once_known(const RigBody* body, const SimWorld& world, Publish publish) {
  if (!body || !body->is_input) return publish;
  return [body, &world, publish = std::move(publish)](const Moment& moment, const Emit& emit) {
    if (world.knows(*body, moment)) publish(moment, emit);
  };
}

void add_sensors(bool slow, SimWorld& world, Simulation& simulation) {
  const Rig& rig = world.rig();
  for (const Sensor& sensor : rig.sensors) {
    if (kMakers[sensor.kind].is_slow != slow) continue;
    Publish publish = once_known(rig.find_body(sensor.body), world,
                                 kMakers[sensor.kind].make(sensor, world, simulation));
    simulation.sources.push_back(
        {sensor.name, scene::kSensorKinds[sensor.kind].name, sensor.rate_hz, std::move(publish)});
  }
}

// ---- Frames and the clock

// All frames that do not move in their parents'.
msg::TFMessage static_frames(SimWorld& world) {
  const Rig& rig = world.rig();
  msg::TFMessage message;
  const auto add = [&](const std::string& parent, const std::string& child, const FramePose& pose) {
    message.transforms.push_back(transform_message({}, parent, child, pose));
  };
  add(kMap, kOdom, {});
  for (const RigBody& body : rig.bodies)
    if (!body.moves()) add(kOdom, body.frame, world.body_at(body, {}));
  for (const Sensor& sensor : rig.sensors) {
    if (!scene::kSensorKinds[sensor.kind].has_place) continue;
    add(sensor.body.empty() ? kMap : sensor.body, sensor_frame(sensor), mounting(sensor));
    if (sensor.kind == SensorKind::kCamera)
      add(sensor_frame(sensor), optical_frame_name(sensor), optical_frame());
  }
  return message;
}

void add_clock(const Rig& rig, Simulation& simulation) {
  if (rig.clock_hz == 0.0) return;
  const std::size_t topic = simulation.topic("/clock", msg::Clock::kType);
  simulation.sources.push_back(
      {"clock", "clock", rig.clock_hz, [topic](const Moment& moment, const Emit& emit) {
         emit(topic, msg::Clock{moment.stamp()});
       }});
}

void add_frames(SimWorld& world, Simulation& simulation) {
  const std::size_t fixed = simulation.topic("/tf_static", msg::TFMessage::kType, true);
  simulation.sources.push_back(
      {"tf_static", "frames", 0.0,
       [&world, fixed](const Moment&, const Emit& emit) { emit(fixed, static_frames(world)); }});
  for (const RigBody& body : world.rig().bodies) {
    if (!body.moves()) continue;
    const std::size_t topic = simulation.topic("/tf", msg::TFMessage::kType);
    const auto publish = [&world, &body, topic](const Moment& moment, const Emit& emit) {
      emit(topic, msg::TFMessage{{transform_message(moment.stamp(), kOdom, body.frame,
                                                    world.body_at(body, moment))}});
    };
    simulation.sources.push_back(
        {body.frame, "body", body.rate_hz, once_known(&body, world, publish)});
  }
}

}  // namespace

Simulation make_simulation(SimWorld& world) {
  const Rig& rig = world.rig();
  Simulation simulation;
  add_clock(rig, simulation);
  add_frames(world, simulation);
  add_sensors(false, world, simulation);
  add_sensors(true, world, simulation);
  return simulation;
}

}  // namespace swell::apps
