// Messages of ROS as those that Gazebo's own sensors publish.
//
//   ROS                                              Gazebo
//   sensor_msgs Image, CameraInfo, PointCloud2, Imu  Image, CameraInfo, PointCloudPacked, IMU
//   sensor_msgs NavSatFix, Range                     NavSat, LaserScan of one beam
//   geometry_msgs PoseStamped, PointStamped          Pose, Vector3d
//   nav_msgs Odometry, tf2_msgs TFMessage            Odometry, Pose_V
//   rosgraph_msgs Clock                              Clock with the time in sim
//
// As ros_gz_bridge has them, frames are the keys "frame_id" and "child_frame_id" of headers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "apps/gazebo/names.h"
#include "apps/messages/message_output.h"

namespace swell::apps {

using GazeboMessage = google::protobuf::Message;

// Empty, of the type that carries a type of ROS ("sensor_msgs/msg/Image"); null: Gazebo has none.
std::unique_ptr<GazeboMessage> gazebo_message(std::string_view ros_type);

// `to` is what gazebo_message() gives for the message's type; what it held is forgotten.
void convert(const msg::Message& from, GazeboMessage& to);

// In nanoseconds, and back; none: not from 0 to 2^31 s.
std::optional<std::int64_t> time_ns(const gz_msgs::Time& time);
void set_time(std::int64_t t_ns, gz_msgs::Time& to);

enum class ImageUse : std::uint8_t { kPicture, kClasses, kIds };

struct GazeboTopic {
  std::string name;
  ImageUse use = ImageUse::kPicture;  // of an image's topic
};

// What a topic is called where Gazebo's sensors publish the same: below a camera's name image,
// depth_image, semantic/labels_map (of classes) and panoptic/labels_map (of ids), and an IMU's and
// a GNSS receiver's name alone.
GazeboTopic gazebo_topic(const Topic& topic);

// The maps of Gazebo's segmentation camera, 3 bytes a pixel. Semantic: the class three times.
// Panoptic: the id's low byte, its high byte, the class, which is 0 without `classes`, a picture of
// the same size. A class over 255 is 255, an id over 65535 is 65535.
void convert_classes(const msg::Image& classes, gz_msgs::Image& to);
void convert_ids(const msg::Image& ids, const msg::Image* classes, gz_msgs::Image& to);

}  // namespace swell::apps
