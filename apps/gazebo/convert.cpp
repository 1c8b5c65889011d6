#include "apps/gazebo/convert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <variant>

#include "math/check.h"

namespace swell::apps {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// ---- Parts

void fill(const msg::Time& from, gz_msgs::Time& to) {
  to.set_sec(from.sec);
  to.set_nsec(static_cast<std::int32_t>(from.nanosec));
}

void add_frame(const char* key, const std::string& frame, gz_msgs::Header& to) {
  auto& entry = *to.add_data();
  entry.set_key(key);
  entry.add_value(frame);
}

void fill(const msg::Header& from, gz_msgs::Header& to) {
  fill(from.stamp, *to.mutable_stamp());
  add_frame("frame_id", from.frame_id, to);
}

void fill(const msg::Vector3& from, gz_msgs::Vector3d& to) {
  to.set_x(from.x);
  to.set_y(from.y);
  to.set_z(from.z);
}

void fill(const msg::Quaternion& from, gz_msgs::Quaternion& to) {
  to.set_x(from.x);
  to.set_y(from.y);
  to.set_z(from.z);
  to.set_w(from.w);
}

void fill(const msg::Pose& from, gz_msgs::Pose& to) {
  fill(from.position, *to.mutable_position());
  fill(from.orientation, *to.mutable_orientation());
}

template <class Numbers, class Repeated>
void fill_numbers(const Numbers& from, Repeated& to) {
  to.Assign(from.begin(), from.end());
}

// ---- Messages

// All but the pixels.
void fill_image_head(const msg::Image& from, gz_msgs::PixelFormatType format, std::uint32_t step,
                     gz_msgs::Image& to) {
  fill(from.header, *to.mutable_header());
  to.set_width(from.width);
  to.set_height(from.height);
  to.set_step(step);
  to.set_pixel_format_type(format);
}

struct Encoding {
  std::string_view name;
  gz_msgs::PixelFormatType format;
};
constexpr auto kEncodings = std::to_array<Encoding>({
    {"rgb8", gz_msgs::RGB_INT8},
    {"32FC1", gz_msgs::R_FLOAT32},
    {"16UC1", gz_msgs::L_INT16},
    {"mono8", gz_msgs::L_INT8},
});

void fill_image(const msg::Image& from, gz_msgs::Image& to) {
  const auto* found = std::ranges::find(kEncodings, from.encoding, &Encoding::name);
  const bool is_known = found != kEncodings.end();
  fill_image_head(from, is_known ? found->format : gz_msgs::UNKNOWN_PIXEL_FORMAT, from.step, to);
  to.mutable_data()->assign(from.data.begin(), from.data.end());
}

struct LensModel {
  std::string_view name;
  gz_msgs::CameraInfo::Distortion::DistortionModelType model;
};
constexpr auto kLensModels = std::to_array<LensModel>({
    {"plumb_bob", gz_msgs::CameraInfo::Distortion::PLUMB_BOB},
    {"rational_polynomial", gz_msgs::CameraInfo::Distortion::RATIONAL_POLYNOMIAL},
    {"equidistant", gz_msgs::CameraInfo::Distortion::EQUIDISTANT},
});

// A lens that Gazebo has no model of leaves the distortion out.
void fill_camera_info(const msg::CameraInfo& from, gz_msgs::CameraInfo& to) {
  fill(from.header, *to.mutable_header());
  to.set_width(from.width);
  to.set_height(from.height);
  const auto* lens = std::ranges::find(kLensModels, from.distortion_model, &LensModel::name);
  if (lens != kLensModels.end()) {
    to.mutable_distortion()->set_model(lens->model);
    fill_numbers(from.d, *to.mutable_distortion()->mutable_k());
  }
  fill_numbers(from.k, *to.mutable_intrinsics()->mutable_k());
  fill_numbers(from.p, *to.mutable_projection()->mutable_p());
  fill_numbers(from.r, *to.mutable_rectification_matrix());
}

void fill_cloud(const msg::PointCloud2& from, gz_msgs::PointCloudPacked& to) {
  fill(from.header, *to.mutable_header());
  for (const msg::PointField& field : from.point_fields) {
    auto& added = *to.add_field();
    added.set_name(field.name);
    added.set_offset(field.offset);
    // The same types in the same order, but from 0 on instead of 1.
    added.set_datatype(static_cast<gz_msgs::PointCloudPacked::Field::DataType>(field.datatype - 1));
    added.set_count(field.count);
  }
  to.set_height(from.height);
  to.set_width(from.width);
  to.set_is_bigendian(from.is_bigendian);
  to.set_point_step(from.point_step);
  to.set_row_step(from.row_step);
  to.mutable_data()->assign(from.data.begin(), from.data.end());
  to.set_is_dense(from.is_dense);
}

void fill_imu(const msg::Imu& from, gz_msgs::IMU& to) {
  fill(from.header, *to.mutable_header());
  to.set_entity_name(from.header.frame_id);
  fill(from.orientation, *to.mutable_orientation());
  fill(from.angular_velocity, *to.mutable_angular_velocity());
  fill(from.linear_acceleration, *to.mutable_linear_acceleration());
}

void fill_navsat(const msg::NavSatFix& from, gz_msgs::NavSat& to) {
  fill(from.header, *to.mutable_header());
  to.set_latitude_deg(from.latitude);
  to.set_longitude_deg(from.longitude);
  to.set_altitude(from.altitude);
  to.set_frame_id(from.header.frame_id);
}

// A beam along x, as a lidar with one sample has it; readers expect an intensity a range.
void fill_scan(const msg::Range& from, gz_msgs::LaserScan& to) {
  fill(from.header, *to.mutable_header());
  to.set_frame(from.header.frame_id);
  to.set_range_min(static_cast<double>(from.min_range));
  to.set_range_max(static_cast<double>(from.max_range));
  to.set_count(1);
  to.set_vertical_count(1);
  to.add_ranges(static_cast<double>(from.range));
  to.add_intensities(0.0);
}

void fill_point(const msg::PointStamped& from, gz_msgs::Vector3d& to) {
  fill(from.header, *to.mutable_header());
  fill(from.point, to);
}

void fill_pose(const msg::PoseStamped& from, gz_msgs::Pose& to) {
  fill(from.header, *to.mutable_header());
  fill(from.pose, to);
}

void fill_odometry(const msg::Odometry& from, gz_msgs::Odometry& to) {
  fill(from.header, *to.mutable_header());
  add_frame("child_frame_id", from.child_frame_id, *to.mutable_header());
  fill(from.pose.pose, *to.mutable_pose());
  fill(from.twist.twist.linear, *to.mutable_twist()->mutable_linear());
  fill(from.twist.twist.angular, *to.mutable_twist()->mutable_angular());
}

void fill_transforms(const msg::TFMessage& from, gz_msgs::Pose_V& to) {
  if (!from.transforms.empty())
    fill(from.transforms.front().header.stamp, *to.mutable_header()->mutable_stamp());
  for (const msg::TransformStamped& transform : from.transforms) {
    gz_msgs::Pose& pose = *to.add_pose();
    fill(transform.header, *pose.mutable_header());
    add_frame("child_frame_id", transform.child_frame_id, *pose.mutable_header());
    pose.set_name(transform.child_frame_id);
    fill(transform.transform.translation, *pose.mutable_position());
    fill(transform.transform.rotation, *pose.mutable_orientation());
  }
}

void fill_clock(const msg::Clock& from, gz_msgs::Clock& to) { fill(from.clock, *to.mutable_sim()); }

// ---- What carries what: one more message is a function above and a row

struct Row {
  std::string_view ros_type;
  std::unique_ptr<GazeboMessage> (*make)();
  void (*fill)(const msg::Message& from, GazeboMessage& to);
};

template <auto kFill>
struct RowOf;

template <class Ros, class Gazebo, void (*kFill)(const Ros&, Gazebo&)>
struct RowOf<kFill> {
  static constexpr Row kRow = {
      Ros::kType, []() -> std::unique_ptr<GazeboMessage> { return std::make_unique<Gazebo>(); },
      [](const msg::Message& from, GazeboMessage& to) {
        kFill(std::get<Ros>(from), static_cast<Gazebo&>(to));
      }};
};

constexpr auto kRows = std::to_array<Row>({
    RowOf<fill_image>::kRow,
    RowOf<fill_camera_info>::kRow,
    RowOf<fill_cloud>::kRow,
    RowOf<fill_imu>::kRow,
    RowOf<fill_navsat>::kRow,
    RowOf<fill_scan>::kRow,
    RowOf<fill_point>::kRow,
    RowOf<fill_pose>::kRow,
    RowOf<fill_odometry>::kRow,
    RowOf<fill_transforms>::kRow,
    RowOf<fill_clock>::kRow,
});

// ---- Names and labels

struct Renaming {
  std::string_view ros_type, ending, gazebo_ending;
  ImageUse use = ImageUse::kPicture;
};
constexpr auto kRenamings = std::to_array<Renaming>({
    {msg::Image::kType, "/image_raw", "/image"},
    {msg::Image::kType, "/depth", "/depth_image"},
    {msg::Image::kType, "/class", "/semantic/labels_map", ImageUse::kClasses},
    {msg::Image::kType, "/id", "/panoptic/labels_map", ImageUse::kIds},
    {msg::Imu::kType, "/data", ""},
    {msg::NavSatFix::kType, "/fix", ""},
});

template <class Value>
std::uint32_t label_at(const msg::Image& image, std::size_t pixel, std::uint32_t most) {
  Value value;
  std::memcpy(&value, image.data.data() + pixel * sizeof value, sizeof value);
  return std::min(static_cast<std::uint32_t>(value), most);
}

std::uint32_t class_at(const msg::Image& classes, std::size_t pixel) {
  return label_at<std::uint16_t>(classes, pixel, 255);
}

// With the three bytes of each pixel.
template <class BytesOf>
void fill_labels(const msg::Image& from, const BytesOf& bytes_of, gz_msgs::Image& to) {
  to.Clear();
  fill_image_head(from, gz_msgs::RGB_INT8, 3 * from.width, to);
  const std::size_t pixels = std::size_t{from.width} * from.height;
  std::string& data = *to.mutable_data();
  data.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    std::ranges::transform(bytes_of(i), data.begin() + static_cast<std::ptrdiff_t>(3 * i),
                           [](std::uint32_t byte) { return static_cast<char>(byte); });
}

}  // namespace

std::optional<std::int64_t> time_ns(const gz_msgs::Time& time) {
  if (time.sec() < 0 || time.sec() > std::numeric_limits<std::int32_t>::max() || time.nsec() < 0 ||
      time.nsec() >= kSecond_ns)
    return std::nullopt;
  return time.sec() * kSecond_ns + time.nsec();
}

void set_time(std::int64_t t_ns, gz_msgs::Time& to) {
  to.set_sec(t_ns / kSecond_ns);
  to.set_nsec(static_cast<std::int32_t>(t_ns % kSecond_ns));
}

std::unique_ptr<GazeboMessage> gazebo_message(std::string_view ros_type) {
  const auto* row = std::ranges::find(kRows, ros_type, &Row::ros_type);
  return row == kRows.end() ? nullptr : row->make();
}

void convert(const msg::Message& from, GazeboMessage& to) {
  const auto type_of = [](const auto& message) { return message.kType; };
  const auto* row = std::ranges::find(kRows, std::visit(type_of, from), &Row::ros_type);
  SWELL_CHECK(row != kRows.end(), "no message of Gazebo's");
  to.Clear();
  row->fill(from, to);
}

GazeboTopic gazebo_topic(const Topic& topic) {
  for (const Renaming& renaming : kRenamings) {
    if (topic.type != renaming.ros_type || !topic.name.ends_with(renaming.ending)) continue;
    std::string name = topic.name.substr(0, topic.name.size() - renaming.ending.size());
    return {name.append(renaming.gazebo_ending), renaming.use};
  }
  return {topic.name};
}

void convert_classes(const msg::Image& classes, gz_msgs::Image& to) {
  const auto bytes_of = [&](std::size_t pixel) {
    const std::uint32_t label = class_at(classes, pixel);
    return std::array{label, label, label};
  };
  fill_labels(classes, bytes_of, to);
}

void convert_ids(const msg::Image& ids, const msg::Image* classes, gz_msgs::Image& to) {
  const auto bytes_of = [&](std::size_t pixel) {
    const std::uint32_t id = label_at<std::uint32_t>(ids, pixel, 65535);
    return std::array{id & 255u, id >> 8u, classes ? class_at(*classes, pixel) : 0u};
  };
  fill_labels(ids, bytes_of, to);
}

}  // namespace swell::apps
