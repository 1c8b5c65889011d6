#include "scene/objects.h"

#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
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

ObjectPose pose_of(const FloatingObject& object, const ocean::WaterSurface& surface,
                   const std::array<glm::dvec2, kProbes>& plan) {
  const glm::dvec2 ahead(sin(object.heading_rad), cos(object.heading_rad));
  const glm::dvec2 right(ahead.y, -ahead.x);
  std::array<glm::dvec2, kProbes> plan_m, p_world;
  std::array<float, kProbes> z_m;
  for (int i = 0; i < kProbes; ++i) {
    plan_m[i] = plan[i] * (0.5 * glm::dvec2(object.size_m));
    p_world[i] = object.position_m + plan_m[i].x * right + plan_m[i].y * ahead;
  }
  surface.heights(p_world, z_m);
  const Plane plane = fit_plane(plan_m, z_m);
  return {glm::dvec3(object.position_m, plane.height_m),
          upright_frame(right, ahead, kTiltShare * plane.slope)};
}

}  // namespace

std::string_view object_class(const FloatingObject& object) {
  return object.label.empty() ? "object" : std::string_view(object.label);
}

void object_poses(std::span<const FloatingObject> objects, const ocean::WaterSurface& surface,
                  std::span<ObjectPose> poses) {
  SWELL_CHECK(objects.size() == poses.size(), "{} objects, {} poses", objects.size(), poses.size());
  const std::array<glm::dvec2, kProbes> plan = probe_plan();
  for (std::size_t i = 0; i < objects.size(); ++i) poses[i] = pose_of(objects[i], surface, plan);
}

}  // namespace swell::scene
