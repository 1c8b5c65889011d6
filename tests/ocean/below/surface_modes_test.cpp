// The depths of the ladder, and the modes of a square below the surface: the decays in closed form.
#include "ocean/below/surface_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/below/depth_ladder.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

TEST(DepthLadder, KeepsEveryDecayWithinItsBound) {
  double worst = 0.0;
  for (double k = 1e-4; k < kTurn / 0.25; k *= 1.3)
    for (double s = 1e-3; s < 1e4; s *= 1.07) {
      const RungWeights at = rung_weights(s);
      double sum = 0.0;
      for (std::size_t n = 0; n < 4; ++n)
        sum += static_cast<double>(at.weight[n]) * std::exp(-k * rung_depth_m(at.first + n));
      worst = std::max(worst, std::abs(sum - std::exp(-k * s)));
    }
  EXPECT_LT(worst, 0.002);
  EXPECT_GT(worst, 0.0005);  // of this ladder
}

TEST(DepthLadder, HasTheSurfaceAloneAtTheSurface) {
  const RungWeights at = rung_weights(0.0);
  EXPECT_EQ(at.first, 0u);
  EXPECT_EQ(rung_depth_m(0), 0.0);
  EXPECT_EQ(at.weight[0], 1.0f);
  for (std::size_t n = 1; n < 4; ++n) EXPECT_EQ(at.weight[n], 0.0f);
  const RungWeights deep = rung_weights(1e9);
  EXPECT_EQ(deep.first + 3, kRungs - 1);
  EXPECT_FLOAT_EQ(deep.weight[3], 1.0f);
}

// Down to the floor, where the last rung is: nothing goes through it.
TEST(DepthLadder, EndsAtAFloor) {
  double worst = 0.0;
  for (const double floor_m : {0.1, 0.35, 2.0, 5.0, 8.0, 40.0, 700.0}) {
    for (double k = 1e-3; k < kTurn / 0.25; k *= 1.5)
      for (int part = 0; part <= 100; ++part) {
        const double s = 0.01 * part * floor_m;
        const RungWeights at = rung_weights(s, floor_m);
        const auto up = [&](double below_m) {
          return std::exp(-k * below_m) * std::expm1(-2.0 * k * (floor_m - below_m)) /
                 std::expm1(-2.0 * k * floor_m);
        };
        double sum = 0.0;
        for (std::size_t n = 0; n < 4; ++n)
          sum += static_cast<double>(at.weight[n]) * up(rung_depth_m(at.first + n, floor_m));
        worst = std::max(worst, std::abs(sum - up(s)));
      }
    EXPECT_EQ(rung_weights(floor_m, floor_m).weight[3], 1.0f);
    EXPECT_EQ(rung_depth_m(rung_weights(floor_m, floor_m).first + 3, floor_m), floor_m);
  }
  EXPECT_LT(worst, 0.006);
}

// One wave of a square over a floor, down to all of its depth, with the closed forms of the header.
TEST(SurfaceModes, CarryAWaveDownOnEverySimdTarget) {
  constexpr int kSide = 32;
  const double length_x = 50.0, length_y = 40.0, depth_m = 6.0;
  const glm::dvec2 k(3.0 * kTurn / length_x, -2.0 * kTurn / length_y);
  const double wave_number = glm::length(k), tanh_kd = std::tanh(wave_number * depth_m);
  const auto phase = [&](int i, int j) {
    return k.x * i * length_x / kSide + k.y * j * length_y / kSide;
  };
  std::vector<float> samples;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) samples.push_back(static_cast<float>(std::cos(phase(i, j))));
  Workers workers(1);
  std::vector<float> planes, first;
  for_each_simd_target([&] {
    SurfaceModes modes;
    modes.plan = make_fft_plan(kSide);
    modes.length_m = {length_x, length_y};
    modes.gravity_mps2 = kG;
    modes.depth_m = static_cast<float>(depth_m);
    modes.mean_rad_m = 1.0f;
    for (const MotionField field : {kVelocityX, kVelocityY, kVelocityZ, kHead})
      find_modes(samples, field, planes, modes, workers);
    std::vector<float> all;
    for (const double s : {0.0, 1.0, 3.5, 6.0}) {
      const double c = std::cosh(wave_number * (depth_m - s)) / std::cosh(wave_number * depth_m);
      const double w = std::sinh(wave_number * (depth_m - s)) / std::sinh(wave_number * depth_m);
      for (std::size_t f = 0; f + 1 < kMotionFields; f += 2) {
        const auto a = static_cast<MotionField>(f), b = static_cast<MotionField>(f + 1);
        std::vector<float> got_a(kSide * kSide), got_b(kSide * kSide);
        const FftOutput output = {got_a.data(), got_b.data()};
        inverse_fft_2d(
            modes.plan,
            [&](int, int column0, float* re, float* im) {
              return fill_below(modes, s, a, b, column0, re, im);
            },
            {&output, 1}, planes, workers);
        all.insert(all.end(), got_a.begin(), got_a.end());
        all.insert(all.end(), got_b.begin(), got_b.end());
        const auto expected = [&](MotionField field, double theta) {
          switch (field) {
            case kAccelerationX:
              return kG * k.x * c * std::sin(theta);
            case kAccelerationY:
              return kG * k.y * c * std::sin(theta);
            case kAccelerationZ:
              return -kG * wave_number * tanh_kd * w * std::cos(theta);
            case kVelocityZ:
              return w * std::cos(theta);
            default:
              return c * std::cos(theta);
          }
        };
        for (int j = 0; j < kSide; ++j)
          for (int i = 0; i < kSide; ++i) {
            const auto at = static_cast<std::size_t>(j * kSide + i);
            ASSERT_NEAR(got_a[at], expected(a, phase(i, j)), 1e-5) << f << " at " << s;
            ASSERT_NEAR(got_b[at], expected(b, phase(i, j)), 1e-5) << f + 1 << " at " << s;
          }
      }
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  });
}

}  // namespace
}  // namespace swell::ocean
