#include "capi/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "capi/call.h"
#include "math/elementary.h"
#include "math/projection.h"
#include "render/world_view.h"
#include "scene/camera.h"

namespace swell::capi {
namespace {

constexpr double kFarthestEye_m = 1e6, kFarthestObject_m = 1e7;
constexpr double kNear_m = 0.25;

template <std::size_t N>
void check_each(const char* name, const double (&values)[N], double low, double high) {
  for (const double value : values) check_range(name, value, low, high);
}

glm::dvec3 vector_of(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

template <std::size_t N, class Vector>
void set(double (&values)[N], const Vector& v) {
  for (std::size_t i = 0; i < N; ++i) values[i] = v[static_cast<glm::length_t>(i)];
}

void set(double (&wxyz)[4], const glm::dquat& q) {
  wxyz[0] = q.w, wxyz[1] = q.x, wxyz[2] = q.y, wxyz[3] = q.z;
}

Intrinsics intrinsics_of(const swell_camera& c) {
  check_each("camera.focal_px", c.focal_px, 0.1, 1e7);
  check_each("camera.principal_px", c.principal_px, -1e6, 1e6);
  return {c.focal_px[0], c.focal_px[1], c.principal_px[0], c.principal_px[1]};
}

Projection projection_of(const swell_camera& c) {
  switch (c.projection) {
    case SWELL_PERSPECTIVE:
      return {};
    case SWELL_FISHEYE: {
      check_each("camera.fisheye_k", c.fisheye_k, -10.0, 10.0);
      const double fov_deg = c.fisheye_fov_deg == 0.0 ? 180.0 : c.fisheye_fov_deg;
      check_range("camera.fisheye_fov_deg", fov_deg, 1.0, 360.0);
      const double half_rad = radians(0.5 * fov_deg);
      const std::array<double, 4> bend = std::to_array(c.fisheye_k);
      if (!is_one_to_one(bend, half_rad))
        refuse(
            "camera.fisheye_k, got [{}, {}, {}, {}], allowed a lens whose radius grows with the "
            "angle up to {} degrees",
            bend[0], bend[1], bend[2], bend[3], 0.5 * fov_deg);
      return {.kind = ProjectionKind::kFisheye,
              .k = intrinsics_of(c),
              .bend = bend,
              .half_fov_rad = half_rad};
    }
    case SWELL_EQUIRECTANGULAR:
      return {.kind = ProjectionKind::kEquirectangular};
    default:
      refuse("camera.projection, got {}, allowed one of swell_projection", c.projection);
  }
}

}  // namespace

glm::dquat unit_quaternion(const double (&wxyz)[4], const char* name) {
  check_each(name, wxyz, -1e100, 1e100);
  const glm::dquat q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const double length = glm::length(q);
  if (!(length > 1e-100)) refuse("{}, got 0, allowed a length over 0", name);
  return q / length;
}

PictureSize checked_size(int32_t width_px, int32_t height_px) {
  constexpr int kMost = 8192;
  check_range("width_px", width_px, 1, kMost);
  check_range("height_px", height_px, 1, kMost);
  return {width_px, height_px};
}

void check_time(double t_s) { check_range("t_s", t_s, -1e12, 1e12); }

View view_of(const swell_camera* camera, const char* name, PictureSize size) {
  const swell_camera c = taken(camera, name);
  check_each("camera.eye_m", c.eye_m, -kFarthestEye_m, kFarthestEye_m);
  const double near_m = c.near_m == 0.0 ? kNear_m : c.near_m;
  check_range("camera.near_m", near_m, 0.001, 100.0);
  const Projection projection = projection_of(c);
  const Intrinsics k = projection.is_wide() ? Intrinsics{1.0, 1.0, 0.0, 0.0} : intrinsics_of(c);
  View view =
      make_view(vector_of(c.eye_m), unit_quaternion(c.quaternion_wxyz, "camera.quaternion_wxyz"), k,
                static_cast<float>(near_m), size.width_px, size.height_px);
  view.projection = projection;
  return view;
}

swell_camera camera_of(const View& view) {
  const OpticalPose pose = camera_pose(view);
  swell_camera camera{};
  set(camera.eye_m, pose.eye_world);
  set(camera.quaternion_wxyz, pose.world_from_optical);
  const Projection& projection = view.projection;
  const Intrinsics& k = projection.is_wide() ? projection.k : pose.k;
  set(camera.focal_px, glm::dvec2(k.fx, k.fy));
  set(camera.principal_px, glm::dvec2(k.cx, k.cy));
  camera.near_m = static_cast<double>(view.near_m);
  camera.projection = static_cast<int32_t>(projection.kind);
  if (projection.kind == ProjectionKind::kFisheye) {
    std::ranges::copy(projection.bend, camera.fisheye_k);
    camera.fisheye_fov_deg = 2.0 * projection.half_fov_rad / kRadPerDeg;
  }
  return camera;
}

std::vector<scene::GivenPose> given_poses(const swell_pose* poses, std::size_t count,
                                          std::size_t objects, const char* name) {
  if (count > objects)
    refuse("{}, got {} poses, allowed 0 to {}, one an object", name, count, objects);
  std::vector<scene::GivenPose> given;
  std::vector<bool> has_one(objects);
  for (std::size_t i = 0; i < count; ++i) {
    const swell_pose p = taken(poses ? poses + i : nullptr, name);
    if (poses[i].size != sizeof(swell_pose))
      refuse("{}[].size, got {}, allowed {}", name, poses[i].size, sizeof(swell_pose));
    if (p.object >= objects || has_one[p.object])
      refuse("{}[{}].object, got {}, allowed one below {} without a pose", name, i, p.object,
             objects);
    has_one[p.object] = true;
    check_each("pose.position_m", p.position_m, -kFarthestObject_m, kFarthestObject_m);
    scene::ObjectPose pose;
    pose.position_world = vector_of(p.position_m);
    pose.world_from_object =
        glm::mat3_cast(unit_quaternion(p.quaternion_wxyz, "pose.quaternion_wxyz"));
    given.push_back({p.object, pose});
  }
  return given;
}

swell_pose pose_of(std::size_t object, const scene::ObjectPose& pose) {
  swell_pose result{sizeof(swell_pose), object, {}, {}};
  set(result.position_m, pose.position_world);
  set(result.quaternion_wxyz, glm::quat_cast(pose.world_from_object));
  return result;
}

}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_camera_look(const double eye_m[3], double heading_deg, double pitch_deg,
                               double roll_deg, double fov_y_deg, int32_t width_px,
                               int32_t height_px, swell_camera* camera) {
  return guarded([&] {
    check_not_null(eye_m, "eye_m");
    const auto size = checked_size(width_px, height_px);
    check_range("heading_deg", heading_deg, -1e6, 1e6);
    check_range("pitch_deg", pitch_deg, -90.0, 90.0);
    check_range("roll_deg", roll_deg, -1e6, 1e6);
    check_range("fov_y_deg", fov_y_deg, 0.01, 179.0);
    swell_camera made{};
    for (int i = 0; i < 3; ++i) {
      check_range("eye_m", eye_m[i], -kFarthestEye_m, kFarthestEye_m);
      made.eye_m[i] = eye_m[i];
    }
    const glm::dmat3 axes =
        camera_axes(radians(heading_deg), radians(pitch_deg), radians(roll_deg));
    // The optical frame: right, down, ahead.
    set(made.quaternion_wxyz, glm::quat_cast(glm::dmat3(axes[0], -axes[2], axes[1])));
    const double focal_px = 0.5 * size.height_px / swell::tan(0.5 * radians(fov_y_deg));
    set(made.focal_px, glm::dvec2(focal_px));
    set(made.principal_px, 0.5 * glm::dvec2(size.width_px, size.height_px));
    made.near_m = kNear_m;
    give(made, camera, "camera");
  });
}

swell_status swell_scene_camera(swell_session* session, double t_s, int32_t width_px,
                                int32_t height_px, swell_camera* camera) {
  return guarded([&] {
    const Held held(session, "session");
    check_time(t_s);
    const auto size = checked_size(width_px, height_px);
    const View view = render::world_view(held->named->world, t_s, size.width_px, size.height_px,
                                         held->camera_sea, held->workers);
    give(camera_of(view), camera, "camera");
  });
}
