#include "apps/sim/sim_world.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "apps/sim/input_disturbances.h"
#include "render/measure/lidar.h"
#include "render/world/world.h"
#include "scene/camera_path.h"
#include "terrain/ground_rays.h"
#include "terrain/height_grid.h"

namespace swell::apps {

SimWorld::SimWorld(const render::World& world, const scene::Rig& rig, Workers& workers,
                   const InputPoses* inputs, const InputDisturbances* disturbances)
    : world_(world),
      rig_(rig),
      workers_(workers),
      inputs_(inputs),
      disturbances_(disturbances),
      water_(world.water()) {}
SimWorld::~SimWorld() = default;

const ocean::WaterSurface& SimWorld::water_at(const Moment& moment) {
  std::vector<ocean::Disturbance> more = disturbances(moment);
  for (const KeptWater& kept : kept_)
    if (kept.surface && kept.t_ns == moment.t_ns && kept.disturbances == more) return *kept.surface;
  KeptWater& kept = kept_[next_];
  next_ = (next_ + 1) % kKept;
  kept.t_ns = moment.t_ns;
  kept.disturbances = std::move(more);
  kept.surface.emplace(
      water_.at(moment.t_s(), kept.sea, workers_, kept.disturbances, ocean::MakeWakes::kWhenAsked));
  return *kept.surface;
}

std::vector<ocean::Disturbance> SimWorld::disturbances(const Moment& moment) const {
  return disturbances_ ? disturbances_->at(moment) : std::vector<ocean::Disturbance>();
}

bool SimWorld::knows(const scene::RigBody& body, const Moment& moment) const {
  return !body.is_input || (inputs_ && inputs_->at(body.frame, moment));
}

std::optional<InputPoses::Window> SimWorld::motion_window(const scene::RigBody& body,
                                                          const Moment& moment) const {
  return inputs_ ? inputs_->motion_window(body.frame, moment) : std::nullopt;
}

FramePose SimWorld::body_at(const scene::RigBody& body, const Moment& moment) {
  if (body.is_input) return inputs_->at(body.frame, moment).value();
  const double t_s = moment.t_s();
  if (body.position_m)
    return heading_pose({t_s, *body.position_m, body.heading_rad, body.pitch_rad, body.roll_rad});
  if (!body.path.empty()) return heading_pose(scene::pose_on_path(body.path, t_s));
  const scene::Scene& scene = world_.scene();
  const auto object = std::ranges::find(scene.objects, body.mount, &scene::FloatingObject::name);
  scene::ObjectPose pose;
  scene::object_poses({&*object, 1}, water_at(moment), {&pose, 1});
  if (scene.detail.triangulation == scene::Triangulation::kPlane)
    scene::lay_flat({&*object, 1}, {&pose, 1});
  return object_frame(pose);
}

FramePose SimWorld::sensor_at(const scene::Sensor& sensor, const Moment& moment) {
  const scene::RigBody* body = rig_.find_body(sensor.body);
  return body ? body_at(*body, moment) * mounting(sensor) : mounting(sensor);
}

std::vector<scene::GivenPose> SimWorld::given_poses(const Moment& moment) const {
  std::vector<scene::GivenPose> given;
  const auto& objects = world_.scene().objects;
  for (const scene::RigBody& body : rig_.bodies) {
    if (!body.is_input || body.mount.empty() || !knows(body, moment)) continue;
    const auto object = std::ranges::find(objects, body.mount, &scene::FloatingObject::name);
    const FramePose pose = inputs_->at(body.frame, moment).value();
    given.push_back({static_cast<std::size_t>(object - objects.begin()), frame_object(pose)});
  }
  return given;
}

double SimWorld::ground_distance(const glm::dvec3& from, const glm::dvec3& direction,
                                 double far_m) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const terrain::HeightGrid* const land = water_.terrain();
  if (!land) return kNone;
  if (from.z < terrain::height_at(*land, glm::dvec2(from))) return 0.0;
  if (!ground_) ground_ = std::make_unique<terrain::GroundRays>(*land);
  return ground_->meet(from, direction, far_m).value_or(kNone);
}

render::Lidar& SimWorld::lidar() {
  if (!lidar_) lidar_ = std::make_unique<render::Lidar>(world_, workers_);
  return *lidar_;
}

}  // namespace swell::apps
