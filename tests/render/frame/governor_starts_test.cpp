// The frame governor from a program's start on: slow first frames, other programs, and what share
// of the budget is used in the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "render/frame/governed_flight.h"

namespace swell::render {
namespace {

constexpr double kShow_ms = 1.6;  // of the viewer under Xvfb
constexpr int kThreeSeconds = 3 * kSecond;
constexpr Noise kNoise{.sigma = 0.03};

// A scene that takes such a share of the budget at full quality, with what shows it.
Load load_of(const Load& scene, double share) {
  const double full_ms = simulate(scene, full_quality(), {}, 0).frame_ms;
  return scene.times((share * kBudget_ms - kShow_ms) / full_ms);
}

// How much slower frames are at a start: storage is made, pages are touched for the first time, and
// the processor's clock goes up.
double slow_start_factor(int frame) {
  constexpr std::array kFactors = {14.0, 3.1, 2.2, 1.9, 2.4, 1.6, 1.5, 1.5, 1.4};
  if (frame < static_cast<int>(kFactors.size())) return kFactors[static_cast<std::size_t>(frame)];
  return frame < 40 ? 1.3 : 1.0;
}

double share_with_most_triangles(const Flight& run, std::size_t first) {
  const auto begin = run.options.begin() + static_cast<std::ptrdiff_t>(first);
  return static_cast<double>(
             std::count_if(begin, run.options.end(),
                           [](const FrameOptions& o) { return o.water_triangles >= 28500; })) /
         static_cast<double>(run.options.end() - begin);
}

constexpr std::array kScenes = {kOpenSea, kLagoon, kCoast};
constexpr std::array kFittingShares = {0.6, 0.9, 0.95, 0.99};

TEST(GovernorStart, ASceneThatFitsIsWholeAfterThreeSecondsAndStaysSo) {
  for (const Load& scene : kScenes)
    for (const double share : kFittingShares) {
      const Load load = load_of(scene, share);
      const auto at = [&](int k) { return load.times(slow_start_factor(k)); };
      const Flight r = run(3600, at, kNoise, kShow_ms);
      for (std::size_t k = kThreeSeconds; k < r.options.size(); ++k)
        ASSERT_TRUE(is_full_size(r.options[k])) << share << ' ' << k;
      EXPECT_GE(share_with_most_triangles(r, kThreeSeconds), 0.98) << share;
    }
}

// As on a virtual machine with nothing else running: one frame in 30 waits for a processor. Lagoon
// takes 14.5 ms at 1280x720, and 1.6 ms to show.
TEST(GovernorStart, SingleLateFramesLeaveASceneThatFitsWhole) {
  for (const double share : {0.9, 16.1 / kBudget_ms})
    for (const double late_factor : {1.2, 1.3, 1.45})
      for (const std::uint64_t seed : {1, 2, 3}) {
        const Load load = load_of(kLagoon, share);
        const std::vector<double> late = other_work(2400, 1, 20, late_factor, seed);
        const auto at = [&](int k) {
          return load.times(slow_start_factor(k) * late[static_cast<std::size_t>(k)]);
        };
        const Flight r = run(2400, at, kNoise, kShow_ms);
        for (std::size_t k = kThreeSeconds; k < r.options.size(); ++k)
          ASSERT_TRUE(is_full_size(r.options[k])) << share << ' ' << late_factor << ' ' << k;
        EXPECT_GE(share_with_most_triangles(r, kThreeSeconds), 0.98) << share << late_factor;
      }
}

TEST(GovernorStart, ASecondOfOtherWorkCostsThreeSecondsOfASmallerPictureAtMost) {
  constexpr int kBegin = 600, kEnd = kBegin + kSecond;
  for (const Load& scene : kScenes)
    for (const double share : kFittingShares)
      for (const double factor : {1.3, 2.0, 4.0}) {
        const Load load = load_of(scene, share);
        const auto at = [&](int k) {
          return load.times(slow_start_factor(k) * (k >= kBegin && k < kEnd ? factor : 1.0));
        };
        const Flight r = run(1800, at, kNoise, kShow_ms);
        for (std::size_t k = kEnd + kThreeSeconds; k < r.options.size(); ++k)
          ASSERT_TRUE(is_full_size(r.options[k])) << share << ' ' << factor << ' ' << k;
        EXPECT_GE(share_with_most_triangles(r, kEnd + kThreeSeconds), 0.9) << share << factor;
      }
}

TEST(GovernorStart, PhasesOfSlowFramesCostThreeSecondsEachAtMost) {
  for (const double share : kFittingShares) {
    const Load load = load_of(kLagoon, share);
    const std::vector<double> late = other_work(3600, 20, 300, 1.3, 7);
    const auto at = [&](int k) {
      return load.times(slow_start_factor(k) * late[static_cast<std::size_t>(k)]);
    };
    const Flight r = run(3600, at, kNoise, kShow_ms);
    for (std::size_t k = kThreeSeconds, quiet = 0; k < late.size(); ++k) {
      quiet = late[k] > 1.0 ? 0 : quiet + 1;
      if (quiet > kThreeSeconds) {
        ASSERT_TRUE(is_full_size(r.options[k])) << share << ' ' << k;
      }
    }
  }
}

TEST(GovernorStart, ASceneThatDoesNotFitUsesTheBudgetAndKeepsItsSize) {
  for (const Load& scene : kScenes)
    for (const double share : {1.1, 1.2, 1.35, 1.5, 2.0, 2.5, 3.0}) {
      const Load load = load_of(scene, share);
      const auto at = [&](int k) { return load.times(slow_start_factor(k)); };
      const Flight r = run(3600, at, kNoise, kShow_ms);
      EXPECT_GE(median_ms(r, 1800), 0.88 * kBudget_ms) << scene.shade_ms << ' ' << share;
      EXPECT_LE(median_ms(r, 1800), 1.0 * kBudget_ms) << scene.shade_ms << ' ' << share;
      EXPECT_LE(size_changes(r, 10 * kSecond), 2) << scene.shade_ms << ' ' << share;
    }
}

// Nowhere does the size jump for a small change of the load.
TEST(GovernorStart, SizesComeInFineSteps) {
  std::vector<double> scales;
  for (double share = 1.0; share < 3.0; share += 0.01) {
    const Load load = load_of(kOpenSea, share);
    const Flight r = run(
        1200, [&](int) { return load; }, {}, kShow_ms);
    scales.push_back(r.options.back().picture_scale);
  }
  std::ranges::sort(scales);
  const auto [end, last] = std::ranges::unique(scales);
  scales.erase(end, last);
  EXPECT_GE(scales.size(), 15);
  for (std::size_t i = 1; i < scales.size(); ++i)
    EXPECT_LE(scales[i] - scales[i - 1], 0.1) << scales[i];
}

}  // namespace
}  // namespace swell::render
