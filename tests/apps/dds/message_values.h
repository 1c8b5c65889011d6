// The values of the messages that idlc made of ros2_messages.idl: what a message says, as bytes
// that another reader can make of it too: numbers as doubles, texts and arrays of octets as they
// are.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "ros2_messages.h"

namespace swell::dds_test {

class Values {
 public:
  const std::vector<unsigned char>& bytes() const { return bytes_; }

  void add(double number) {
    unsigned char its[sizeof number];
    std::memcpy(its, &number, sizeof number);
    bytes_.insert(bytes_.end(), its, its + sizeof number);
  }
  void add(const char* text) { bytes_.insert(bytes_.end(), text, text + std::strlen(text)); }
  void add(const dds_sequence_octet& octets) {
    bytes_.insert(bytes_.end(), octets._buffer, octets._buffer + octets._length);
  }
  template <std::size_t kSize>
  void add(const double (&numbers)[kSize]) {
    for (const double number : numbers) add(number);
  }
  template <class... Fields>
  void add_all(const Fields&... fields) {
    (add(fields), ...);
  }

  // ---- builtin_interfaces, std_msgs, geometry_msgs
  void add(const builtin_interfaces_msg_dds__Time_& m) { add_all(m.sec, m.nanosec); }
  void add(const std_msgs_msg_dds__Header_& m) { add_all(m.stamp, m.frame_id); }
  void add(const geometry_msgs_msg_dds__Vector3_& m) { add_all(m.x, m.y, m.z); }
  void add(const geometry_msgs_msg_dds__Point_& m) { add_all(m.x, m.y, m.z); }
  void add(const geometry_msgs_msg_dds__Quaternion_& m) { add_all(m.x, m.y, m.z, m.w); }
  void add(const geometry_msgs_msg_dds__Pose_& m) { add_all(m.position, m.orientation); }
  void add(const geometry_msgs_msg_dds__Twist_& m) { add_all(m.linear, m.angular); }
  void add(const geometry_msgs_msg_dds__PoseWithCovariance_& m) { add_all(m.pose, m.covariance); }
  void add(const geometry_msgs_msg_dds__TwistWithCovariance_& m) { add_all(m.twist, m.covariance); }
  void add(const geometry_msgs_msg_dds__Transform_& m) { add_all(m.translation, m.rotation); }
  void add(const geometry_msgs_msg_dds__TransformStamped_& m) {
    add_all(m.header, m.child_frame_id, m.transform);
  }
  void add(const geometry_msgs_msg_dds__PointStamped_& m) { add_all(m.header, m.point); }
  void add(const geometry_msgs_msg_dds__PoseStamped_& m) { add_all(m.header, m.pose); }

  // ---- sensor_msgs
  void add(const sensor_msgs_msg_dds__Image_& m) {
    add_all(m.header, m.height, m.width, m.encoding, m.is_bigendian, m.step, m.data);
  }
  void add(const sensor_msgs_msg_dds__CompressedImage_& m) { add_all(m.header, m.format, m.data); }
  void add(const sensor_msgs_msg_dds__RegionOfInterest_& m) {
    add_all(m.x_offset, m.y_offset, m.height, m.width, m.do_rectify);
  }
  void add(const sensor_msgs_msg_dds__CameraInfo_& m) {
    add_all(m.header, m.height, m.width, m.distortion_model);
    for (std::uint32_t n = 0; n < m.d._length; ++n) add(m.d._buffer[n]);
    add_all(m.k, m.r, m.p, m.binning_x, m.binning_y, m.roi);
  }
  void add(const sensor_msgs_msg_dds__PointField_& m) {
    add_all(m.name, m.offset, m.datatype, m.count);
  }
  void add(const sensor_msgs_msg_dds__PointCloud2_& m) {
    add_all(m.header, m.height, m.width);
    for (std::uint32_t n = 0; n < m.fields._length; ++n) add(m.fields._buffer[n]);
    add_all(m.is_bigendian, m.point_step, m.row_step, m.data, m.is_dense);
  }
  void add(const sensor_msgs_msg_dds__Imu_& m) {
    add_all(m.header, m.orientation, m.orientation_covariance, m.angular_velocity,
            m.angular_velocity_covariance, m.linear_acceleration, m.linear_acceleration_covariance);
  }
  void add(const sensor_msgs_msg_dds__NavSatStatus_& m) { add_all(m.status, m.service); }
  void add(const sensor_msgs_msg_dds__NavSatFix_& m) {
    add_all(m.header, m.status, m.latitude, m.longitude, m.altitude, m.position_covariance,
            m.position_covariance_type);
  }
  void add(const sensor_msgs_msg_dds__Range_& m) {
    add_all(m.header, m.radiation_type, m.field_of_view, m.min_range, m.max_range, m.range);
  }

  // ---- nav_msgs, tf2_msgs, rosgraph_msgs
  void add(const nav_msgs_msg_dds__Odometry_& m) {
    add_all(m.header, m.child_frame_id, m.pose, m.twist);
  }
  void add(const tf2_msgs_msg_dds__TFMessage_& m) {
    for (std::uint32_t n = 0; n < m.transforms._length; ++n) add(m.transforms._buffer[n]);
  }
  void add(const rosgraph_msgs_msg_dds__Clock_& m) { add(m.clock); }

 private:
  std::vector<unsigned char> bytes_;
};

inline std::int64_t ns_of(const builtin_interfaces_msg_dds__Time_& time) {
  return std::int64_t{time.sec} * 1'000'000'000 + time.nanosec;
}

template <class Message>
std::int64_t stamp_ns(const Message& message) {
  return ns_of(message.header.stamp);
}
inline std::int64_t stamp_ns(const rosgraph_msgs_msg_dds__Clock_& m) { return ns_of(m.clock); }
inline std::int64_t stamp_ns(const tf2_msgs_msg_dds__TFMessage_& m) {
  return m.transforms._length > 0 ? ns_of(m.transforms._buffer[0].header.stamp) : 0;
}

}  // namespace swell::dds_test
