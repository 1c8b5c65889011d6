// What the camera of a scene is, and where it is and looks at a time: a fixed pose, a straight path
// with constant speed and turn rate, a path through waypoints, or a place on a floating object.
//
//   const View view = scene::camera_view(scene, water.at(t_s, frame, workers), t_s, 1280, 720);
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "math/elementary.h"
#include "math/view.h"
#include "scene/objects.h"

namespace swell::scene {

struct Scene;

// Where the camera is and looks at a time.
struct Waypoint {
  double t_s = 0.0;
  glm::dvec3 eye_m{0.0, 0.0, 10.0};
  double heading_rad = 0.0;  // clockwise from north
  double pitch_rad = 0.0;    // up positive
  double roll_rad = 0.0;     // positive lowers the right side
};

// What the camera's sensor adds to a picture (render/picture/sensor_noise.h).
struct SensorNoise {
  double full_well_e = 0.0;  // electrons that a pixel's channel holds; 0: there is no noise
  double iso = 100.0;        // at 100 the brightest light fills the well, at 200 half of it ...
  double read_noise_e = 3.0;
  std::uint64_t seed = 1;

  bool operator==(const SensorNoise&) const = default;
};

struct Camera {
  glm::dvec3 eye_m{0.0, 0.0, 10.0};
  double heading_rad = 0.0;  // clockwise from north
  double pitch_rad = 0.0;    // up positive
  double roll_rad = 0.0;     // positive lowers the right side
  double fov_y_rad = radians(50.0);
  double near_m = 0.25;
  glm::dvec3 velocity_mps{0.0};
  double turn_rad_s = 0.0;
  // In order of time, no two at one. Takes the place of the poses and motions above: smooth through
  // the waypoints, each coordinate between its values at the two around; headings turn the shorter
  // way; at rest before the first, after the last, and where two waypoints have the same place.
  std::vector<Waypoint> path{};

  // World from optical frame (math/view.h) as w, x, y, z, of length 1. Takes the place of heading,
  // pitch, roll and turn.
  std::optional<glm::dvec4> quaternion{};
  // K (math/view.h) of a picture of size_px, in place of the field of view: fx and fy, cx and cy
  // (the middle if there is none). A picture of another size shows the same, stretched to it.
  std::optional<glm::dvec2> focal_px{}, principal_px{}, size_px{};

  // How the picture shows directions (math/projection.h). Of fisheyes: the full angle of the cone
  // that is shown, which touches the picture's nearer edges where no focal length is given; and k1
  // to k4. Fisheyes and equirectangular pictures have no field of view from edge to edge, and the
  // latter no focal length.
  ProjectionKind projection = ProjectionKind::kPerspective;
  double fisheye_fov_rad = radians(180.0);
  glm::dvec4 fisheye_k{0.0};

  // The name of the object that carries the camera; empty: none. The eye is then not at eye_m but
  // at an offset from the object's origin, and all directions are given in the object's axes in
  // place of the world's. No velocity, no path.
  std::string mount{};
  glm::dvec3 mount_offset_m{0.0};  // right, ahead, up

  // For how long from a picture's time on its shutter is open, and how many moments of that time,
  // evenly spread, are drawn.
  double exposure_s = 0.0;
  int shutter_samples = 1;
  SensorNoise noise{};
  // The focal length over the diameter of the opening, with which exposure_s and noise.iso expose
  // the picture; 0: it is exposed as the sky says.
  double f_number = 0.0;
};

// What multiplies luminance [10 000 cd/m^2] where a camera exposes the picture, its lens without
// losses: with f_number and iso over 0 and exposure_s >= 0. Luminance L gives the sensor
// H = (pi / 4) L exposure_s / f_number^2 lux seconds, and 10 / iso of these are shown as 118 of
// 255, which is display light 0.18. Source: ISO 12232, 2019, standard output sensitivity.
double camera_exposure(double f_number, double exposure_s, double iso);

// The lens for a picture of at least 1 x 1 pixels.
Lens camera_lens(const Camera& camera, int width_px, int height_px);

// The projection likewise.
Projection camera_projection(const Camera& camera, int width_px, int height_px);

// The view at time t_s [s] (finite; taken as 1e12 beyond that) of a picture of at least 1 x 1
// pixels. The eye stays within 1e7 m of the origin along each axis. Not of mounted cameras.
View camera_view(const Camera& camera, double t_s, int width_px, int height_px);

// The view of a mounted camera from the pose of its object at that time.
View mounted_view(const Camera& camera, const ObjectPose& object, double t_s, int width_px,
                  int height_px);

// The object that carries the scene's camera; null: none, or none of its name.
const FloatingObject* camera_mount(const Scene& scene);

// The view of the scene's camera, mounted or not. `surface` is the scene's water at time t_s, which
// carries the object; with Triangulation::kPlane objects stay at the mean level, as they are drawn.
View camera_view(const Scene& scene, const ocean::WaterSurface& surface, double t_s, int width_px,
                 int height_px);

}  // namespace swell::scene
