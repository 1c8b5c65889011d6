// What swell-sim is made of, against answers that are known without it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

#include "apps/messages/cdr.h"
#include "apps/messages/definitions.h"
#include "apps/sim/frames.h"
#include "apps/sim/geodetic.h"
#include "apps/sim/lens.h"
#include "apps/sim/rig_run.h"
#include "apps/sim/simulation.h"
#include "math/elementary.h"

namespace swell::apps {
namespace {

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

TEST(Cdr, HasTheBytesThatAreWrittenByHand) {
  EXPECT_EQ(hex(cdr_bytes(msg::PointStamped{{{1, 2}, "map"}, {1.0, -2.0, 0.5}})),
            "00010000"                          // CDR, little endian
            "0100000002000000"                  // stamp
            "040000006d617000"                  // "map" with its zero
            "000000000000f03f00000000000000c0"  // 1, -2
            "000000000000e03f");                // 0.5
  // Numbers are aligned to their size behind the first four bytes.
  EXPECT_EQ(hex(cdr_bytes(msg::Range{{{0, 0}, "abcd"}, 1, 0.5f, 1.0f, 2.0f, -1.0f})),
            "00010000"
            "0000000000000000"
            "050000006162636400"
            "01"    // radiation_type, at 17
            "0000"  // up to 20
            "0000003f0000803f00000040000080bf");
  msg::PointCloud2 cloud;
  cloud.point_fields = {{"x", 0, msg::PointField::kFloat32, 1}};
  cloud.width = 1, cloud.point_step = cloud.row_step = 4;
  cloud.data = {1, 2, 3, 4};
  EXPECT_EQ(hex(cdr_bytes(cloud)),
            "00010000"
            "0000000000000000010000000000000001000000"  // stamp, "", up to 16, height
            "01000000"                                  // width
            "01000000"
            "020000007800"
            "0000"
            "00000000"
            "07"
            "000000"
            "01000000"  // one field
            "00"
            "000000"
            "04000000"
            "04000000"  // is_bigendian, steps
            "0400000001020304"
            "01");  // data, is_dense
}

TEST(Definitions, HoldEachPartOnce) {
  EXPECT_EQ(message_definition("rosgraph_msgs/msg/Clock"),
            "builtin_interfaces/Time clock\n" + std::string(80, '=') +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  const std::string text = message_definition("nav_msgs/msg/Odometry");
  for (const char* part : {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/Vector3",
                           "geometry_msgs/Quaternion", "geometry_msgs/TwistWithCovariance"}) {
    const std::string head = std::string("MSG: ") + part + "\n";
    ASSERT_NE(text.find(head), std::string::npos) << part;
    EXPECT_EQ(text.find(head), text.rfind(head)) << part;
  }
}

TEST(Schedule, StampsAreWorkedOutOfTheirNumber) {
  EXPECT_EQ(stamp_ns(1, 3.0), 333333333);
  EXPECT_EQ(stamp_ns(2, 3.0), 666666667);
  EXPECT_EQ(stamp_ns(3'000'000, 3.0), 1'000'000'000'000'000);
  EXPECT_EQ(stamp_ns(2997, 29.97), 100'000'000'000);
  EXPECT_EQ(stamp_ns(7, 20.0), 350'000'000);
}

TEST(Schedule, GoesThroughAllStampsBelowTheDurationInTheirOrder) {
  const std::vector<Source> sources = {
      {"once", "", 0.0, {}}, {"slow", "", 2.0, {}}, {"fast", "", 4.0, {}}};
  Schedule schedule(sources, 1.0);
  std::string text;
  for (Schedule::Due due; schedule.next(due);)
    text += fmt::format("{} {} ", sources[due.source].name, due.stamp_ns / 1'000'000);
  EXPECT_EQ(text, "once 0 slow 0 fast 0 fast 250 slow 500 fast 500 fast 750 ");
}

TEST(Geodetic, KnowsTheAxesOfTheEllipsoid) {
  constexpr double kA = 6378137.0, kB = 6356752.314245;
  const Geodetic up = geodetic_of({0.3, -1.0, 5.0}, {0.0, 0.0, 1000.0});
  EXPECT_NEAR(up.latitude_rad, 0.3, 1e-15);
  EXPECT_NEAR(up.longitude_rad, -1.0, 1e-15);
  EXPECT_NEAR(up.altitude_m, 1005.0, 1e-8);
  const Geodetic east = geodetic_of({}, {kA, 0.0, -kA});
  EXPECT_NEAR(east.latitude_rad, 0.0, 1e-15);
  EXPECT_NEAR(east.longitude_rad, radians(90.0), 1e-15);
  EXPECT_NEAR(east.altitude_m, 0.0, 1e-8);
  const Geodetic pole = geodetic_of({}, {0.0, kB, -kA});
  EXPECT_NEAR(pole.latitude_rad, radians(90.0), 1e-12);
  EXPECT_NEAR(pole.altitude_m, 0.0, 1e-6);
}

// From the earth's middle, by the ellipsoid's equation.
glm::dvec3 ecef(const Geodetic& at) {
  constexpr double kE2 = 0.00669437999014;
  const double s = std::sin(at.latitude_rad), c = std::cos(at.latitude_rad);
  const double n = 6378137.0 / std::sqrt(1.0 - kE2 * s * s);
  return {(n + at.altitude_m) * c * std::cos(at.longitude_rad),
          (n + at.altitude_m) * c * std::sin(at.longitude_rad),
          (n * (1.0 - kE2) + at.altitude_m) * s};
}

TEST(Geodetic, PlacesKeepTheirDistances) {
  const Geodetic origin = {radians(59.9), radians(10.7), 40.0};
  for (const glm::dvec3& p :
       {glm::dvec3(100, 0, 0), glm::dvec3(0, -2000, 3), glm::dvec3(1e5, 3e5, 50)}) {
    const Geodetic at = geodetic_of(origin, p);
    EXPECT_NEAR(glm::length(ecef(at) - ecef(origin)), glm::length(p), 1e-6);
    EXPECT_GT((at.longitude_rad - origin.longitude_rad) * p.x, -1e-12);
  }
}

TEST(Lens, ShowsEachPixelWhereTheLensPutsItsDirection) {
  const Distortion lens = {-0.2, 0.05, 0.001, -0.002, 0.003};
  const Intrinsics k = {70.0, 70.0, 48.0, 27.0};
  const auto lookup = LensLookup::find(k, 96, 54, lens);
  ASSERT_TRUE(lookup);
  EXPECT_GT(lookup->wide_width_px(), 96);
  // A picture whose red is the column and whose green is the row.
  const int width = lookup->wide_width_px(), height = lookup->wide_height_px();
  std::vector<std::uint32_t> wide;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      wide.push_back(static_cast<std::uint32_t>(x | y << 8) | 0xff000000u);
  std::vector<std::uint8_t> rgb(3 * 96 * 54);
  lookup->blend(wide, rgb);
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      const auto pixel = static_cast<std::size_t>(96 * y + x);
      // Where it came from, to half a step of the colours, goes back to where it is shown.
      const Intrinsics w = lookup->wide_intrinsics();
      const auto seen = distorted(lens, (rgb[3 * pixel] + 0.5 - w.cx) / w.fx,
                                  (rgb[3 * pixel + 1] + 0.5 - w.cy) / w.fy);
      EXPECT_NEAR(k.fx * seen[0] + k.cx, x + 0.5, 0.6);
      EXPECT_NEAR(k.fy * seen[1] + k.cy, y + 0.5, 0.6);
      const std::uint32_t nearest = wide[lookup->nearest(pixel)];
      EXPECT_NEAR(nearest & 0xff, rgb[3 * pixel], 1.0);
    }
}

TEST(Lens, ThatFoldsThePictureIsNone) {
  const Intrinsics k = {40.0, 40.0, 48.0, 27.0};
  EXPECT_FALSE(LensLookup::find(k, 96, 54, {-0.9, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(LensLookup::find({1.0, 1.0, 48.0, 27.0}, 96, 54, {-0.01, 0.0, 0.0, 0.0, 0.0}));
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double most) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], most) << i;
}

TEST(Frames, TurnAsRosHasThem) {
  scene::Sensor sensor;
  sensor.position_m = {1, 2, 3};
  sensor.rpy_rad = {0.0, radians(90.0), 0.0};  // x looks down
  expect_near(mounting(sensor).axes[0], {0, 0, -1}, 1e-15);
  sensor.rpy_rad = {0.0, 0.0, radians(90.0)};  // to the left
  expect_near(mounting(sensor).axes[0], {0, 1, 0}, 1e-15);
  sensor.rpy_rad = {radians(90.0), 0.0, 0.0};  // y up
  expect_near(mounting(sensor).axes[1], {0, 0, 1}, 1e-15);
  const FramePose east = heading_pose({0.0, {5, 6, 7}, radians(90.0), 0.0, 0.0});
  expect_near(east.axes[0], {1, 0, 0}, 1e-15);
  expect_near(east.axes[1], {0, 1, 0}, 1e-15);
  // Roll lowers the right side: y, to the left, rises.
  EXPECT_GT(heading_pose({0.0, {}, 0.0, 0.0, 0.1}).axes[1].z, 0.09);
  const FramePose optical = east * optical_frame();
  expect_near(optical.axes[2], {1, 0, 0}, 1e-15);   // ahead
  expect_near(optical.axes[0], {0, -1, 0}, 1e-15);  // right: south
  expect_near(optical.axes[1], {0, 0, -1}, 1e-15);  // down
  const msg::Quaternion q = quaternion_message(heading_pose({0.0, {}, 0.0, 0.0, 0.0}).axes);
  EXPECT_NEAR(q.z, std::sqrt(0.5), 1e-15);  // north: a quarter turn from east
  EXPECT_NEAR(q.w, std::sqrt(0.5), 1e-15);
}

TEST(Frames, MoveOnACircleAsItsFormulasSay) {
  constexpr double kRadius = 20.0, kRate = 0.3, kStep = 0.04;
  const auto pose = [](double t) {
    FramePose at;
    at.position_m = {kRadius * std::cos(kRate * t), kRadius * std::sin(kRate * t), 0.0};
    at.axes[0] = {-std::sin(kRate * t), std::cos(kRate * t), 0.0};
    at.axes[1] = {-std::cos(kRate * t), -std::sin(kRate * t), 0.0};
    return at;
  };
  const FrameMotion motion = motion_between(pose(-kStep), pose(0.0), pose(kStep), kStep);
  expect_near(motion.velocity_mps, {0.0, kRadius * kRate, 0.0}, 2e-4);
  expect_near(motion.acceleration_mps2, {-kRadius * kRate * kRate, 0.0, 0.0}, 2e-4);
  expect_near(motion.turn_rad_s, {0.0, 0.0, kRate}, 1e-12);
}

// ---- A rig in a world

TEST(Sensors, OnAStillSeaMeasureWhatIsKnown) {
  const auto last = last_messages(R"(
clock_hz = 4
[origin]
latitude_deg = 10
longitude_deg = 20
altitude_m = 30
[[body]]
frame = "mast"
position_m = [0, 0, 12.5]
heading_deg = 90
[[altimeter]]
name = "down"
body = "mast"
position_m = [0, 0, 0.5]
[[altimeter]]
name = "aslant"
body = "mast"
rpy_deg = [0, 30, 0]
[[altimeter]]
name = "up"
rate_hz = 1
body = "mast"
rpy_deg = [0, -30, 0]
[[altimeter]]
name = "near"
position_m = [0, 0, 0.1]
[[echo_sounder]]
name = "deep"
position_m = [0, 0, -1]
[[wave_probe]]
name = "probe"
body = "mast"
position_m = [3, 4, 0]
[[imu]]
name = "imu"
body = "mast"
rpy_deg = [90, 0, 0]
[[gnss]]
name = "gnss"
body = "mast"
[[odometry]]
name = "odom"
body = "mast"
[[pose]]
name = "tip"
body = "mast"
position_m = [2, 0, 1]
)");
  const auto range = [&](const char* topic) { return std::get<msg::Range>(last.at(topic)).range; };
  EXPECT_NEAR(range("/down"), 13.0, 1e-4);
  EXPECT_NEAR(range("/aslant"), 25.0, 1e-4);
  EXPECT_EQ(range("/up"), kInfinity<float>);
  EXPECT_EQ(range("/near"), -kInfinity<float>);
  EXPECT_EQ(range("/deep"), kInfinity<float>);
  EXPECT_EQ(std::get<msg::Range>(last.at("/down")).header.frame_id, "down_link");
  const auto& probe = std::get<msg::PointStamped>(last.at("/probe"));
  EXPECT_EQ(probe.header.frame_id, "map");
  expect_near({probe.point.x, probe.point.y, probe.point.z}, {3, 4, 0}, 1e-6);
  // At rest gravity upwards: along the y of a sensor that lies on its side.
  const auto& imu = std::get<msg::Imu>(last.at("/imu/data"));
  expect_near({imu.linear_acceleration.x, imu.linear_acceleration.y, imu.linear_acceleration.z},
              {0, 9.81, 0}, 1e-6);
  const auto& fix = std::get<msg::NavSatFix>(last.at("/gnss/fix"));
  EXPECT_NEAR(fix.latitude, 10.0, 1e-12);
  EXPECT_NEAR(fix.longitude, 20.0, 1e-12);
  EXPECT_NEAR(fix.altitude, 42.5, 1e-6);
  const auto& odom = std::get<msg::Odometry>(last.at("/odom"));
  EXPECT_EQ(odom.header.frame_id, "odom");
  EXPECT_EQ(odom.child_frame_id, "mast");
  EXPECT_NEAR(odom.pose.pose.orientation.w, 1.0, 1e-12);  // towards the east
  EXPECT_EQ(odom.twist.twist.linear.x, 0.0);
  const auto& tip = std::get<msg::PoseStamped>(last.at("/tip")).pose.position;
  expect_near({tip.x, tip.y, tip.z}, {2, 0, 13.5}, 1e-12);
  const auto& clock = std::get<msg::Clock>(last.at("/clock")).clock;
  EXPECT_EQ(clock.sec, 0);
  EXPECT_EQ(clock.nanosec, 750'000'000u);
  EXPECT_FALSE(last.contains("/tf"));  // nothing moves
  // map to odom, odom to mast, and eight sensors with frames of their own.
  EXPECT_EQ(std::get<msg::TFMessage>(last.at("/tf_static")).transforms.size(), 11u);
}

TEST(Sensors, OfABodyOnAPathMoveWithIt) {
  const auto last = last_messages(R"(
[[body]]
rate_hz = 2
[[body.path]]
t_s = -10
position_m = [-30, 0, 1]
heading_deg = 90
[[body.path]]
t_s = 10
position_m = [30, 0, 1]
heading_deg = 90
[[odometry]]
name = "odom"
body = "base_link"
rate_hz = 1
[[camera]]
name = "camera"
body = "base_link"
width_px = 16
height_px = 8
rate_hz = 2
depth = true
)");
  // Hermite's curve from rest to rest: its greatest speed is 1.5 times its mean.
  const auto& odom = std::get<msg::Odometry>(last.at("/odom"));
  EXPECT_NEAR(odom.twist.twist.linear.x, 4.5, 1e-3);
  EXPECT_NEAR(odom.twist.twist.linear.y, 0.0, 1e-9);
  const auto& moved = std::get<msg::TFMessage>(last.at("/tf")).transforms.at(0);
  EXPECT_EQ(moved.header.stamp.nanosec, 500'000'000u);
  EXPECT_NEAR(moved.transform.translation.x, 2.25, 2e-3);
  EXPECT_EQ(moved.header.frame_id, "odom");
  EXPECT_EQ(moved.child_frame_id, "base_link");
  const auto& depth = std::get<msg::Image>(last.at("/camera/depth"));
  EXPECT_EQ(depth.encoding, "32FC1");
  EXPECT_EQ(depth.data.size(), 16u * 8u * 4u);
  EXPECT_EQ(depth.header.frame_id, "camera_optical_frame");
  const auto& info = std::get<msg::CameraInfo>(last.at("/camera/camera_info"));
  EXPECT_NEAR(info.k[0], 4.0 / std::tan(radians(25.0)), 1e-9);
  EXPECT_EQ(info.k[2], 7.5);
  EXPECT_EQ(info.k[5], 3.5);
  // What lies under the horizon in the last row is as far as the ray through its middle goes down.
  float last_depth = 0.0f;
  std::memcpy(&last_depth, depth.data.data() + depth.data.size() - 4 * 8, sizeof last_depth);
  EXPECT_NEAR(last_depth, 1.0 / (3.5 / info.k[4]), 0.02);
}

TEST(Sensors, ThatAreWideTellTheirModelsAsRosHasThem) {
  const auto last = last_messages(R"(
[[camera]]
name = "up"
position_m = [0, 0, 5]
rpy_deg = [0, -90, 0]
projection = "fisheye"
fisheye_fov_deg = 200
fisheye_k = [0.02, -0.003, 0, 0]
full_well_e = 9000
width_px = 24
height_px = 16
depth = true
[[camera]]
name = "all"
rate_hz = 1
position_m = [0, 0, 5]
projection = "equirectangular"
width_px = 32
height_px = 16
depth = true
)");
  const auto& up = std::get<msg::CameraInfo>(last.at("/up/camera_info"));
  EXPECT_EQ(up.distortion_model, "equidistant");
  EXPECT_EQ(up.d, (std::vector<double>{0.02, -0.003, 0.0, 0.0}));
  // The cone touches the upper and the lower edge.
  const double half = radians(100.0);
  EXPECT_NEAR(up.k[0], 8.0 / (half * (1.0 + 0.02 * half * half - 0.003 * std::pow(half, 4))), 1e-9);
  EXPECT_EQ(up.k[2], 11.5);
  const auto& all = std::get<msg::CameraInfo>(last.at("/all/camera_info"));
  EXPECT_EQ(all.distortion_model, "equirectangular");
  EXPECT_TRUE(all.d.empty());
  EXPECT_EQ(all.k[0], 0.0);  // as CameraInfo says of cameras without a matrix
  EXPECT_EQ(all.width, 32u);
  // Straight down it is 5 m to the water, and the depth of wide cameras is the distance.
  const auto& depth = std::get<msg::Image>(last.at("/all/depth"));
  float lowest = 0.0f;
  std::memcpy(&lowest, depth.data.data() + 4 * (15 * 32 + 8), sizeof lowest);
  EXPECT_NEAR(lowest, 5.0 / std::cos(radians(90.0 / 16.0)), 0.05);
}

}  // namespace
}  // namespace swell::apps
