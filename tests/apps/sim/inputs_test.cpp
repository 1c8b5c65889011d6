// Clocks and poses from outside: what becomes of good ones, and what is said of bad ones.
#include "apps/sim/inputs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "apps/messages/cdr.h"
#include "apps/sim/json_inputs.h"
#include "apps/sim/ros_inputs.h"
#include "math/elementary.h"

namespace swell::apps {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr InputOrigin kHere{"/here"};
constexpr auto kNever = [] { return false; };

StampedPose pose_of(std::int64_t stamp_ns, const glm::dvec3& position_m, double yaw_rad = 0.0) {
  return {stamp_ns, position_m, {std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad)}};
}

// ---- Kept poses

TEST(InputPoses, BetweenTwoLieOnTheLineAndTheShorterTurn) {
  InputPoses poses;
  poses.add("boat", pose_of(200 * kMs, {4, 0, 2}, radians(100.0)));
  poses.add("boat", pose_of(100 * kMs, {0, 8, 2}, radians(10.0)));
  poses.set_horizon({1000 * kMs});
  const auto at = poses.at("boat", {125 * kMs});
  ASSERT_TRUE(at);
  EXPECT_NEAR(glm::length(at->position_m - glm::dvec3(1, 6, 2)), 0.0, 1e-12);
  EXPECT_NEAR(std::atan2(at->axes[0].y, at->axes[0].x), radians(32.5), 1e-12);
  // The same orientation with the other sign turns no farther.
  StampedPose other = pose_of(200 * kMs, {4, 0, 2}, radians(100.0));
  other.orientation = -other.orientation;
  poses.add("boat", other);
  EXPECT_NEAR(std::atan2(poses.at("boat", {125 * kMs})->axes[0].y, at->axes[0].x), radians(32.5),
              1e-12);
}

TEST(InputPoses, AreNotExtrapolated) {
  InputPoses poses;
  poses.add("boat", pose_of(100 * kMs, {1, 0, 0}));
  poses.add("boat", pose_of(200 * kMs, {2, 0, 0}));
  poses.set_horizon({1000 * kMs});
  EXPECT_FALSE(poses.at("boat", {99 * kMs}));
  EXPECT_FALSE(poses.at("ship", {500 * kMs}));
  EXPECT_EQ(poses.at("boat", {900 * kMs})->position_m.x, 2.0);
  poses.set_horizon({150 * kMs});  // the second one is not known yet
  EXPECT_EQ(poses.at("boat", {150 * kMs})->position_m.x, 1.0);
}

TEST(InputPoses, AreKeptInBoundedNumbers) {
  InputPoses poses;
  for (std::int64_t k = 0; k < 30'000; ++k) {
    poses.add("boat", pose_of(k * kMs, {static_cast<double>(k), 0, 0}));
    poses.set_horizon({k * kMs});
  }
  EXPECT_EQ(poses.at("boat", {29'999 * kMs})->position_m.x, 29'999.0);
  EXPECT_EQ(poses.at("boat", {20'000 * kMs})->position_m.x, 20'000.0);
  EXPECT_FALSE(poses.at("boat", {15'000 * kMs}));
}

TEST(InputPoses, OnACircleMoveAsItsFormulasSay) {
  constexpr double kRadius = 20.0, kRate = 0.3;
  const auto place = [](double t) {
    return kRadius * glm::dvec3(std::cos(kRate * t), std::sin(kRate * t), 0.0);
  };
  for (const std::int64_t period : {5 * kMs, 20 * kMs, 100 * kMs}) {
    InputPoses poses;
    for (std::int64_t t = 0; t <= 2000 * kMs; t += period)
      poses.add("boat", pose_of(t, place(Moment{t}.t_s()), kRate * Moment{t}.t_s() + 0.5 * kPi));
    poses.set_horizon({2000 * kMs});
    const auto window = poses.motion_window("boat", {2000 * kMs});
    ASSERT_TRUE(window);
    EXPECT_EQ(window->step_ns, std::max(period, kMotionStep_ns));
    const auto pose = [&](std::int64_t steps) {
      return *poses.at("boat", {window->end.t_ns - steps * window->step_ns});
    };
    const double h_s = Moment{window->step_ns}.t_s();
    const FrameMotion motion = motion_behind(pose(2), pose(1), pose(0), h_s);
    const glm::dvec3 velocity = kRate * glm::dvec3(-place(2.0).y, place(2.0).x, 0.0);
    EXPECT_NEAR(glm::length(motion.velocity_mps - velocity), 0.0, 2e-3);
    const glm::dvec3 acceleration = -kRate * kRate * place(2.0 - h_s);
    EXPECT_NEAR(glm::length(motion.acceleration_mps2 - acceleration), 0.0, 2e-3);
    EXPECT_NEAR(glm::length(motion.turn_rad_s - glm::dvec3(0, 0, kRate)), 0.0, 1e-9);
  }
}

TEST(InputPoses, ThatAreTooFewSayNothingOfMotion) {
  InputPoses poses;
  poses.add("boat", pose_of(0, {1, 0, 0}));
  poses.set_horizon({70 * kMs});
  EXPECT_FALSE(poses.motion_window("boat", {70 * kMs}));
  poses.add("boat", pose_of(20 * kMs, {1, 0, 0}));
  poses.add("boat", pose_of(40 * kMs, {1, 0, 0}));
  poses.add("boat", pose_of(80 * kMs, {1, 0, 0}));
  EXPECT_FALSE(poses.motion_window("boat", {70 * kMs}));
  poses.set_horizon({90 * kMs});
  ASSERT_TRUE(poses.motion_window("boat", {90 * kMs}));
  EXPECT_EQ(poses.motion_window("boat", {90 * kMs})->end.t_ns, 80 * kMs);
  poses.set_horizon({2000 * kMs});  // for over a second none came: it stands still
  EXPECT_EQ(poses.motion_window("boat", {2000 * kMs})->end.t_ns, 2000 * kMs);
}

// ---- What comes in

// What `put` makes Inputs say, with the ticks and poses that come of it.
struct Taken {
  std::string said;
  std::vector<Inputs::Tick> ticks;
  InputPoses poses;
};

template <class Put>
void take_all(const Put& put, Taken& taken) {
  Inputs inputs({"boat", "buoy"});
  testing::internal::CaptureStderr();
  put(inputs);
  for (Inputs::Tick tick; inputs.next_tick(tick, taken.poses, kNever);) taken.ticks.push_back(tick);
  taken.said = testing::internal::GetCapturedStderr();
}

TEST(Inputs, GivePosesWithTheClockThatComesAfterThem) {
  Inputs inputs({"boat"});
  InputPoses poses;
  inputs.put_pose(kHere, "boat", pose_of(0, {1, 0, 0}));
  inputs.put_pose(kHere, "boat", pose_of(10 * kMs, {2, 0, 0}));  // early
  inputs.put_clock(kHere, 0);
  inputs.put_clock(kHere, 0);  // says nothing new
  inputs.put_clock(kHere, 10 * kMs);
  inputs.put_pose(kHere, "boat", pose_of(20 * kMs, {3, 0, 0}));
  Inputs::Tick tick;
  ASSERT_TRUE(inputs.next_tick(tick, poses, kNever));
  EXPECT_TRUE(tick.t_ns == 0 && tick.is_start);
  EXPECT_EQ(poses.at("boat", {10 * kMs})->position_m.x, 1.0);
  ASSERT_TRUE(inputs.next_tick(tick, poses, kNever));
  EXPECT_TRUE(tick.t_ns == 10 * kMs && !tick.is_start);
  EXPECT_EQ(poses.at("boat", {20 * kMs})->position_m.x, 2.0);
  EXPECT_FALSE(inputs.next_tick(tick, poses, kNever));
}

TEST(Inputs, StartAgainWhereTheClockJumps) {
  Taken taken;
  take_all(
      [](Inputs& inputs) {
        inputs.put_pose(kHere, "boat", pose_of(5'000 * kMs, {1, 0, 0}));
        inputs.put_clock({"/clock"}, 5'000 * kMs);
        inputs.put_pose(kHere, "boat", pose_of(5'010 * kMs, {2, 0, 0}));  // of the old time
        inputs.put_pose(kHere, "boat", pose_of(0, {3, 0, 0}));            // of the new one
        inputs.put_clock({"/clock"}, 0);
        inputs.put_clock({"/clock"}, 10'000 * kMs);
        inputs.put_clock({"/clock"}, 20'001 * kMs);
      },
      taken);
  ASSERT_EQ(taken.ticks.size(), 4u);
  EXPECT_TRUE(taken.ticks[1].is_start);
  EXPECT_FALSE(taken.ticks[2].is_start);
  EXPECT_TRUE(taken.ticks[3].is_start);
  EXPECT_EQ(taken.said, "note: /clock: jumped from 5 s to 0 s; starting again there\n");
  EXPECT_FALSE(taken.poses.at("boat", {30'000 * kMs}));
}

// As those of Gazebo's server do.
TEST(Inputs, WaitForPosesThatComeAfterTheirClock) {
  Inputs inputs({"boat", "buoy"});
  InputPoses poses;
  inputs.put_pose(kHere, "buoy", pose_of(0, {5, 0, 0}));
  for (std::int64_t k = 0; k < 20; ++k) {
    inputs.put_clock({"/clock"}, 10 * k * kMs);
    inputs.put_pose({"/boat/pose"}, "boat", pose_of(10 * k * kMs, {static_cast<double>(k), 0, 0}));
  }
  inputs.put_clock({"/clock"}, 200 * kMs);  // which has no pose
  inputs.put_clock({"/clock"}, 210 * kMs);
  testing::internal::CaptureStderr();
  const auto boat_x = [&](std::int64_t t_ns) {
    Inputs::Tick tick;
    EXPECT_TRUE(inputs.next_tick(tick, poses, kNever));
    EXPECT_EQ(tick.t_ns, t_ns);
    const auto boat = poses.at("boat", {t_ns});
    return boat ? boat->position_m.x : -1.0;
  };
  EXPECT_EQ(boat_x(0), -1.0);
  for (std::int64_t k = 1; k < 20; ++k) EXPECT_EQ(boat_x(10 * k * kMs), static_cast<double>(k));
  EXPECT_EQ(boat_x(200 * kMs), 19.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "note: /boat/pose: the pose of boat for 0 s came after the clock had shown 0 s, whose "
            "messages are without it; from now on they wait for it\n");
  inputs.begin();  // more may come
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(boat_x(210 * kMs), 19.0);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(500));
  inputs.end();
}

TEST(Inputs, WaitForNobodyWhosePosesComeFirst) {
  Inputs inputs({"boat"});
  InputPoses poses;
  inputs.begin();
  testing::internal::CaptureStderr();
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t k = 0; k <= 20; ++k) {  // a pose each fourth time; said again, it is no other
    const std::int64_t stamp_ns = k / 4 * 40 * kMs;
    inputs.put_pose({"/boat/pose"}, "boat", pose_of(stamp_ns, {static_cast<double>(k / 4), 0, 0}));
    inputs.put_clock({"/clock"}, 10 * k * kMs);
    Inputs::Tick tick;
    ASSERT_TRUE(inputs.next_tick(tick, poses, kNever));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  inputs.end();
}

struct BadPose {
  const char* said;
  StampedPose pose;
  const char* frame = "boat";
};

TEST(Inputs, ThatAreNotRightAreToldOfInOneLine) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const BadPose cases[] = {
      {"a pose, got the body \"ship\", allowed bodies of the rig with pose = \"input\": boat, buoy",
       pose_of(0, {}), "ship"},
      {"a pose, got a position with nan, allowed -1e6 to 1e6 m", pose_of(0, {0, kNan, 0})},
      {"a pose, got a position with inf, allowed -1e6 to 1e6 m", pose_of(0, {kInf, 0, 0})},
      {"a pose, got a position with 2000000, allowed -1e6 to 1e6 m", pose_of(0, {2e6, 0, 0})},
      {"a pose, got a quaternion of length 0, allowed 1", {0, {}, {0, 0, 0, 0}}},
      {"a pose, got a quaternion of length nan, allowed 1", {0, {}, {kNan, 0, 0, 0}}},
      {"a pose, got a quaternion of length 0.5, allowed 1", {0, {}, {0.5, 0, 0, 0}}},
      {"a pose, got the stamp -1 ns, allowed 0 to 2^31 s", pose_of(-1, {})},
  };
  for (const BadPose& bad : cases) {
    Taken taken;
    take_all(
        [&](Inputs& inputs) {
          for (int again = 0; again < 3; ++again) inputs.put_pose(kHere, bad.frame, bad.pose);
          inputs.put_clock(kHere, 0);
        },
        taken);
    EXPECT_EQ(taken.said,
              fmt::format("warning: /here: {}; left out, as are more like it\n", bad.said));
    EXPECT_FALSE(taken.poses.at(bad.frame, {0}));
  }
  Taken taken;
  take_all([](Inputs& inputs) { inputs.put_clock(kHere, -5); }, taken);
  EXPECT_EQ(taken.said,
            "warning: /here: a clock, got -5 ns, allowed 0 to 2^31 s; left out, as are more like "
            "it\n");
  EXPECT_TRUE(taken.ticks.empty());
}

TEST(Inputs, ComeAsLinesOfJson) {
  Taken taken;
  take_all(
      [](Inputs& inputs) {
        take_json_line(R"({"body": "boat", "stamp_ns": 7, "position": [1, 2.5, 3], )"
                       R"("orientation": [0, 0, 1, 0]})",
                       kHere, inputs);
        take_json_line(" ", kHere, inputs);
        take_json_line(R"({"clock_ns": 7})", kHere, inputs);
      },
      taken);
  EXPECT_EQ(taken.said, "");
  ASSERT_EQ(taken.ticks.size(), 1u);
  const auto pose = taken.poses.at("boat", {7});
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->position_m, glm::dvec3(1, 2.5, 3));
  EXPECT_EQ(pose->axes[0], glm::dvec3(-1, 0, 0));
  constexpr const char* kShortPosition =
      R"({"body": "boat", "stamp_ns": 7, "position": [1, 2], "orientation": [0, 0, 1, 0]})";
  for (const char* line :
       {"{", "[]", "7", "{\"clock_ns\": 1.5}", "{\"clock_ns\": 1, \"x\": 2}",
        "{\"clock_ns\": 18446744073709551615}", "{\"body\": 3}", kShortPosition}) {
    Taken none;
    take_all([&](Inputs& inputs) { take_json_line(line, {"lines", 12}, inputs); }, none);
    EXPECT_TRUE(none.said.starts_with("warning: lines:12: got another line, allowed ")) << line;
    EXPECT_TRUE(none.ticks.empty());
  }
}

// Bytes changed and left out, and numbers put in.
TEST(Inputs, TenThousandDamagedLinesAreTakenOrLeftOut) {
  const std::string whole[] = {
      R"({"clock_ns": 20000000})",
      R"({"body": "boat", "stamp_ns": 10000000, "position": [1, -2, 3e1], )"
      R"("orientation": [0.0, 0, 0, 1]})",
      R"({"disturbance": {"kind": "drop", "position_m": [1, 2], "height_m": 0.2}, "stamp_ns": 0})"};
  const char* words[] = {"1e999", "-1", "null", "\"", "[", "{", "9223372036854775808", "\\u0000"};
  std::mt19937_64 random(9);
  Taken taken;
  take_all(
      [&](Inputs& inputs) {
        for (int n = 0; n < 10'000; ++n) {
          std::string line = whole[random() % 3];
          for (auto damages = random() % 4; damages-- > 0;) {
            const std::size_t at = random() % line.size();
            if (random() % 3 == 0)
              line.insert(at, words[random() % 8]);
            else if (random() % 2 == 0)
              line[at] = static_cast<char>(random());
            else
              line.erase(at, 1 + random() % 5);
            if (line.empty()) line = " ";
          }
          take_json_line(line, {"lines", n}, inputs);
        }
      },
      taken);
  EXPECT_GT(taken.ticks.size(), 100u);
  EXPECT_LE(std::ranges::count(taken.said, '\n'), 3);  // damages, jumps, poses that are late
}

// ---- Messages of ROS 2

std::vector<std::uint8_t> pose_message_bytes(const std::string& frame, double x) {
  msg::PoseStamped message;
  message.header = {{3, 250'000'000}, frame};
  message.pose.position = {x, 2.0, 3.0};
  message.pose.orientation = {0.0, 0.0, 1.0, 0.0};
  return cdr_bytes(message);
}

std::string said_of_pose(const std::vector<std::uint8_t>& bytes) {
  Taken taken;
  take_all([&](Inputs& inputs) { take_pose_message(bytes, "boat", kHere, inputs); }, taken);
  return taken.said;
}

TEST(RosInputs, AreTakenInBothByteOrders) {
  // By hand: 1 s and 2 ns.
  const std::vector<std::uint8_t> little = {0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0};
  const std::vector<std::uint8_t> big = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2};
  for (const auto& clock : {little, big}) {
    Taken taken;
    take_all(
        [&](Inputs& inputs) {
          take_pose_message(pose_message_bytes("odom", 1.0), "boat", kHere, inputs);
          take_clock_message(clock, kHere, inputs);
          take_clock_message(cdr_bytes(msg::Clock{{4, 0}}), kHere, inputs);
        },
        taken);
    EXPECT_EQ(taken.said, "");
    ASSERT_EQ(taken.ticks.size(), 2u);
    EXPECT_EQ(taken.ticks[0].t_ns, 1'000'000'002);
    EXPECT_FALSE(taken.poses.at("boat", {3'249'999'999}));
    EXPECT_EQ(taken.poses.at("boat", {3'250'000'000})->position_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(taken.poses.at("boat", {3'250'000'000})->axes[0], glm::dvec3(-1, 0, 0));
  }
}

TEST(RosInputs, WhoseBytesAreOfNoSuchMessageAreToldOf) {
  const std::vector<std::uint8_t> right = pose_message_bytes("map", 1.0);
  EXPECT_EQ(said_of_pose(right), "");
  const std::string none = fmt::format(
      "warning: /here: got {} bytes that are no PoseStamped, allowed geometry_msgs/msg/PoseStamped "
      "in CDR; left out, as are more like it\n",
      right.size());
  auto lies = right;
  lies[15] = 0x7f;  // the length of the text
  EXPECT_EQ(said_of_pose(lies), none);
  auto endless = right;
  endless[19] = 'x';  // "mapx"
  EXPECT_EQ(said_of_pose(endless), none);
  auto other = right;
  other[1] = 3;  // another encoding
  EXPECT_EQ(said_of_pose(other), none);
  auto late = right;
  late[11] = 0x7f;  // nanoseconds
  EXPECT_EQ(said_of_pose(late), none);
  for (std::size_t size = 0; size < right.size(); ++size)
    EXPECT_NE(said_of_pose({right.begin(), right.begin() + static_cast<std::ptrdiff_t>(size)}), "");
  EXPECT_EQ(said_of_pose(pose_message_bytes("camera_link", 1.0)),
            "warning: /here: a pose, got the frame_id \"camera_link\", allowed map or odom; left "
            "out, as are more like it\n");
  EXPECT_EQ(said_of_pose(pose_message_bytes("", 1.0)), "");
}

TEST(RosInputs, TenThousandDamagedMessagesAreTakenOrLeftOut) {
  const auto whole = {pose_message_bytes("map", 1.0), cdr_bytes(msg::Clock{{4, 5}})};
  std::mt19937_64 random(11);
  Taken taken;
  take_all(
      [&](Inputs& inputs) {
        for (int n = 0; n < 10'000; ++n) {
          const bool is_pose = random() % 2 == 0;
          std::vector<std::uint8_t> bytes = *(whole.begin() + (is_pose ? 0 : 1));
          for (auto damages = random() % 4; damages-- > 0 && !bytes.empty();) {
            if (random() % 3 == 0)
              bytes.resize(random() % (2 * bytes.size()));
            else
              bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
          }
          if (is_pose)
            take_pose_message(bytes, "boat", {"/boat/pose"}, inputs);
          else
            take_clock_message(bytes, {"/clock"}, inputs);
        }
      },
      taken);
  EXPECT_GT(taken.ticks.size(), 100u);
  EXPECT_EQ(std::ranges::count(taken.said, '\n'), 4);  // two of damages, jumps, poses that are late
}

}  // namespace
}  // namespace swell::apps
