// Gazebo's transport and messages by one name; up to Fortress they are Ignition's.
#pragma once

#include <cstdint>

#ifdef IGNITION
#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/image.pb.h>
#include <ignition/msgs/pointcloud_packed.pb.h>
#include <ignition/msgs/pose.pb.h>
#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/vector3d.pb.h>

#include <ignition/transport/Node.hh>
namespace msgs = ignition::msgs;
namespace transport = ignition::transport;
#else
#include <gz/msgs/clock.pb.h>
#include <gz/msgs/image.pb.h>
#include <gz/msgs/pointcloud_packed.pb.h>
#include <gz/msgs/pose.pb.h>
#include <gz/msgs/pose_v.pb.h>
#include <gz/msgs/vector3d.pb.h>

#include <gz/transport/Node.hh>
namespace msgs = gz::msgs;
namespace transport = gz::transport;
#endif

inline std::int64_t ns_of(const msgs::Time& time) {
  return time.sec() * 1'000'000'000 + time.nsec();
}
inline void set_time(std::int64_t t_ns, msgs::Time* time) {
  time->set_sec(t_ns / 1'000'000'000);
  time->set_nsec(static_cast<std::int32_t>(t_ns % 1'000'000'000));
}
