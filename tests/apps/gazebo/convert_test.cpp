// Gazebo's messages, field by field against what ROS's say.
#include "apps/gazebo/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace swell::apps {
namespace {

template <class Gazebo>
Gazebo converted(const msg::Message& from) {
  const std::string_view type = std::visit([](const auto& m) { return m.kType; }, from);
  const auto to = gazebo_message(type);
  EXPECT_NE(to, nullptr);
  convert(from, *to);
  return dynamic_cast<const Gazebo&>(*to);
}

void expect_header(const gz_msgs::Header& header, int sec, int nsec, const std::string& frame) {
  EXPECT_EQ(header.stamp().sec(), sec);
  EXPECT_EQ(header.stamp().nsec(), nsec);
  ASSERT_GE(header.data_size(), 1);
  EXPECT_EQ(header.data(0).key(), "frame_id");
  ASSERT_EQ(header.data(0).value_size(), 1);
  EXPECT_EQ(header.data(0).value(0), frame);
}

msg::Image image_of(const char* encoding, std::uint32_t width, std::uint32_t height,
                    std::uint32_t pixel_bytes, std::vector<std::uint8_t> data) {
  msg::Image image;
  image.header = {{7, 500}, "lens"};
  image.width = width;
  image.height = height;
  image.encoding = encoding;
  image.step = pixel_bytes * width;
  image.data = std::move(data);
  return image;
}

TEST(GazeboMessages, PicturesKeepTheirBytes) {
  const auto image = converted<gz_msgs::Image>(image_of("rgb8", 2, 1, 3, {1, 2, 3, 0, 254, 255}));
  expect_header(image.header(), 7, 500, "lens");
  EXPECT_EQ(image.width(), 2u);
  EXPECT_EQ(image.height(), 1u);
  EXPECT_EQ(image.step(), 6u);
  EXPECT_EQ(image.pixel_format_type(), gz_msgs::RGB_INT8);
  EXPECT_EQ(image.data(), std::string("\1\2\3\0\376\377", 6));
  const auto depth =
      converted<gz_msgs::Image>(image_of("32FC1", 1, 2, 4, {0, 0, 128, 63, 0, 0, 128, 127}));
  EXPECT_EQ(depth.pixel_format_type(), gz_msgs::R_FLOAT32);
  float metres[2];
  ASSERT_EQ(depth.data().size(), sizeof metres);
  std::memcpy(metres, depth.data().data(), sizeof metres);
  EXPECT_EQ(metres[0], 1.0f);
  EXPECT_TRUE(std::isinf(metres[1]));
  EXPECT_EQ(converted<gz_msgs::Image>(image_of("32SC1", 1, 1, 4, {1, 0, 0, 0})).pixel_format_type(),
            gz_msgs::UNKNOWN_PIXEL_FORMAT);
}

TEST(GazeboMessages, LabelsAreThoseOfASegmentationCamera) {
  const msg::Image classes = image_of("16UC1", 3, 1, 2, {0, 0, 5, 0, 0, 1});
  gz_msgs::Image map;
  convert_classes(classes, map);
  expect_header(map.header(), 7, 500, "lens");
  EXPECT_EQ(map.pixel_format_type(), gz_msgs::RGB_INT8);
  EXPECT_EQ(map.step(), 9u);
  EXPECT_EQ(map.data(), std::string("\0\0\0\5\5\5\377\377\377", 9));
  const msg::Image ids = image_of("32SC1", 3, 1, 4, {0, 0, 0, 0, 4, 3, 0, 0, 0, 0, 1, 0});
  convert_ids(ids, &classes, map);
  EXPECT_EQ(map.data(), std::string("\0\0\0\4\3\5\377\377\377", 9));
  convert_ids(ids, nullptr, map);
  EXPECT_EQ(map.data(), std::string("\0\0\0\4\3\0\377\377\0", 9));
}

TEST(GazeboMessages, CamerasAreDescribed) {
  msg::CameraInfo info;
  info.header = {{1, 2}, "lens"};
  info.width = 640;
  info.height = 360;
  info.distortion_model = "plumb_bob";
  info.d = {0.1, 0.2, 0.3, 0.4, 0.5};
  for (std::size_t i = 0; i < 9; ++i) info.k[i] = static_cast<double>(i), info.r[i] = -info.k[i];
  for (std::size_t i = 0; i < 12; ++i) info.p[i] = 100.0 + static_cast<double>(i);
  const auto camera = converted<gz_msgs::CameraInfo>(info);
  expect_header(camera.header(), 1, 2, "lens");
  EXPECT_EQ(camera.width(), 640u);
  EXPECT_EQ(camera.height(), 360u);
  EXPECT_EQ(camera.distortion().model(), gz_msgs::CameraInfo::Distortion::PLUMB_BOB);
  ASSERT_EQ(camera.distortion().k_size(), 5);
  EXPECT_EQ(camera.distortion().k(4), 0.5);
  ASSERT_EQ(camera.intrinsics().k_size(), 9);
  EXPECT_EQ(camera.intrinsics().k(5), 5.0);
  ASSERT_EQ(camera.projection().p_size(), 12);
  EXPECT_EQ(camera.projection().p(11), 111.0);
  ASSERT_EQ(camera.rectification_matrix_size(), 9);
  EXPECT_EQ(camera.rectification_matrix(8), -8.0);
  info.distortion_model = "equirectangular";
  EXPECT_FALSE(converted<gz_msgs::CameraInfo>(info).has_distortion());
}

TEST(GazeboMessages, CloudsKeepTheirFieldsAndBytes) {
  msg::PointCloud2 cloud;
  cloud.header = {{1, 2}, "lidar"};
  cloud.point_fields = {{"x", 0, msg::PointField::kFloat32, 1},
                        {"id", 4, msg::PointField::kUint32, 1}};
  cloud.height = 1, cloud.width = 1, cloud.point_step = 8, cloud.row_step = 8;
  cloud.data = {1, 2, 3, 4, 5, 6, 7, 0};
  const auto packed = converted<gz_msgs::PointCloudPacked>(cloud);
  expect_header(packed.header(), 1, 2, "lidar");
  ASSERT_EQ(packed.field_size(), 2);
  EXPECT_EQ(packed.field(0).name(), "x");
  EXPECT_EQ(packed.field(0).datatype(), gz_msgs::PointCloudPacked::Field::FLOAT32);
  EXPECT_EQ(packed.field(1).offset(), 4u);
  EXPECT_EQ(packed.field(1).datatype(), gz_msgs::PointCloudPacked::Field::UINT32);
  EXPECT_EQ(packed.field(1).count(), 1u);
  EXPECT_EQ(packed.width(), 1u);
  EXPECT_EQ(packed.height(), 1u);
  EXPECT_EQ(packed.point_step(), 8u);
  EXPECT_EQ(packed.row_step(), 8u);
  EXPECT_FALSE(packed.is_bigendian());
  EXPECT_TRUE(packed.is_dense());
  EXPECT_EQ(packed.data(), std::string("\1\2\3\4\5\6\7\0", 8));
}

TEST(GazeboMessages, SensorsOfMotionAndPlaceKeepTheirNumbers) {
  msg::Imu imu;
  imu.header = {{3, 4}, "imu_link"};
  imu.orientation = {0.1, 0.2, 0.3, 0.9};
  imu.angular_velocity = {1.0, 2.0, 3.0};
  imu.linear_acceleration = {4.0, 5.0, 9.8};
  const auto moved = converted<gz_msgs::IMU>(imu);
  expect_header(moved.header(), 3, 4, "imu_link");
  EXPECT_EQ(moved.entity_name(), "imu_link");
  EXPECT_EQ(moved.orientation().w(), 0.9);
  EXPECT_EQ(moved.orientation().x(), 0.1);
  EXPECT_EQ(moved.angular_velocity().y(), 2.0);
  EXPECT_EQ(moved.linear_acceleration().z(), 9.8);

  msg::NavSatFix fix;
  fix.header = {{3, 4}, "gnss_link"};
  fix.latitude = 59.9, fix.longitude = 10.7, fix.altitude = -3.5;
  const auto navsat = converted<gz_msgs::NavSat>(fix);
  expect_header(navsat.header(), 3, 4, "gnss_link");
  EXPECT_EQ(navsat.frame_id(), "gnss_link");
  EXPECT_EQ(navsat.latitude_deg(), 59.9);
  EXPECT_EQ(navsat.longitude_deg(), 10.7);
  EXPECT_EQ(navsat.altitude(), -3.5);

  const float none = std::numeric_limits<float>::infinity();
  const auto scan = converted<gz_msgs::LaserScan>(
      msg::Range{{{3, 4}, "gauge_link"}, msg::Range::kInfrared, 0.1f, 0.25f, 80.0f, none});
  expect_header(scan.header(), 3, 4, "gauge_link");
  EXPECT_EQ(scan.frame(), "gauge_link");
  EXPECT_EQ(scan.range_min(), 0.25);
  EXPECT_EQ(scan.range_max(), 80.0);
  EXPECT_EQ(scan.count(), 1u);
  EXPECT_EQ(scan.vertical_count(), 1u);
  ASSERT_EQ(scan.ranges_size(), 1);
  ASSERT_EQ(scan.intensities_size(), 1);
  EXPECT_TRUE(std::isinf(scan.ranges(0)));
}

TEST(GazeboMessages, PosesKeepTheirFrames) {
  const msg::Pose pose = {{1.0, 2.0, 3.0}, {0.5, -0.5, 0.5, -0.5}};
  const auto stamped = converted<gz_msgs::Pose>(msg::PoseStamped{{{5, 6}, "map"}, pose});
  expect_header(stamped.header(), 5, 6, "map");
  EXPECT_EQ(stamped.position().z(), 3.0);
  EXPECT_EQ(stamped.orientation().y(), -0.5);

  const auto point =
      converted<gz_msgs::Vector3d>(msg::PointStamped{{{5, 6}, "map"}, {1.0, 2.0, -3.0}});
  expect_header(point.header(), 5, 6, "map");
  EXPECT_EQ(point.x(), 1.0);
  EXPECT_EQ(point.z(), -3.0);

  msg::Odometry odometry;
  odometry.header = {{5, 6}, "odom"};
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = pose;
  odometry.twist.twist = {{7.0, 8.0, 9.0}, {0.7, 0.8, 0.9}};
  const auto moving = converted<gz_msgs::Odometry>(odometry);
  expect_header(moving.header(), 5, 6, "odom");
  ASSERT_EQ(moving.header().data_size(), 2);
  EXPECT_EQ(moving.header().data(1).key(), "child_frame_id");
  EXPECT_EQ(moving.header().data(1).value(0), "base_link");
  EXPECT_EQ(moving.pose().position().y(), 2.0);
  EXPECT_EQ(moving.pose().orientation().w(), -0.5);
  EXPECT_EQ(moving.twist().linear().x(), 7.0);
  EXPECT_EQ(moving.twist().angular().z(), 0.9);

  const msg::TFMessage transforms = {{{{{5, 6}, "map"}, "odom", {{1.0, 0.0, 0.0}, {}}},
                                      {{{5, 7}, "odom"}, "base_link", {{0.0, 2.0, 0.0}, {}}}}};
  const auto poses = converted<gz_msgs::Pose_V>(transforms);
  EXPECT_EQ(poses.header().stamp().nsec(), 6);
  ASSERT_EQ(poses.pose_size(), 2);
  expect_header(poses.pose(1).header(), 5, 7, "odom");
  EXPECT_EQ(poses.pose(1).header().data(1).value(0), "base_link");
  EXPECT_EQ(poses.pose(1).name(), "base_link");
  EXPECT_EQ(poses.pose(1).position().y(), 2.0);
  EXPECT_EQ(poses.pose(0).orientation().w(), 1.0);
  EXPECT_EQ(converted<gz_msgs::Pose_V>(msg::TFMessage{}).pose_size(), 0);
}

TEST(GazeboMessages, TheClockIsTheSimulations) {
  const auto clock = converted<gz_msgs::Clock>(msg::Clock{{12, 34}});
  EXPECT_EQ(clock.sim().sec(), 12);
  EXPECT_EQ(clock.sim().nsec(), 34);
  EXPECT_FALSE(clock.has_real());
}

TEST(GazeboMessages, NothingStaysOfTheMessageBefore) {
  const auto to = gazebo_message(msg::TFMessage::kType);
  convert(msg::TFMessage{{{{{1, 0}, "map"}, "odom", {}}}}, *to);
  const std::string bytes = to->SerializeAsString();
  convert(msg::TFMessage{{{{{1, 0}, "map"}, "odom", {}}}}, *to);
  EXPECT_EQ(to->SerializeAsString(), bytes);
}

TEST(GazeboMessages, AllOfRosHaveOneButThoseThatGazeboDoesNotKnow) {
  EXPECT_EQ(gazebo_message("sensor_msgs/msg/CompressedImage"), nullptr);
  EXPECT_EQ(gazebo_message(""), nullptr);
}

TEST(GazeboTopics, AreNamedAsGazebosSensorsNameThem) {
  const auto name = [](const char* topic, std::string_view type) {
    return gazebo_topic({topic, type}).name;
  };
  EXPECT_EQ(name("/boat/cam/image_raw", msg::Image::kType), "/boat/cam/image");
  EXPECT_EQ(name("/cam/depth", msg::Image::kType), "/cam/depth_image");
  EXPECT_EQ(name("/cam/class", msg::Image::kType), "/cam/semantic/labels_map");
  EXPECT_EQ(name("/cam/id", msg::Image::kType), "/cam/panoptic/labels_map");
  EXPECT_EQ(name("/cam/camera_info", msg::CameraInfo::kType), "/cam/camera_info");
  EXPECT_EQ(name("/imu/data", msg::Imu::kType), "/imu");
  EXPECT_EQ(name("/gnss/fix", msg::NavSatFix::kType), "/gnss");
  EXPECT_EQ(name("/depth", msg::Range::kType), "/depth");
  EXPECT_EQ(gazebo_topic({"/cam/id", msg::Image::kType}).use, ImageUse::kIds);
  EXPECT_EQ(gazebo_topic({"/cam/depth", msg::Image::kType}).use, ImageUse::kPicture);
}

}  // namespace
}  // namespace swell::apps
