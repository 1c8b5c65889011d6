// A simulation's messages on Gazebo's transport, and services that answer for its water.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "apps/messages/message_output.h"
#include "scene/water.h"

namespace swell::apps {

// What swell-sim --rig-keys says of it.
inline constexpr const char* kGazeboText = R"(
Gazebo's transport (--gazebo on): to whom, IGN_PARTITION and IGN_IP say, GZ_ from version 13 on. It
runs in real time until it is ended, but for --clock input and --duration
  /NAME/image                 Image of a camera, RGB_INT8, unless raw = false; none is compressed
  /NAME/depth_image           Image, R_FLOAT32: metres along the view axis
  /NAME/semantic/labels_map   Image as of a segmentation camera: each byte of a pixel is the class
  /NAME/panoptic/labels_map   likewise: the id's low byte, its high byte, the class
  /NAME/camera_info           CameraInfo
  /NAME                       IMU; NavSat; Odometry; Pose; LaserScan of one beam of an altimeter or
                              echo sounder; Vector3d of a wave probe: the place on the surface
  /clock, /tf, /tf_static     Clock; Pose_V with frame_id and child_frame_id in the headers, the
                              last one again in each second
  what lidars publish has the names that ROS has; PointCloudPacked
It answers, at the stamp of the request's header or at the present time:
  /water/heights              Pose_V of at most 100000 poses with x and y -> Pose_V with z of the
                              surface and the turn of up onto its normal
  /water/sea_state            Empty -> Param: heights in m, periods in s, degrees that waves and
                              wind come from
and, without --inputs, takes
  /clock                      Clock, with --clock input: sim
  /model/FRAME/pose           Pose or Pose_V of a body with pose = "input", by its frame as name, or
                              without one; --gazebo-poses TOPIC: all there, by name
)";

// Throws OptionError where the program was built without such a transport.
void check_gazebo();

// Topics and messages as apps/gazebo/convert.h has them; a topic whose messages Gazebo has no
// counterpart of is left out. Where nobody listens to a topic, its messages are not converted. A
// kept topic's last message is published again in each second of the stamps: the transport keeps
// none. What is not sent in time is dropped by the transport, which holds IGN_TRANSPORT_SNDHWM
// (1000) messages for each listener. Used by one thread at a time.
class GazeboOutput : public MessageOutput {
 public:
  // Throws OptionError for a name that the transport does not take; without one, as check_gazebo().
  GazeboOutput(std::span<const Topic> topics, const scene::Water& water);
  ~GazeboOutput() override;
  GazeboOutput(const GazeboOutput&) = delete;
  GazeboOutput& operator=(const GazeboOutput&) = delete;

  // Who can hear it, a line.
  std::string audience() const;

  void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) override;

  // Leaves the transport half a second for what it still has, if somebody listens.
  void finish() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swell::apps
