// Gazebo's messages and transport by one name each: up to Fortress they are Ignition's.
#pragma once

#ifdef SWELL_IGNITION
#include <ignition/msgs/camera_info.pb.h>
#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/empty.pb.h>
#include <ignition/msgs/image.pb.h>
#include <ignition/msgs/imu.pb.h>
#include <ignition/msgs/laserscan.pb.h>
#include <ignition/msgs/navsat.pb.h>
#include <ignition/msgs/odometry.pb.h>
#include <ignition/msgs/param.pb.h>
#include <ignition/msgs/pointcloud_packed.pb.h>
#include <ignition/msgs/pose.pb.h>
#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/vector3d.pb.h>

#include <ignition/transport/NetUtils.hh>
#include <ignition/transport/Node.hh>

namespace swell::apps {
namespace gz_msgs = ignition::msgs;
namespace gz_transport = ignition::transport;
inline constexpr const char *kGazeboIp = "IGN_IP", *kGazeboPartition = "IGN_PARTITION";
}  // namespace swell::apps
#else
#include <gz/msgs/camera_info.pb.h>
#include <gz/msgs/clock.pb.h>
#include <gz/msgs/empty.pb.h>
#include <gz/msgs/image.pb.h>
#include <gz/msgs/imu.pb.h>
#include <gz/msgs/laserscan.pb.h>
#include <gz/msgs/navsat.pb.h>
#include <gz/msgs/odometry.pb.h>
#include <gz/msgs/param.pb.h>
#include <gz/msgs/pointcloud_packed.pb.h>
#include <gz/msgs/pose.pb.h>
#include <gz/msgs/pose_v.pb.h>
#include <gz/msgs/vector3d.pb.h>

#include <gz/transport/NetUtils.hh>
#include <gz/transport/Node.hh>

namespace swell::apps {
namespace gz_msgs = gz::msgs;
namespace gz_transport = gz::transport;
inline constexpr const char *kGazeboIp = "GZ_IP", *kGazeboPartition = "GZ_PARTITION";
}  // namespace swell::apps
#endif
