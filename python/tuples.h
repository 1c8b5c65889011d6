// The structs of the C interface as the tuples that cross between Python and C++.
#pragma once

#include <swell.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "handles.h"

namespace swell_python {

// Eye, quaternion, focal lengths, principal point, near plane, projection, k1 to k4 of a fisheye
// and its field of view.
using CameraTuple = std::tuple<std::array<double, 3>, std::array<double, 4>, std::array<double, 2>,
                               std::array<double, 2>, double, int, std::array<double, 4>, double>;

inline swell_camera camera_of(const CameraTuple& tuple) {
  swell_camera camera{};
  camera.size = sizeof(camera);
  const auto& [eye, quaternion, focal, principal, near, projection, fisheye_k, fov_deg] = tuple;
  std::copy(eye.begin(), eye.end(), camera.eye_m);
  std::copy(quaternion.begin(), quaternion.end(), camera.quaternion_wxyz);
  std::copy(focal.begin(), focal.end(), camera.focal_px);
  std::copy(principal.begin(), principal.end(), camera.principal_px);
  camera.near_m = near;
  camera.projection = projection;
  std::copy(fisheye_k.begin(), fisheye_k.end(), camera.fisheye_k);
  camera.fisheye_fov_deg = fov_deg;
  return camera;
}

inline CameraTuple tuple_of(const swell_camera& c) {
  return {{c.eye_m[0], c.eye_m[1], c.eye_m[2]},
          {c.quaternion_wxyz[0], c.quaternion_wxyz[1], c.quaternion_wxyz[2], c.quaternion_wxyz[3]},
          {c.focal_px[0], c.focal_px[1]},
          {c.principal_px[0], c.principal_px[1]},
          c.near_m,
          c.projection,
          {c.fisheye_k[0], c.fisheye_k[1], c.fisheye_k[2], c.fisheye_k[3]},
          c.fisheye_fov_deg};
}

inline CameraTuple look(std::array<double, 3> eye, double heading_deg, double pitch_deg,
                        double roll_deg, double fov_y_deg, int width_px, int height_px) {
  swell_camera camera{};
  camera.size = sizeof(camera);
  check(swell_camera_look(eye.data(), heading_deg, pitch_deg, roll_deg, fov_y_deg, width_px,
                          height_px, &camera));
  return tuple_of(camera);
}

// Index, position, quaternion.
using PoseTuple = std::tuple<std::size_t, std::array<double, 3>, std::array<double, 4>>;

inline std::vector<swell_pose> poses_of(const std::vector<PoseTuple>& tuples) {
  std::vector<swell_pose> poses;
  for (const auto& [object, position, quaternion] : tuples) {
    swell_pose pose{};
    pose.size = sizeof(pose);
    pose.object = object;
    std::copy(position.begin(), position.end(), pose.position_m);
    std::copy(quaternion.begin(), quaternion.end(), pose.quaternion_wxyz);
    poses.push_back(pose);
  }
  return poses;
}

// Kind, position, time, duration, radius, height, path, speed, whether it is open, hull, depth.
using DisturbanceTuple =
    std::tuple<int, std::array<double, 2>, double, double, double, double,
               std::vector<std::array<double, 2>>, double, bool, std::array<double, 3>, double>;

// They point into the tuples.
inline std::vector<swell_disturbance> disturbances_of(const std::vector<DisturbanceTuple>& tuples) {
  std::vector<swell_disturbance> all;
  for (const auto& [kind, position, t, duration, radius, height, path, speed, open, hull, depth] :
       tuples) {
    swell_disturbance d{};
    d.size = sizeof(d);
    d.kind = kind;
    std::copy(position.begin(), position.end(), d.position_m);
    d.t_s = t;
    d.duration_s = duration;
    d.radius_m = radius;
    d.height_m = height;
    d.path_m = path.empty() ? nullptr : path.front().data();
    d.path_count = path.size();
    d.speed_mps = speed;
    d.path_open = open;
    std::copy(hull.begin(), hull.end(), d.hull_m);
    d.depth_m = depth;
    all.push_back(d);
  }
  return all;
}

// What is shown, position, distance, index of the object, id, height.
using PickTuple =
    std::tuple<int, std::array<double, 3>, double, std::size_t, std::uint32_t, double>;

}  // namespace swell_python
