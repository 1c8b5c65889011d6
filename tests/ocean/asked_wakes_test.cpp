// Wakes that are made when they are asked: against those that are made at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "math/random.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

constexpr double kGravity_mps2 = 9.81, kAsked_s = 9.0;

// Two hulls under way far from each other, and a drop between them.
std::vector<Disturbance> two_hulls_and_a_drop() {
  Disturbance west, east, drop;
  west.kind = east.kind = DisturbanceKind::kHull;
  west.path_m = {{-300.0, 0.0}, {-200.0, 10.0}, {-220.0, 60.0}};
  east.path_m = {{250.0, 0.0}, {300.0, 40.0}, {350.0, -20.0}};
  east.hull_m = {1.8, 5.2, 0.4};
  drop.t_s = 6.0, drop.radius_m = 0.5, drop.height_m = 0.3;
  return {west, east, drop};
}

WakeFrame frame_of(const std::vector<Disturbance>& list, MakeWakes when) {
  Workers workers(2);
  WakeFrame frame;
  advance_wakes(list, {}, kGravity_mps2, kAsked_s, frame, workers, nullptr, when);
  return frame;
}

struct Answers {
  std::vector<float> height_m, foam;
  std::vector<glm::vec2> slope;
  bool operator==(const Answers&) const = default;
};
Answers answers_of(const WakeFrame& frame, std::span<const glm::dvec2> points) {
  Answers answers{std::vector<float>(points.size()), std::vector<float>(points.size()),
                  std::vector<glm::vec2>(points.size())};
  add_wake_heights(frame, points, answers.height_m);
  add_wake_foam(frame, points, answers.foam);
  add_wake_slopes(frame, points, answers.slope);
  return answers;
}

// In the windows and beside them.
std::vector<glm::dvec2> places(std::uint64_t count) {
  std::vector<glm::dvec2> p;
  for (std::uint64_t n = 0; n < count; ++n)
    p.push_back(
        {800.0 * (random_uniform(11, 2 * n) - 0.5), 160.0 * (random_uniform(11, 2 * n + 1) - 0.5)});
  return p;
}

glm::dvec2 middle_of(const WakeWindow& window) { return window.corner_m + 0.5 * window.length_m; }

TEST(AskedWakes, HaveTheBitsOfThoseThatAreMadeAtOnce) {
  const std::vector<Disturbance> list = two_hulls_and_a_drop();
  const std::vector<glm::dvec2> points = places(20000);
  const Answers at_once = answers_of(frame_of(list, MakeWakes::kNow), points);
  EXPECT_GT(std::ranges::max(at_once.height_m), 0.02f);
  EXPECT_GT(std::ranges::max(at_once.foam), 0.02f);
  EXPECT_EQ(answers_of(frame_of(list, MakeWakes::kWhenAsked), points), at_once);
}

TEST(AskedWakes, AreMadeWhereAPointAsksAndNoMoreThanItAsks) {
  const WakeFrame frame = frame_of(two_hulls_and_a_drop(), MakeWakes::kWhenAsked);
  ASSERT_EQ(frame.count, 3u);
  const glm::dvec2 inside = middle_of(frame.windows[1]), outside(0.0, 900.0);
  float z = 0.0f, foam = 0.0f;
  add_wake_heights(frame, {&outside, 1}, {&z, 1});
  for (std::size_t w = 0; w < 3; ++w) EXPECT_EQ(frame.made.of(w), WakeFields::kNone) << w;
  add_wake_heights(frame, {&inside, 1}, {&z, 1});
  EXPECT_EQ(frame.made.of(0), WakeFields::kNone);
  EXPECT_EQ(frame.made.of(1), WakeFields::kHeights);
  add_wake_foam(frame, {&inside, 1}, {&foam, 1});
  EXPECT_EQ(frame.made.of(1), WakeFields::kAll);
  EXPECT_EQ(frame.made.of(2), WakeFields::kNone);
}

TEST(AskedWakes, ManyThreadsGetTheSameBits) {
  const std::vector<Disturbance> list = two_hulls_and_a_drop();
  const std::vector<glm::dvec2> points = places(4000);
  const Answers at_once = answers_of(frame_of(list, MakeWakes::kNow), points);
  for (int round = 0; round < 5; ++round) {
    const WakeFrame frame = frame_of(list, MakeWakes::kWhenAsked);
    std::vector<Answers> answers(8);
    Workers workers(4);
    workers.for_each(answers.size(),
                     [&](std::size_t n, int) { answers[n] = answers_of(frame, points); });
    for (const Answers& own : answers) ASSERT_EQ(own, at_once);
  }
}

TEST(AskedWakes, VelocitiesAndAFrameThatIsUsedAgainAreTheSame) {
  const std::vector<Disturbance> list = two_hulls_and_a_drop();
  const std::vector<glm::dvec2> points = places(4000);
  Workers workers(1);
  WakeFrame used = frame_of({list[0]}, MakeWakes::kWhenAsked), velocity, asked_velocity;
  answers_of(used, points);
  const WakeFrame now = frame_of(list, MakeWakes::kNow);
  advance_wakes(list, {}, kGravity_mps2, kAsked_s, used, workers, nullptr, MakeWakes::kWhenAsked);
  advance_wake_velocity(now, WakeField::kRise, velocity, workers);
  advance_wake_velocity(used, WakeField::kRise, asked_velocity, workers);
  std::vector<float> rise_mps(points.size()), asked_rise_mps(points.size());
  add_wake_heights(velocity, points, rise_mps);
  add_wake_heights(asked_velocity, points, asked_rise_mps);
  EXPECT_GT(std::ranges::max(rise_mps), 0.01f);
  EXPECT_EQ(asked_rise_mps, rise_mps);
  EXPECT_EQ(answers_of(used, points), answers_of(now, points));
  advance_wakes(list, {}, kGravity_mps2, kAsked_s, used, workers);
  for (std::size_t w = 0; w < used.count; ++w) EXPECT_EQ(used.made.of(w), WakeFields::kAll);
  EXPECT_EQ(answers_of(used, points), answers_of(now, points));
}

}  // namespace
}  // namespace swell::ocean
