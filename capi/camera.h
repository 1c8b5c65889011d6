// Cameras and poses of swell.h as the library has them.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "capi/handles.h"
#include "scene/objects.h"

namespace swell::capi {

struct PictureSize {
  int width_px = 0, height_px = 0;
};

// Throws ArgumentError.
PictureSize checked_size(int32_t width_px, int32_t height_px);
void check_time(double t_s);

// The view of a picture. Throws ArgumentError.
View view_of(const swell_camera* camera, const char* name, PictureSize size);

// A view's camera; of the scene's, to the precision of the view's floats.
swell_camera camera_of(const View& view);

// A quaternion's direction. Throws ArgumentError.
glm::dquat unit_quaternion(const double (&wxyz)[4], const char* name);

// The caller's poses. Throws ArgumentError.
std::vector<scene::GivenPose> given_poses(const swell_pose* poses, std::size_t count,
                                          std::size_t objects, const char* name);

swell_pose pose_of(std::size_t object, const scene::ObjectPose& pose);

}  // namespace swell::capi
