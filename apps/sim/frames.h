// Where bodies and sensors are: frames of ROS, as rigs have them (scene/file/rig.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "apps/messages/messages.h"
#include "scene/file/rig.h"
#include "scene/objects.h"

namespace swell::apps {

// A frame in another one: where its origin lies, and its unit axes x, y, z as columns.
struct FramePose {
  glm::dvec3 position_m{0.0};
  glm::dmat3 axes{1.0};
};

// A frame that is given in `inner`, which is given in `outer`.
FramePose operator*(const FramePose& outer, const FramePose& inner);

// Of a thing that points along a heading as scenes have it: x ahead, y left, z up.
FramePose heading_pose(const scene::Waypoint& at);
FramePose object_frame(const scene::ObjectPose& object);
scene::ObjectPose frame_object(const FramePose& frame);  // the other way

// Of a sensor in its body's frame, or in "map".
FramePose mounting(const scene::Sensor& sensor);

// Of the optical frame (x right, y down, z ahead) in a camera's frame.
FramePose optical_frame();

// How a frame moves, from its poses a time h before, at and after a moment.
struct FrameMotion {
  glm::dvec3 velocity_mps{0.0}, acceleration_mps2{0.0};  // of its origin, in the outer axes
  glm::dvec3 turn_rad_s{0.0};                            // in its own axes
};
FrameMotion motion_between(const FramePose& before, const FramePose& now, const FramePose& after,
                           double h_s);

// As it moves at `now`, from it and its poses a time h and 2 h before. The acceleration is that of
// h before.
FrameMotion motion_behind(const FramePose& before_2h, const FramePose& before_h,
                          const FramePose& now, double h_s);

// A time h: 0.2 % off in a wave of 3 s, and heights' last bits give less than 0.001 m/s^2. A
// multiple of common periods, whose water is there already.
inline constexpr std::int64_t kMotionStep_ns = 40'000'000;

// Their words in messages.
msg::Vector3 vector_message(const glm::dvec3& v);
msg::Quaternion quaternion_message(const glm::dmat3& axes);
msg::Pose pose_message(const FramePose& pose);
msg::TransformStamped transform_message(msg::Time stamp, const std::string& parent,
                                        const std::string& child, const FramePose& pose);

}  // namespace swell::apps
