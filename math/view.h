// A camera: where it is, which pixels look where, what it can see.
//
// Positions are relative to the eye ("rel": world axes, metres, origin at the eye), so that float
// keeps millimetres far from the world's origin. Clip space is reversed-Z with the far plane at
// infinity: z_clip = near_m, w_clip = depth along the view axis, depth buffer value near_m / w in
// (0, 1], 0 = infinitely far. Window x goes right, y down; pixel centres lie at +0.5.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/glm.hpp>

namespace swell {

// A camera's matrix K in pixels: a pinhole camera shows a point at x right, y down and z ahead at
// (fx x / z + cx, fy y / z + cy) in the window, whose upper left corner is (0, 0). Where the middle
// of the first pixel is (0, 0), as OpenCV has it, cx and cy are less by 0.5 than here.
struct Intrinsics {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  bool operator==(const Intrinsics&) const = default;
};

enum class ProjectionKind : std::uint8_t {
  kPerspective,      // a pinhole camera: View has its tangents
  kFisheye,          // Kannala and Brandt's lens
  kEquirectangular,  // all directions: longitude across, latitude from pole to pole down
};

// How a picture shows directions. A fisheye shows what is at the angle theta from the axis at
// theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8) focal lengths from the principal
// point.
// Source: Kannala, Brandt, A generic camera model and calibration method for conventional,
// wide-angle, and fish-eye lenses, 2006, eq. 6, with OpenCV's names (cv::fisheye).
struct Projection {
  ProjectionKind kind = ProjectionKind::kPerspective;
  // These are for fisheyes.
  Intrinsics k{};
  std::array<double, 4> bend{};  // k1 to k4
  double half_fov_rad = 0.0;     // what lies further from the axis is not shown, (0, pi]

  bool is_wide() const { return kind != ProjectionKind::kPerspective; }
  bool operator==(const Projection&) const = default;
};

struct View {
  int width_px = 0, height_px = 0;
  glm::dvec3 eye_world{0.0};
  // Unit vectors in world axes, up = right x forward.
  glm::vec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  // Tangents of the angles from the axis, to the right and up: the window reaches from middle -
  // half to middle + half. The middle is not 0 where the axis does not go through the window's
  // middle.
  float tan_half_x = 1.0f, tan_half_y = 1.0f;
  float tan_middle_x = 0.0f, tan_middle_y = 0.0f;
  float near_m = 0.1f;
  glm::mat4 clip_from_rel{1.0f};
  // Of a wide picture, which is drawn as several perspective ones, only the eye, the axes, the size
  // and near_m count besides its projection.
  Projection projection{};
  // Where the view is a part of a larger picture: the height that counts as that of a picture for
  // what is given in picture heights; 0: its own.
  float whole_height_px = 0.0f;

  float picture_height_px() const {
    return whole_height_px > 0.0f ? whole_height_px : static_cast<float>(height_px);
  }

  // The direction through window point (x_px, y_px), scaled so that its depth (component along
  // forward) is 1: p_rel = depth * ray.
  glm::vec3 ray(float x_px, float y_px) const {
    const float x_ndc = 2.0f * x_px / static_cast<float>(width_px) - 1.0f;
    const float y_ndc = 1.0f - 2.0f * y_px / static_cast<float>(height_px);
    return forward + right * (x_ndc * tan_half_x + tan_middle_x) +
           up * (y_ndc * tan_half_y + tan_middle_y);
  }
};

// Builds a view from eye_world [m], heading_rad (clockwise from north), pitch_rad (up positive,
// in [-pi/2, pi/2]), fov_y_rad in (0, pi), near_m > 0 and a size of at least 1 x 1.
View make_view(glm::dvec3 eye_world, double heading_rad, double pitch_rad, double fov_y_rad,
               float near_m, int width_px, int height_px);

// The half-spaces dot(n, p_rel) + w >= 0 that enclose what the view sees: left, right, bottom,
// top, near. Unit normals.
std::array<glm::vec4, 5> frustum_planes(const View& view);

// --- Views from their parts

// Which way a camera looks, as columns: unit right, ahead and up, right-handed. They are given in
// the world's axes (east, north, up), or in those of what carries the camera.

// The axes of a camera with a heading and a pitch as above, which is then turned about the line it
// looks along by roll_rad: positive lowers its right side, so that the horizon rises on the right.
glm::dmat3 camera_axes(double heading_rad, double pitch_rad, double roll_rad);

// The axes from a rotation that takes the optical frame of robotics and computer vision (x to the
// right of the picture, y down, z ahead) to the world (east, north, up). The quaternion is taken at
// its direction, and not 0. The identity looks straight up, with south at the picture's top.
glm::dmat3 camera_axes(const glm::dquat& world_from_optical);

// What a camera of one picture size sees, in tangents (View).
struct Lens {
  double tan_half_x = 1.0, tan_half_y = 1.0;
  double tan_middle_x = 0.0, tan_middle_y = 0.0;
};

// The lens whose window spans fov_y_rad in (0, pi) from edge to edge, with square pixels.
Lens lens_of_fov(double fov_y_rad, int width_px, int height_px);

// The lens of a picture of that size; fx and fy > 0.
Lens lens_of_intrinsics(const Intrinsics& k, int width_px, int height_px);

// Builds a view from eye_world [m], axes, a lens for the size, near_m > 0 and a size.
View make_view(glm::dvec3 eye_world, const glm::dmat3& world_from_camera, const Lens& lens,
               float near_m, int width_px, int height_px);

// Builds a view from a pose of the optical frame and K, else as above.
View make_view(glm::dvec3 eye_world, const glm::dquat& world_from_optical, const Intrinsics& k,
               float near_m, int width_px, int height_px);

// Where a view stands, in the words of robotics: the inverse of the function above, to the
// precision of the view's floats (2e-7).
struct OpticalPose {
  glm::dvec3 eye_world{0.0};
  glm::dquat world_from_optical{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; unit, w >= 0
  Intrinsics k;
};
OpticalPose camera_pose(const View& view);

}  // namespace swell
