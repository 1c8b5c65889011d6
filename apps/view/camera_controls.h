// Flying: the next pose from the last one, what is held down and the time passed. Knows nothing
// of keys or windows.
#pragma once

#include <glm/glm.hpp>

#include "math/view.h"

namespace swell::view {

struct CameraPose {
  glm::dvec3 eye_m{0.0};     // world
  double heading_rad = 0.0;  // clockwise from north, [0, 2 pi)
  double pitch_rad = 0.0;    // up positive, within kPitchLimit_rad of 0
  double roll_rad = 0.0;     // positive lowers the right side; no flight changes it
};

// Looking straight up or down would leave no heading to turn about.
inline constexpr double kPitchLimit_rad = 1.55;

struct CameraInput {
  bool forward = false, back = false, left = false, right = false, up = false, down = false;
  bool fast = false;
  double look_x_px = 0.0, look_y_px = 0.0;  // mouse motion since the last frame, y down
};

// True if the input asks for no motion.
bool is_idle(const CameraInput& input);

// The pose dt_s >= 0 seconds later. Forward goes where the camera looks, up and down go along
// world z; opposite keys cancel and a diagonal is no faster than a straight line. The speed grows
// with the height above the mean sea. Steps over 0.1 s count as 0.1 s, so that a stall does not
// throw the camera away. The eye stays within 1e6 m of the origin along each axis, as in scenes.
CameraPose fly(const CameraPose& pose, const CameraInput& input, double dt_s);

// The pose of a view. One that looks nearer to straight up or down than kPitchLimit_rad is taken
// from there to the limit, with the same heading.
CameraPose pose_of(const View& view);

}  // namespace swell::view
