#include "scene/objects.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/parallel.h"
#include "ocean/inland/drift.h"
#include "ocean/water_surface.h"

namespace swell::scene {
namespace {

constexpr int kAround = 8, kRings = 2;
constexpr int kProbes = kAround * kRings;

// Points of the hull's plan, right and ahead, for a plan of radius 1: two rings.
std::array<glm::dvec2, kProbes> probe_plan() {
  std::array<glm::dvec2, kProbes> plan;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const SinCos angle = sin_cos_turns(static_cast<double>(i) / kAround);
      plan[ring * kAround + i] = (ring == 0 ? 1.0 : 0.5) * glm::dvec2(angle.sin, angle.cos);
    }
  }
  return plan;
}

// The plane z = height + slope . (right, ahead) of least squares over the plan's points.
struct Plane {
  double height_m = 0.0;
  glm::dvec2 slope{0.0};
};

// The plan is symmetric, so that the normal equations fall apart into one for each unknown.
Plane fit_plane(std::span<const glm::dvec2> plan_m, std::span<const float> z_m) {
  Plane plane;
  glm::dvec2 squares(0.0);
  for (std::size_t i = 0; i < plan_m.size(); ++i) {
    plane.height_m += static_cast<double>(z_m[i]);
    plane.slope += plan_m[i] * static_cast<double>(z_m[i]);
    squares += plan_m[i] * plan_m[i];
  }
  plane.height_m /= static_cast<double>(plan_m.size());
  plane.slope /= squares;
  return plane;
}

// The frame whose `ahead` points along the heading, tilted with the plane.
glm::dmat3 upright_frame(glm::dvec2 right, glm::dvec2 ahead, glm::dvec2 slope) {
  const glm::dvec2 uphill = slope.x * right + slope.y * ahead;
  const glm::dvec3 up = glm::normalize(glm::dvec3(-uphill, 1.0));
  const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(ahead, 0.0), up));
  return {side, glm::cross(up, side), up};
}

// The frame turned about `ahead`, so that its right side goes down.
glm::dmat3 rolled(const glm::dmat3& frame, double roll_rad) {
  const double s = sin(roll_rad), c = cos(roll_rad);
  return {c * frame[0] - s * frame[2], frame[1], c * frame[2] + s * frame[0]};
}

// --- Along a path

double length_of(std::span<const glm::dvec2> path, bool closed) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += glm::distance(path[i - 1], path[i]);
  return closed ? length_m + glm::distance(path.back(), path.front()) : length_m;
}

// At s metres from its beginning; before and behind its ends, straight on.
glm::dvec2 point_on(std::span<const glm::dvec2> path, bool closed, double s) {
  const std::size_t stretches = closed ? path.size() : path.size() - 1;
  for (std::size_t i = 0;; ++i) {
    const glm::dvec2 from = path[i], to = path[(i + 1) % path.size()];
    const double length_m = glm::distance(from, to);
    if (s <= length_m || i + 1 == stretches) return from + (s / length_m) * (to - from);
    s -= length_m;
  }
}

// Bow and stern lie on the path: so it turns at a corner as long as it is.
PlanPose pose_on_path(const FloatingObject& object, double t_s) {
  const double length_m = length_of(object.path_m, object.path_closed);
  const auto place = [&](double s) {
    if (object.path_closed) s -= length_m * std::floor(s / length_m);
    return point_on(object.path_m, object.path_closed, s);
  };
  double s = object.speed_mps * t_s;
  if (!object.path_closed) s = std::clamp(s, 0.0, length_m);
  const double half_m = std::min(0.5 * object.size_m.y, 0.24 * length_m);
  const glm::dvec2 bow = place(s + half_m), stern = place(s - half_m);
  const glm::dvec2 ahead = bow - stern;
  return {0.5 * (bow + stern), atan2(ahead.x, ahead.y)};
}

// --- Poses

// The plane of the water under an object, at its place.
Plane water_under(const FloatingObject& object, glm::dvec2 position_m, glm::dvec2 right,
                  glm::dvec2 ahead, const ocean::WaterSurface& surface,
                  const std::array<glm::dvec2, kProbes>& plan) {
  const glm::dvec2 middle = position_m + object.middle_m.x * right + object.middle_m.y * ahead;
  std::array<glm::dvec2, kProbes> plan_m, p_world;
  std::array<float, kProbes> z_m;
  for (int i = 0; i < kProbes; ++i) {
    plan_m[i] = plan[i] * (0.5 * glm::dvec2(object.size_m));
    p_world[i] = middle + plan_m[i].x * right + plan_m[i].y * ahead;
  }
  surface.heights(p_world, z_m);
  Plane plane = fit_plane(plan_m, z_m);
  plane.height_m -= glm::dot(plane.slope, object.middle_m);
  return plane;
}

ObjectPose pose_of(const FloatingObject& object, const ocean::WaterSurface& surface,
                   const std::array<glm::dvec2, kProbes>& plan) {
  const PlanPose at = plan_pose(object, surface.t_s());
  const glm::dvec2 ahead(sin(at.heading_rad), cos(at.heading_rad));
  const glm::dvec2 right(ahead.y, -ahead.x);
  const Plane water = water_under(object, at.position_m, right, ahead, surface, plan);
  if (object.motion == Motion::kFloat)
    return {glm::dvec3(at.position_m, water.height_m),
            upright_frame(right, ahead, kTiltShare * water.slope), water.height_m};
  return {glm::dvec3(at.position_m, object.height_m),
          rolled(upright_frame(right, ahead, glm::dvec2(0.0)), object.roll_rad), water.height_m};
}

}  // namespace

FloatingObject common_object(ObjectKind kind) {
  const ObjectKindFacts& facts = kObjectKinds[kind];
  FloatingObject object;
  object.kind = kind;
  object.size_m = facts.size_m;
  object.draught = facts.draught;
  object.colour = facts.colour;
  object.motion = facts.motion;
  object.at_file_origin = facts.at_file_origin;
  return object;
}

PlanPose plan_pose(const FloatingObject& object, double t_s) {
  if (object.path_m.size() >= 2) return pose_on_path(object, t_s);
  if (object.drift) {
    SWELL_CHECK(object.drift_track != nullptr, "an object that drifts without its way");
    const ocean::DriftPlace at = object.drift_track->at(t_s);
    return {at.p, object.heading_rad - at.turned_rad};
  }
  return {object.position_m, object.heading_rad};
}

std::string_view object_class(const FloatingObject& object) {
  return object.label.empty() ? "object" : std::string_view(object.label);
}

void object_poses(std::span<const FloatingObject> objects, const ocean::WaterSurface& surface,
                  std::span<ObjectPose> poses) {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(objects.size() == poses.size(), "{} objects, {} poses", objects.size(), poses.size());
  const std::array<glm::dvec2, kProbes> plan = probe_plan();
  for (std::size_t i = 0; i < objects.size(); ++i) poses[i] = pose_of(objects[i], surface, plan);
}

void take_given_poses(std::span<const FloatingObject> objects, std::span<const GivenPose> given,
                      const ocean::WaterSurface& surface, std::span<ObjectPose> poses) {
  const std::array<glm::dvec2, kProbes> plan = probe_plan();
  for (const GivenPose& g : given) {
    const glm::dvec2 level(g.pose.world_from_object[1]);
    const double length = glm::length(level);
    const glm::dvec2 ahead = length > 1e-6 ? level / length : glm::dvec2(0.0, 1.0);
    const Plane water = water_under(objects[g.object], glm::dvec2(g.pose.position_world),
                                    {ahead.y, -ahead.x}, ahead, surface, plan);
    poses[g.object] = g.pose;
    poses[g.object].water_m = water.height_m;
  }
}

void check_given_poses(std::span<const GivenPose> given, std::size_t objects) {
  for (const GivenPose& g : given) {
    SWELL_CHECK(g.object < objects, "a pose of object {} of {}", g.object, objects);
    const glm::dvec3 p = g.pose.position_world;
    SWELL_CHECK(std::abs(p.x) <= 1e7 && std::abs(p.y) <= 1e7 && std::abs(p.z) <= 1e7,
                "position_world=({}, {}, {})", p.x, p.y, p.z);
    const glm::dmat3& axes = g.pose.world_from_object;
    const glm::dmat3 product = glm::transpose(axes) * axes;
    double off = std::abs(glm::determinant(axes) - 1.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        off = std::max(off, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    SWELL_CHECK(off <= 1e-6 && std::isfinite(glm::determinant(axes)),
                "world_from_object of object {} is no rotation", g.object);
  }
}

void lay_flat(std::span<const FloatingObject> objects, std::span<ObjectPose> poses) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].motion == Motion::kFloat) poses[i].position_world.z = 0.0;
    poses[i].water_m = 0.0;
  }
}

}  // namespace swell::scene
