// What is read of messages from Gazebo's transport.
#include "apps/gazebo/inbound.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "apps/gazebo/mutation.h"

namespace swell::apps {
namespace {

// Takes down what comes, a line each.
struct Taken {
  std::vector<std::string> lines;
  GazeboTakers takers = {
      [this](std::string_view topic, std::int64_t t_ns) {
        lines.push_back(fmt::format("{} {}", topic, t_ns));
      },
      [this](std::string_view topic, std::string_view frame, std::int64_t t_ns,
             const msg::Pose& pose) {
        const auto& [p, q] = pose;
        lines.push_back(fmt::format("{} {} {} {} {} {} {} {} {} {}", topic, frame, t_ns, p.x, p.y,
                                    p.z, q.x, q.y, q.z, q.w));
      },
      [this](std::string_view topic, const std::string& what) {
        lines.push_back(fmt::format("{}: {}", topic, what));
      }};
};

const std::vector<std::string> kBodies = {"boat", "buoy"};

gz_msgs::Pose pose_of(const std::string& name, std::int64_t sec) {
  gz_msgs::Pose pose;
  pose.set_name(name);
  pose.mutable_header()->mutable_stamp()->set_sec(sec);
  pose.mutable_position()->set_x(1.5);
  pose.mutable_position()->set_z(-2.0);
  pose.mutable_orientation()->set_z(0.6);
  pose.mutable_orientation()->set_w(0.8);
  return pose;
}

TEST(GazeboInbound, TheClockIsTheSimulationsTime) {
  Taken taken;
  gz_msgs::Clock clock;
  clock.mutable_sim()->set_sec(12);
  clock.mutable_sim()->set_nsec(34);
  clock.mutable_real()->set_sec(99);
  take_clock("/clock", clock, taken.takers);
  clock.mutable_sim()->set_nsec(-1);
  take_clock("/clock", clock, taken.takers);
  take_clock("/clock", {}, taken.takers);
  const std::string refused =
      "/clock: a clock, got none in sim or another time, allowed 0 to 2^31 s";
  EXPECT_EQ(taken.lines, (std::vector<std::string>{"/clock 12000000034", refused, refused}));
}

TEST(GazeboInbound, APoseIsThatOfTheBodyThatItNames) {
  Taken taken;
  take_pose("/p", pose_of("buoy", 3), kBodies, "boat", taken.takers);
  take_pose("/p", pose_of("", 4), kBodies, "boat", taken.takers);
  take_pose("/p", pose_of("", 5), kBodies, "", taken.takers);
  take_pose("/p", pose_of("ground_plane", 6), kBodies, "boat", taken.takers);
  take_pose("/p", pose_of("boat", -7), kBodies, "boat", taken.takers);
  EXPECT_EQ(taken.lines,
            (std::vector<std::string>{"/p buoy 3000000000 1.5 0 -2 0 0 0.6 0.8",
                                      "/p boat 4000000000 1.5 0 -2 0 0 0.6 0.8",
                                      "/p: a pose, got another stamp, allowed 0 to 2^31 s"}));
}

TEST(GazeboInbound, PosesOfAWorldHaveItsStampOrTheirOwn) {
  Taken taken;
  gz_msgs::Pose_V poses;
  poses.mutable_header()->mutable_stamp()->set_sec(8);
  *poses.add_pose() = pose_of("boat", 9);
  *poses.add_pose() = pose_of("tree", 9);
  *poses.add_pose() = pose_of("buoy", 9);
  poses.mutable_pose(2)->clear_header();
  take_poses("/w", poses, kBodies, "", taken.takers);
  EXPECT_EQ(taken.lines, (std::vector<std::string>{"/w boat 9000000000 1.5 0 -2 0 0 0.6 0.8",
                                                   "/w buoy 8000000000 1.5 0 -2 0 0 0.6 0.8"}));
}

TEST(GazeboInbound, TenThousandMutatedMessagesAreTakenOrRefused) {
  Taken taken;
  gz_msgs::Clock clock;
  clock.mutable_sim()->set_sec(12);
  clock.mutable_sim()->set_nsec(345);
  gz_msgs::Pose_V poses;
  *poses.add_pose() = pose_of("boat", 9);
  *poses.add_pose() = pose_of("buoy", 1LL << 40);
  const std::string clock_bytes = clock.SerializeAsString(), bytes = poses.SerializeAsString(),
                    pose_bytes = poses.pose(0).SerializeAsString();
  std::mt19937 random(11);
  for (int n = 0; n < 10'000; ++n) {
    gz_msgs::Clock wrong_clock;
    gz_msgs::Pose wrong_pose;
    gz_msgs::Pose_V wrong_poses;
    if (wrong_clock.ParseFromString(mutated(clock_bytes, random)))
      take_clock("/clock", wrong_clock, taken.takers);
    if (wrong_pose.ParseFromString(mutated(pose_bytes, random)))
      take_pose("/p", wrong_pose, kBodies, "boat", taken.takers);
    if (wrong_poses.ParseFromString(mutated(bytes, random)))
      take_poses("/w", wrong_poses, kBodies, "", taken.takers);
  }
  EXPECT_GT(taken.lines.size(), 5000u);
}

}  // namespace
}  // namespace swell::apps
