// Messages of ROS 2 as plain structs, with the fields of its public definitions (as the
// distribution Humble has them). Lengths are in metres, angles in radians, axes as REP 103 has
// them, frames as REP 105. fields() gives a struct's fields in the order of its definition, which
// is that of its bytes.
//
// One more message is a struct here, its name in Message and its definition in definitions.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace swell::apps::msg {

// ---- builtin_interfaces, std_msgs

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;  // [0, 1e9)

  // Of a time from 0 to 2^31 s.
  static Time of_ns(std::int64_t t_ns) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    return {static_cast<std::int32_t>(t_ns / kSecond_ns),
            static_cast<std::uint32_t>(t_ns % kSecond_ns)};
  }
  auto fields() const { return std::tie(sec, nanosec); }
};

struct Header {
  Time stamp;
  std::string frame_id;
  auto fields() const { return std::tie(stamp, frame_id); }
};

// ---- geometry_msgs

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
  auto fields() const { return std::tie(x, y, z); }
};

using Point = Vector3;  // of the same fields

struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  auto fields() const { return std::tie(x, y, z, w); }
};

struct Pose {
  Point position;
  Quaternion orientation;
  auto fields() const { return std::tie(position, orientation); }
};

struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};  // 0: not known
  auto fields() const { return std::tie(pose, covariance); }
};

struct Twist {
  Vector3 linear, angular;
  auto fields() const { return std::tie(linear, angular); }
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};  // 0: not known
  auto fields() const { return std::tie(twist, covariance); }
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;
  auto fields() const { return std::tie(translation, rotation); }
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  auto fields() const { return std::tie(header, child_frame_id, transform); }
};

struct PointStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PointStamped";
  Header header;
  Point point;
  auto fields() const { return std::tie(header, point); }
};

struct PoseStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  Header header;
  Pose pose;
  auto fields() const { return std::tie(header, pose); }
};

// ---- sensor_msgs

// `step` bytes a row, rows from the top.
struct Image {
  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;  // "rgb8", "32FC1", "16UC1", ...
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;
  auto fields() const {
    return std::tie(header, height, width, encoding, is_bigendian, step, data);
  }
};

// An image as an encoder has it: what image_transport publishes beside the image's topic.
struct CompressedImage {
  static constexpr std::string_view kType = "sensor_msgs/msg/CompressedImage";
  Header header;
  std::string format;  // "rgb8; jpeg compressed bgr8"
  std::vector<std::uint8_t> data;
  auto fields() const { return std::tie(header, format, data); }
};

struct RegionOfInterest {  // zeros: all of the picture
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
  auto fields() const { return std::tie(x_offset, y_offset, height, width, do_rectify); }
};

struct CameraInfo {
  static constexpr std::string_view kType = "sensor_msgs/msg/CameraInfo";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;    // "plumb_bob"
  std::vector<double> d;           // k1, k2, p1, p2, k3
  std::array<double, 9> k{}, r{};  // the middle of the first pixel is (0, 0)
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;
  auto fields() const {
    return std::tie(header, height, width, distortion_model, d, k, r, p, binning_x, binning_y, roi);
  }
};

struct PointField {
  static constexpr std::uint8_t kUint16 = 4, kUint32 = 6, kFloat32 = 7;
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = kFloat32;
  std::uint32_t count = 1;
  auto fields() const { return std::tie(name, offset, datatype, count); }
};

struct PointCloud2 {
  static constexpr std::string_view kType = "sensor_msgs/msg/PointCloud2";
  Header header;
  std::uint32_t height = 1, width = 0;
  std::vector<PointField> point_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = true;
  auto fields() const {
    return std::tie(header, height, width, point_fields, is_bigendian, point_step, row_step, data,
                    is_dense);
  }
};

// The acceleration is what an accelerometer shows: at rest gravity upwards (REP 145).
struct Imu {
  static constexpr std::string_view kType = "sensor_msgs/msg/Imu";
  using Covariance = std::array<double, 9>;  // 0: not known
  Header header;
  Quaternion orientation;
  Covariance orientation_covariance{};
  Vector3 angular_velocity;
  Covariance angular_velocity_covariance{};
  Vector3 linear_acceleration;
  Covariance linear_acceleration_covariance{};
  auto fields() const {
    return std::tie(header, orientation, orientation_covariance, angular_velocity,
                    angular_velocity_covariance, linear_acceleration,
                    linear_acceleration_covariance);
  }
};

struct NavSatStatus {
  std::int8_t status = 0;     // a fix
  std::uint16_t service = 1;  // GPS
  auto fields() const { return std::tie(status, service); }
};

struct NavSatFix {
  static constexpr std::string_view kType = "sensor_msgs/msg/NavSatFix";
  Header header;
  NavSatStatus status;
  double latitude = 0.0, longitude = 0.0;  // degrees
  double altitude = 0.0;                   // over WGS 84's ellipsoid
  std::array<double, 9> position_covariance{};
  std::uint8_t position_covariance_type = 0;  // not known
  auto fields() const {
    return std::tie(header, status, latitude, longitude, altitude, position_covariance,
                    position_covariance_type);
  }
};

// The range is +infinity where nothing is met, -infinity where it is nearer than min_range (REP
// 117).
struct Range {
  static constexpr std::string_view kType = "sensor_msgs/msg/Range";
  static constexpr std::uint8_t kUltrasound = 0, kInfrared = 1;
  Header header;
  std::uint8_t radiation_type = kUltrasound;
  float field_of_view = 0.0f, min_range = 0.0f, max_range = 0.0f, range = 0.0f;
  auto fields() const {
    return std::tie(header, radiation_type, field_of_view, min_range, max_range, range);
  }
};

// ---- nav_msgs, tf2_msgs, rosgraph_msgs

struct Odometry {  // the twist is in the child's frame
  static constexpr std::string_view kType = "nav_msgs/msg/Odometry";
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  auto fields() const { return std::tie(header, child_frame_id, pose, twist); }
};

struct TFMessage {
  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  auto fields() const { return std::tie(transforms); }
};

struct Clock {
  static constexpr std::string_view kType = "rosgraph_msgs/msg/Clock";
  Time clock;
  auto fields() const { return std::tie(clock); }
};

// What a topic may carry.
using Message = std::variant<Image, CompressedImage, CameraInfo, PointCloud2, Imu, NavSatFix, Range,
                             PointStamped, PoseStamped, Odometry, TFMessage, Clock>;

}  // namespace swell::apps::msg
