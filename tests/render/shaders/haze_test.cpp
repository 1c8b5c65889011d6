// Haze that thins with height, against the sum along the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/materials/list.h"
#include "render/shaders/shader_kernels.h"
#include "render/sky/sky_maps.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class ThinningHaze : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, ThinningHaze, texture::every_target(), texture::target_name);

constexpr double kHaze_m = 15000.0, kHeight_m = 1200.0, kRadius_m = 6371e3 / 0.87;
constexpr double kHazeCut = 1.0 / 512.0;

// White haze over black things, so that what is seen is the haze's amount.
struct HazeAir {
  HazeAir(double eye_m, bool is_round)
      : eye_z_m(eye_m), drop_per_m2(is_round ? 0.5 / kRadius_m : 0.0) {
    texture::RgbaImage image;
    texture::resize_image(16, 16, image);
    std::ranges::fill(image.texels, 0xffb4b4b4u);
    sky = texture::pack_rgb(image);
    shading.light.haze_sky = &sky;
    shading.light.horizon = glm::vec3(kSoftSkyRange * 180.0f * 180.0f / (255.0f * 255.0f));
    shading.media.inv_haze_m = static_cast<float>(1.0 / kHaze_m);
    shading.media.inv_haze_height_m = static_cast<float>(1.0 / kHeight_m);
    shading.rays.eye_z = static_cast<float>(eye_m);
    shading.rays.drop_per_m2 = static_cast<float>(drop_per_m2);
  }

  // Optical depth of the way from the eye.
  double drawn(double distance_m, double down_rad) const {
    const glm::vec3 to_eye(0.6 * std::cos(down_rad), -0.8 * std::cos(down_rad), std::sin(down_rad));
    std::vector<glm::vec3> seen(1);
    haze(shading, std::vector<float>{static_cast<float>(distance_m)}, to_eye, {}, seen);
    return -std::log(1.0 - kHazeCut - seen[0].x / shading.light.horizon.x);
  }

  template <class Density>
  double summed(double distance_m, double down_rad, Density density) const {
    constexpr int kSteps = 4000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double s = distance_m * (i + 0.5) / kSteps, r = s * std::cos(down_rad);
      sum += density(eye_z_m - s * std::sin(down_rad) + r * r * drop_per_m2);
    }
    return sum * distance_m / (kSteps * kHaze_m);
  }

  double eye_z_m, drop_per_m2;
  texture::RgbMap sky;
  ViewShading shading;
};

double profile(double height_m) { return std::pow(1.0 + height_m / kHeight_m, -2.0); }

// Over a flat sea the closed form is exact, up and down.
TEST_P(ThinningHaze, IsTheSumAlongAStraightWay) {
  for (const double eye_m : {0.3, 10.0, 300.0, 1500.0, 10000.0, 40000.0}) {
    const HazeAir air(eye_m, false);
    for (const double down_deg : {90.0, 60.0, 30.0, 10.0}) {
      const double down_rad = down_deg * std::numbers::pi / 180.0;
      for (const double part : {0.2, 0.7, 1.0}) {
        const double way_m = part * eye_m / std::sin(down_rad);
        const double expected = air.summed(way_m, down_rad, profile);
        if (expected < 0.01) continue;  // mostly cut off
        // One line's mean, taken as two: they meet on it.
        ASSERT_NEAR(air.drawn(way_m, down_rad), expected, 2e-3 * expected + 1e-4)
            << eye_m << " m, " << down_deg << " degrees, " << part;
      }
    }
  }
}

// Straight down the whole layer counts as much as exp(-h / H) would, to a tenth from 10 km up.
TEST_P(ThinningHaze, HoldsAsMuchAsAnExponentialLayer) {
  const auto exponential = [](double height_m) { return std::exp(-height_m / kHeight_m); };
  for (const double eye_m : {10000.0, 40000.0}) {
    const HazeAir air(eye_m, true);
    const double down_rad = 0.5 * std::numbers::pi;
    const double expected = air.summed(eye_m, down_rad, exponential);
    EXPECT_NEAR(air.drawn(eye_m, down_rad), expected, 0.12 * expected) << eye_m;
  }
}

// Along the same length the sea is clearer from above than from a boat.
TEST_P(ThinningHaze, IsThinnerFromAbove) {
  const double way_m = 10000.0;
  const double level = HazeAir(2.0, true).drawn(way_m, 0.0);
  EXPECT_NEAR(level, way_m / kHaze_m, 0.01);
  EXPECT_LT(HazeAir(way_m, true).drawn(way_m, 0.5 * std::numbers::pi), 0.12 * level);
}

// From straight down to the horizon the haze only grows, and without a seam.
TEST_P(ThinningHaze, GrowsSmoothlyTowardsTheHorizon) {
  for (const double eye_m : {60.0, 1500.0, 10000.0, 40000.0}) {
    const HazeAir air(eye_m, true);
    const double dip_rad = std::sqrt(2.0 * eye_m / kRadius_m);
    double before = 0.0, growth_before = 0.0;
    for (int i = 0; i <= 400; ++i) {
      const double down_rad = std::max(1.5 - i * 0.0035, dip_rad);
      const double s = std::sin(down_rad), c = std::cos(down_rad);
      const double root2 = s * s - 4.0 * air.drop_per_m2 * c * c * eye_m;
      const double way_m = 2.0 * eye_m / (s + std::sqrt(std::max(root2, 0.0)));
      const double amount = 1.0 - std::exp(-air.drawn(way_m, down_rad)), growth = amount - before;
      if (i > 0) {
        ASSERT_GE(growth, -1e-4) << eye_m << " m, " << down_rad;
      }
      if (i > 1 && down_rad > 1.2 * dip_rad) {
        ASSERT_LT(std::abs(growth - growth_before), 0.01) << eye_m << " m, " << down_rad;
      }
      before = amount, growth_before = growth;
    }
  }
}

}  // namespace
}  // namespace swell::render
