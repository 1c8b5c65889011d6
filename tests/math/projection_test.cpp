// Wide projections against closed forms, and there and back.
#include "math/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "math/random.h"

namespace swell {
namespace {

using std::numbers::pi;

constexpr glm::ivec2 kWideSize_px{640, 480};

Projection fisheye(double fov_deg, const std::array<double, 4>& bend = {}) {
  return fisheye_of_fov(fov_deg * pi / 180.0, bend, kWideSize_px.x, kWideSize_px.y);
}

// Real lenses' numbers, and one that shows 220 degrees.
std::vector<Projection> calibrated() {
  std::vector<Projection> lenses = {fisheye(180.0, {-0.02, 0.005, -0.003, 0.0004}),
                                    fisheye(220.0, {0.03, -0.004, 0.0005, -0.00002}),
                                    fisheye(360.0)};
  lenses[0].k = {285.3, 286.1, 321.7, 238.9};
  lenses[1].k = {140.2, 139.8, 318.0, 244.5};
  return lenses;
}

void expect_near_vector(glm::dvec3 a, glm::dvec3 b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-14) << "component " << i;
}

TEST(Fisheye, WithoutBendShowsAnglesAsDistances) {
  const Projection lens = fisheye(180.0);
  const double focal_px = 240.0 / (pi / 2.0);
  for (const double theta : {0.0, 0.3, 1.0, 1.5})
    for (const double around : {0.0, 0.7, 2.0, 4.0}) {
      const glm::dvec3 ray(std::sin(theta) * std::cos(around), std::sin(theta) * std::sin(around),
                           std::cos(theta));
      const auto place = place_of(lens, kWideSize_px, 3.0 * ray);
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->x, 320.0 + focal_px * theta * std::cos(around), 1e-11);
      EXPECT_NEAR(place->y, 240.0 + focal_px * theta * std::sin(around), 1e-11);
      expect_near_vector(*ray_at(lens, kWideSize_px, *place), ray);
    }
}

// cv::fisheye::projectPoints, as its documentation has it.
TEST(Fisheye, IsOpenCVs) {
  for (const Projection& lens : calibrated())
    for (std::uint64_t n = 0; n < 1000; ++n) {
      const double a = 4.0 * random_uniform(5, 2 * n) - 2.0;
      const double b = 4.0 * random_uniform(5, 2 * n + 1) - 2.0;
      const double r = std::hypot(a, b), t = std::atan(r);
      const auto [k1, k2, k3, k4] = lens.bend;
      const double bent = t * (1.0 + k1 * std::pow(t, 2) + k2 * std::pow(t, 4) +
                               k3 * std::pow(t, 6) + k4 * std::pow(t, 8));
      const auto place = place_of(lens, kWideSize_px, {a, b, 1.0});
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->x, lens.k.fx * bent / r * a + lens.k.cx, 1e-10);
      EXPECT_NEAR(place->y, lens.k.fy * bent / r * b + lens.k.cy, 1e-10);
    }
}

TEST(Fisheye, GoesThereAndBackWithinABillionthOfAPixel) {
  for (const Projection& lens : calibrated()) {
    int shown = 0;
    for (std::uint64_t n = 0; n < 20000; ++n) {
      const glm::dvec2 p(kWideSize_px.x * random_uniform(6, 2 * n),
                         kWideSize_px.y * random_uniform(6, 2 * n + 1));
      const auto ray = ray_at(lens, kWideSize_px, p);
      if (!ray) continue;
      ++shown;
      EXPECT_NEAR(glm::length(*ray), 1.0, 1e-14);
      const auto back = place_of(lens, kWideSize_px, *ray);
      if (!back) continue;  // on the rim to the last bit
      EXPECT_LT(glm::distance(*back, p), 1e-9);
    }
    EXPECT_GT(shown, 5000);
  }
}

TEST(Fisheye, TouchesTheNearerEdgesAndShowsNothingBeyondItsCone) {
  const Projection lens = fisheye(220.0, {0.01, 0.0, 0.0, 0.0});
  const auto top = ray_at(lens, kWideSize_px, {320.0, 1e-9});
  ASSERT_TRUE(top);
  EXPECT_NEAR(std::acos(top->z), 110.0 * pi / 180.0, 1e-9);
  EXPECT_FALSE(ray_at(lens, kWideSize_px, {320.0, -0.01}));
  EXPECT_FALSE(ray_at(lens, kWideSize_px, {1.0, 1.0}));
  EXPECT_FALSE(place_of(lens, kWideSize_px, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(place_of(lens, kWideSize_px, {0.1, 0.0, -0.1}));
  EXPECT_TRUE(place_of(lens, kWideSize_px, {0.1, 0.0, -0.03}));
}

TEST(Fisheye, ThatFoldsIsNotOneToOne) {
  EXPECT_TRUE(is_one_to_one({}, pi));
  EXPECT_TRUE(is_one_to_one({-0.1, 0.0, 0.0, 0.0}, 1.8));
  // The slope 1 - 0.3 theta^2 has its zero at 1.826.
  EXPECT_FALSE(is_one_to_one({-0.1, 0.0, 0.0, 0.0}, 1.83));
}

TEST(Equirectangular, HasLongitudeAcrossAndLatitudeDown) {
  const Projection all = {.kind = ProjectionKind::kEquirectangular};
  const glm::ivec2 size_px(1024, 512);
  const auto looks = [&](double x_px, double y_px) { return *ray_at(all, size_px, {x_px, y_px}); };
  expect_near_vector(looks(512, 256), {0, 0, 1});
  expect_near_vector(looks(768, 256), {1, 0, 0});
  expect_near_vector(looks(256, 256), {-1, 0, 0});
  expect_near_vector(looks(0, 256), {0, 0, -1});
  expect_near_vector(looks(1024, 256), {0, 0, -1});
  for (const double x_px : {0.0, 100.0, 512.0}) {
    expect_near_vector(looks(x_px, 0), {0, -1, 0});
    expect_near_vector(looks(x_px, 512), {0, 1, 0});
  }
  // 30 degrees to the right and 45 up.
  const double half = std::sqrt(0.5);
  expect_near_vector(looks(512.0 + 1024.0 / 12.0, 128),
                     {0.5 * half, -half, std::sqrt(3.0) / 2.0 * half});
}

TEST(Equirectangular, GoesThereAndBackWithinABillionthOfAPixel) {
  const Projection all = {.kind = ProjectionKind::kEquirectangular};
  const glm::ivec2 size_px(1024, 512);
  for (std::uint64_t n = 0; n < 20000; ++n) {
    const glm::dvec2 p(1024.0 * random_uniform(7, 2 * n), 512.0 * random_uniform(7, 2 * n + 1));
    EXPECT_LT(glm::distance(*place_of(all, size_px, 7.0 * *ray_at(all, size_px, p)), p), 1e-9);
  }
}

}  // namespace
}  // namespace swell
