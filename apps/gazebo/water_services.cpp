#include "apps/gazebo/water_services.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

#include "apps/gazebo/convert.h"
#include "apps/shared/program.h"
#include "math/elementary.h"
#include "ocean/spectrum/spectrum.h"

namespace swell::apps {
namespace {

// The points of a request that is right.
std::vector<glm::dvec2> points_of(const gz_msgs::Pose_V& request) {
  constexpr double kFarthest_m = 1e9;
  if (request.pose_size() > WaterServices::kMostPoints)
    throw std::invalid_argument(fmt::format("got {} poses, allowed at most {}", request.pose_size(),
                                            WaterServices::kMostPoints));
  std::vector<glm::dvec2> points;
  points.reserve(static_cast<std::size_t>(request.pose_size()));
  for (const gz_msgs::Pose& pose : request.pose()) {
    const glm::dvec2 p(pose.position().x(), pose.position().y());
    if (!(std::abs(p.x) < kFarthest_m && std::abs(p.y) < kFarthest_m))
      throw std::invalid_argument(
          fmt::format("got a position at {} {}, allowed below {} m", p.x, p.y, kFarthest_m));
    points.push_back(p);
  }
  return points;
}

std::int64_t stamp_of(const gz_msgs::Time& stamp) {
  if (const auto t_ns = time_ns(stamp)) return *t_ns;
  throw std::invalid_argument(
      fmt::format("got the stamp {} s {} ns, allowed 0 to 2147483647 s "
                  "and 0 to 999999999 ns",
                  stamp.sec(), stamp.nsec()));
}

// Turns (0, 0, 1) onto a unit vector with z > 0 by the shortest way.
void set_orientation(const glm::dvec3& normal, gz_msgs::Quaternion& to) {
  const double length = std::sqrt(2.0 * (1.0 + normal.z));
  to.set_x(-normal.y / length);
  to.set_y(normal.x / length);
  to.set_z(0.0);
  to.set_w(0.5 * length);
}

void set_number(const char* key, double value, gz_msgs::Param& to) {
  gz_msgs::Any& number = (*to.mutable_params())[key];
  number.set_type(gz_msgs::Any::DOUBLE);
  number.set_double_value(value);
}

double degrees(double rad) { return rad / kRadPerDeg; }

// Clockwise from north, [0, 360).
double from_deg(const ocean::WaveSystem& system) {
  const double angle = degrees(atan2(-system.travel.x, -system.travel.y));
  return angle < 0.0 ? angle + 360.0 : angle;
}

double height_m(const ocean::WaveSystem& system) {
  return 4.0 * std::sqrt(ocean::variance_below(system, std::numeric_limits<double>::infinity()));
}

}  // namespace

bool WaterServices::answer(const char* service, FunctionRef<void()> work) {
  const std::lock_guard lock(mutex_);
  try {
    work();
    return true;
  } catch (const std::exception& fault) {
    if (told_.insert(service).second)
      fmt::print(stderr, "warning: {}: {}\n", service, one_line(fault.what()));
    return false;
  }
}

bool WaterServices::heights(const gz_msgs::Pose_V& request, gz_msgs::Pose_V& reply) {
  return answer(kHeights, [&] { find_heights(request, reply); });
}

bool WaterServices::sea_state(const gz_msgs::Empty&, gz_msgs::Param& reply) {
  return answer(kSeaState, [&] { describe_sea(reply); });
}

void WaterServices::find_heights(const gz_msgs::Pose_V& request, gz_msgs::Pose_V& reply) {
  const std::vector<glm::dvec2> points = points_of(request);
  const std::int64_t t_ns =
      request.header().has_stamp() ? stamp_of(request.header().stamp()) : now_ns_.load();
  const ocean::WaterSurface surface = water_.at(static_cast<double>(t_ns) / 1e9, sea_, workers_);
  std::vector<float> height_m(points.size());
  std::vector<glm::vec3> normal(points.size());
  surface.heights(points, height_m);
  surface.normals(points, normal);
  reply = request;
  apps::set_time(t_ns, *reply.mutable_header()->mutable_stamp());
  for (std::size_t i = 0; i < points.size(); ++i) {
    gz_msgs::Pose& pose = *reply.mutable_pose(static_cast<int>(i));
    pose.mutable_position()->set_z(static_cast<double>(height_m[i]));
    set_orientation(glm::dvec3(normal[i]), *pose.mutable_orientation());
  }
}

void WaterServices::describe_sea(gz_msgs::Param& reply) const {
  const ocean::Sea& sea = water_.sea();
  reply.Clear();
  set_number("significant_height_m", sea.significant_height_m(), reply);
  set_number("mean_wavelength_m", sea.mean_wavelength_m(), reply);
  set_number("wind_speed_mps", sea.description().wind_speed_mps, reply);
  set_number("wind_from_deg", degrees(sea.description().wind_from_rad), reply);
  const std::vector<ocean::WaveSystem> systems = ocean::wave_systems(sea.description());
  for (const ocean::WaveSystem& system : systems) {
    gz_msgs::Param& child = *reply.add_children();
    set_number("significant_height_m", height_m(system) * sea.description().amplitude_scale, child);
    set_number("peak_period_s", 1.0 / system.peak_hz, child);
    set_number("from_deg", from_deg(system), child);
  }
  const auto highest = std::ranges::max_element(systems, {}, height_m);
  if (highest == systems.end()) return;
  set_number("peak_period_s", 1.0 / highest->peak_hz, reply);
  set_number("waves_from_deg", from_deg(*highest), reply);
}

}  // namespace swell::apps
