// What Gazebo's programs may ask of the water, against the water itself.
#include "apps/gazebo/water_services.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "apps/gazebo/mutation.h"
#include "scene/scene.h"

namespace swell::apps {
namespace {

scene::Water windy_water(const char* text = "[wind]\nspeed_mps = 8\nfrom_deg = 250\n") {
  return scene::Water(scene::parse_scene(text, "scene.toml"));
}

gz_msgs::Pose_V request_of(const std::vector<glm::dvec2>& points) {
  gz_msgs::Pose_V request;
  for (const glm::dvec2& point : points) {
    gz_msgs::Pose& pose = *request.add_pose();
    pose.mutable_position()->set_x(point.x);
    pose.mutable_position()->set_y(point.y);
  }
  return request;
}

void set_stamp(gz_msgs::Pose_V& request, std::int64_t sec, std::int32_t nsec) {
  request.mutable_header()->mutable_stamp()->set_sec(sec);
  request.mutable_header()->mutable_stamp()->set_nsec(nsec);
}

std::vector<glm::dvec2> some_points() {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(3.7 * i - 60.0, 250.0 - 11.3 * i);
  return points;
}

// That the answer is the water's at t_s.
void expect_water(const scene::Water& water, double t_s, const gz_msgs::Pose_V& reply) {
  Workers workers(1);
  ocean::SeaFrame frame;
  const ocean::WaterSurface surface = water.at(t_s, frame, workers);
  for (const gz_msgs::Pose& pose : reply.pose()) {
    const glm::dvec2 at(pose.position().x(), pose.position().y());
    EXPECT_EQ(pose.position().z(), static_cast<double>(surface.height(at)));
    const glm::dquat turn(pose.orientation().w(), pose.orientation().x(), pose.orientation().y(),
                          pose.orientation().z());
    EXPECT_NEAR(glm::length(turn), 1.0, 1e-6);
    const glm::dvec3 up = turn * glm::dvec3(0.0, 0.0, 1.0);
    glm::vec2 slope;
    surface.slopes({&at, 1}, {&slope, 1});
    EXPECT_NEAR(up.x / up.z, -static_cast<double>(slope.x), 1e-5);
    EXPECT_NEAR(up.y / up.z, -static_cast<double>(slope.y), 1e-5);
  }
}

TEST(WaterServices, HeightsAreTheWatersNowOrAtAStamp) {
  const scene::Water water = windy_water();
  WaterServices services(water);
  gz_msgs::Pose_V request = request_of(some_points()), reply;
  request.mutable_pose(1)->set_name("bow");
  request.mutable_pose(1)->mutable_position()->set_z(77.0);
  ASSERT_TRUE(services.heights(request, reply));
  EXPECT_EQ(reply.header().stamp().sec(), 0);
  ASSERT_EQ(reply.pose_size(), 50);
  EXPECT_EQ(reply.pose(1).name(), "bow");
  expect_water(water, 0.0, reply);
  services.set_time(2'050'000'000);
  ASSERT_TRUE(services.heights(request, reply));
  EXPECT_EQ(reply.header().stamp().sec(), 2);
  EXPECT_EQ(reply.header().stamp().nsec(), 50'000'000);
  expect_water(water, 2.05, reply);
  set_stamp(request, 100, 250'000'000);
  ASSERT_TRUE(services.heights(request, reply));
  EXPECT_EQ(reply.header().stamp().sec(), 100);
  expect_water(water, 100.25, reply);
  ASSERT_TRUE(services.heights({}, reply));
  EXPECT_EQ(reply.pose_size(), 0);
}

TEST(WaterServices, WhatIsNotRightIsRefusedAndToldOfOnce) {
  WaterServices services(windy_water());
  gz_msgs::Pose_V reply;
  const double none = std::numeric_limits<double>::quiet_NaN();
  testing::internal::CaptureStderr();
  EXPECT_FALSE(services.heights(request_of({{0.0, 0.0}, {none, 1.0}}), reply));
  EXPECT_FALSE(services.heights(request_of({{0.0, -1e9}}), reply));
  EXPECT_FALSE(
      services.heights(request_of({{std::numeric_limits<double>::infinity(), 0.0}}), reply));
  EXPECT_FALSE(services.heights(request_of(std::vector<glm::dvec2>(1'000'000)), reply));
  gz_msgs::Pose_V early = request_of({{0.0, 0.0}});
  set_stamp(early, -1, 0);
  EXPECT_FALSE(services.heights(early, reply));
  set_stamp(early, std::numeric_limits<std::int64_t>::max(), 0);
  EXPECT_FALSE(services.heights(early, reply));
  set_stamp(early, 0, 1'000'000'000);
  EXPECT_FALSE(services.heights(early, reply));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "warning: /water/heights: got a position at nan 1, allowed below 1000000000 m\n");
  EXPECT_TRUE(services.heights(request_of({{0.0, 0.0}}), reply));
}

TEST(WaterServices, ManyThreadsGetTheSameAnswers) {
  const scene::Water water = windy_water();
  WaterServices services(water);
  std::vector<std::thread> threads;
  std::vector<gz_msgs::Pose_V> replies(16);
  for (std::size_t n = 0; n < replies.size(); ++n)
    threads.emplace_back([&, n] {
      gz_msgs::Pose_V request = request_of(some_points());
      set_stamp(request, static_cast<std::int64_t>(n % 4), 0);
      EXPECT_TRUE(services.heights(request, replies[n]));
      services.set_time(static_cast<std::int64_t>(n));
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t n = 0; n < replies.size(); ++n)
    expect_water(water, static_cast<double>(n % 4), replies[n]);
}

TEST(WaterServices, TheSeaStateIsWhatTheSceneAsksFor) {
  WaterServices services(windy_water(R"(
[wind]
speed_mps = 10
from_deg = 250
[sea]
hs_m = 1.5
tp_s = 6
[[sea.swell]]
hs_m = 2.5
tp_s = 13
from_deg = 300
)"));
  gz_msgs::Param sea;
  ASSERT_TRUE(services.sea_state({}, sea));
  const auto number = [](const gz_msgs::Param& of, const char* key) {
    EXPECT_EQ(of.params().at(key).type(), gz_msgs::Any::DOUBLE);
    return of.params().at(key).double_value();
  };
  EXPECT_EQ(number(sea, "wind_speed_mps"), 10.0);
  EXPECT_NEAR(number(sea, "wind_from_deg"), 250.0, 1e-9);
  EXPECT_NEAR(number(sea, "significant_height_m"), std::hypot(1.5, 2.5), 0.3);  // of this seed
  EXPECT_NEAR(number(sea, "peak_period_s"), 13.0, 1e-9);
  EXPECT_NEAR(number(sea, "waves_from_deg"), 300.0, 1e-9);
  EXPECT_GT(number(sea, "mean_wavelength_m"), 5.0);
  ASSERT_EQ(sea.children_size(), 2);
  EXPECT_NEAR(number(sea.children(0), "significant_height_m"), 1.5, 1e-5);
  EXPECT_NEAR(number(sea.children(0), "peak_period_s"), 6.0, 1e-9);
  EXPECT_NEAR(number(sea.children(0), "from_deg"), 250.0, 1e-9);
  EXPECT_NEAR(number(sea.children(1), "significant_height_m"), 2.5, 1e-5);
  WaterServices calm(windy_water("[wind]\nspeed_mps = 0\n"));
  ASSERT_TRUE(calm.sea_state({}, sea));
  EXPECT_EQ(number(sea, "significant_height_m"), 0.0);
  EXPECT_EQ(sea.params().count("peak_period_s"), 0u);
  EXPECT_EQ(sea.children_size(), 0);
}

TEST(WaterServices, TenThousandMutatedRequestsAreAnsweredOrRefused) {
  WaterServices services(windy_water("[sea]\nresolution = 16\npatch_lengths_m = [100]\n"));
  gz_msgs::Pose_V request = request_of({{1.0, 2.0}, {-30.0, 40.0}, {1e6, -1e6}});
  set_stamp(request, 3, 141'592'653);
  request.mutable_pose(2)->set_name("stern");
  const std::string bytes = request.SerializeAsString();
  std::mt19937 random(7);
  testing::internal::CaptureStderr();
  int read = 0, answered = 0;
  for (int n = 0; n < 10'000; ++n) {
    gz_msgs::Pose_V wrong, reply;
    if (!wrong.ParseFromString(mutated(bytes, random))) continue;
    ++read;
    if (!services.heights(wrong, reply)) continue;
    ++answered;
    for (const gz_msgs::Pose& pose : reply.pose()) ASSERT_TRUE(std::isfinite(pose.position().z()));
  }
  testing::internal::GetCapturedStderr();
  EXPECT_GT(read, 1000);
  EXPECT_GT(answered, 500);
  EXPECT_LT(answered, read);
}

}  // namespace
}  // namespace swell::apps
