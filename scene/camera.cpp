#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "math/check.h"
#include "math/elementary.h"
#include "math/projection.h"
#include "math/with_ieee.h"
#include "scene/camera_path.h"
#include "scene/scene.h"

namespace swell::scene {
namespace {

// A stretch of a path between two waypoints, and its neighbours; those beyond an end have length 0.
struct Stretch {
  double before_s, length_s, after_s;
  double u;  // how far along, [0, 1]
};

// The slope at a waypoint where the value changes by d0 in h0 and then by d1 in h1: a harmonic mean
// of the slopes on both sides, 0 if they differ in sign or a side is missing. The curve then stays
// between its waypoints' values.
// Source: Fritsch, Butland, A method for constructing local monotone piecewise cubic interpolants,
// 1984, eq. 5.
double slope_at(double d0, double h0, double d1, double h1) {
  if (h0 <= 0.0 || h1 <= 0.0 || d0 * d1 <= 0.0) return 0.0;
  const double weight = (h0 + 2.0 * h1) / (3.0 * (h0 + h1));
  const double s0 = d0 / h0, s1 = d1 / h1;
  return s0 * s1 / (weight * s1 + (1.0 - weight) * s0);
}

// Hermite's cubic: how far the value has moved from its start, given what it changes by before, on
// and after the stretch.
double moved(const Stretch& s, double before, double change, double after) {
  const double start_slope = slope_at(before, s.before_s, change, s.length_s) * s.length_s;
  const double end_slope = slope_at(change, s.length_s, after, s.after_s) * s.length_s;
  const double u = s.u, u2 = u * u, u3 = u2 * u;
  return (u3 - 2.0 * u2 + u) * start_slope + (3.0 * u2 - 2.0 * u3) * change + (u3 - u2) * end_slope;
}

constexpr double kMaxTime = 1e12, kMaxDistance = 1e7;

Waypoint pose_at(const Camera& camera, double t_s) {
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  t_s = std::clamp(t_s, -kMaxTime, kMaxTime);
  if (!camera.path.empty()) return pose_on_path(camera.path, t_s);
  // fmod is exact, so this costs no bits that the product had.
  return {t_s, camera.eye_m + camera.velocity_mps * t_s,
          std::fmod(camera.heading_rad + camera.turn_rad_s * t_s, 2.0 * kPi), camera.pitch_rad,
          camera.roll_rad};
}

// In the world's axes, or the object's.
glm::dmat3 axes_of(const Camera& camera, const Waypoint& pose) {
  if (!camera.quaternion) return camera_axes(pose.heading_rad, pose.pitch_rad, pose.roll_rad);
  const glm::dvec4& q = *camera.quaternion;
  return camera_axes(glm::dquat(q[0], q[1], q[2], q[3]));
}

// K, stretched to a picture of this size.
Intrinsics given_intrinsics(const Camera& camera, int width_px, int height_px) {
  SWELL_CHECK(camera.focal_px && camera.size_px, "focal_px without size_px");
  const glm::dvec2 centre_px = camera.principal_px.value_or(0.5 * *camera.size_px);
  const glm::dvec2 scale = glm::dvec2(width_px, height_px) / *camera.size_px;
  const glm::dvec2 f = scale * *camera.focal_px, c = scale * centre_px;
  return {f.x, f.y, c.x, c.y};
}

View view_from(const Camera& camera, glm::dvec3 eye_m, const glm::dmat3& world_from_camera,
               int width_px, int height_px) {
  const glm::dvec3 eye_world =
      glm::clamp(eye_m, glm::dvec3(-kMaxDistance), glm::dvec3(kMaxDistance));
  View view = make_view(eye_world, world_from_camera, camera_lens(camera, width_px, height_px),
                        static_cast<float>(camera.near_m), width_px, height_px);
  view.projection = camera_projection(camera, width_px, height_px);
  return view;
}

}  // namespace

Waypoint pose_on_path(std::span<const Waypoint> path, double t_s) {
  const auto next = std::ranges::upper_bound(path, t_s, {}, &Waypoint::t_s);
  if (next == path.begin() || next == path.end()) {
    const Waypoint& end = next == path.begin() ? path.front() : path.back();
    return {t_s, end.eye_m, end.heading_rad, end.pitch_rad, end.roll_rad};
  }
  const Waypoint &from = next[-1], &to = *next;
  const Waypoint& before = next - 1 == path.begin() ? from : next[-2];
  const Waypoint& after = next + 1 == path.end() ? to : next[1];
  const double length_s = to.t_s - from.t_s;
  const Stretch stretch = {from.t_s - before.t_s, length_s, after.t_s - to.t_s,
                           (t_s - from.t_s) / length_s};
  const auto value = [&](auto of) {
    return of(from) + moved(stretch, of(from) - of(before), of(to) - of(from), of(after) - of(to));
  };
  const auto turn = [](const Waypoint& a, const Waypoint& b) {
    return std::remainder(b.heading_rad - a.heading_rad, 2.0 * kPi);  // exact
  };
  return {t_s,
          {value([](const Waypoint& w) { return w.eye_m.x; }),
           value([](const Waypoint& w) { return w.eye_m.y; }),
           value([](const Waypoint& w) { return w.eye_m.z; })},
          from.heading_rad + moved(stretch, turn(before, from), turn(from, to), turn(to, after)),
          value([](const Waypoint& w) { return w.pitch_rad; }),
          value([](const Waypoint& w) { return w.roll_rad; })};
}

double camera_exposure(double f_number, double exposure_s, double iso) {
  constexpr double kShown = 0.18, kLuxSeconds = 10.0, kUnit_cd_m2 = 1e4;
  const double lux_s = 0.25 * kPi * kUnit_cd_m2 * exposure_s / (f_number * f_number);
  return kShown * lux_s * iso / kLuxSeconds;
}

Lens camera_lens(const Camera& camera, int width_px, int height_px) {
  if (!camera.focal_px) return lens_of_fov(camera.fov_y_rad, width_px, height_px);
  return lens_of_intrinsics(given_intrinsics(camera, width_px, height_px), width_px, height_px);
}

Projection camera_projection(const Camera& camera, int width_px, int height_px) {
  Projection projection = {.kind = camera.projection};
  if (camera.projection != ProjectionKind::kFisheye) return projection;
  const glm::dvec4& k = camera.fisheye_k;
  const std::array<double, 4> bend = {k[0], k[1], k[2], k[3]};
  projection = fisheye_of_fov(camera.fisheye_fov_rad, bend, width_px, height_px);
  if (camera.focal_px) projection.k = given_intrinsics(camera, width_px, height_px);
  return projection;
}

View camera_view(const Camera& camera, double t_s, int width_px, int height_px) {
  SWELL_CHECK(camera.mount.empty(), "mount={}", camera.mount);
  return with_ieee([&] {
    const Waypoint pose = pose_at(camera, t_s);
    return view_from(camera, pose.eye_m, axes_of(camera, pose), width_px, height_px);
  });
}

View mounted_view(const Camera& camera, const ObjectPose& object, double t_s, int width_px,
                  int height_px) {
  return with_ieee([&] {
    const glm::dmat3& world_from_object = object.world_from_object;
    return view_from(camera, object.position_world + world_from_object * camera.mount_offset_m,
                     world_from_object * axes_of(camera, pose_at(camera, t_s)), width_px,
                     height_px);
  });
}

const FloatingObject* camera_mount(const Scene& scene) {
  if (scene.camera.mount.empty()) return nullptr;
  const auto mount = std::ranges::find(scene.objects, scene.camera.mount, &FloatingObject::name);
  return mount == scene.objects.end() ? nullptr : &*mount;
}

View camera_view(const Scene& scene, const ocean::WaterSurface& surface, double t_s, int width_px,
                 int height_px) {
  const FloatingObject* object = camera_mount(scene);
  if (!object) return camera_view(scene.camera, t_s, width_px, height_px);
  ObjectPose pose;
  object_poses({object, 1}, surface, {&pose, 1});
  if (scene.detail.triangulation == Triangulation::kPlane) lay_flat({object, 1}, {&pose, 1});
  return mounted_view(scene.camera, pose, t_s, width_px, height_px);
}

}  // namespace swell::scene
