// Rays through volumetric clouds against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "render/frame.h"
#include "render/sky/cloud_kernels.h"
#include "scene/scene.h"

namespace swell::render {
namespace {

RaySeen follow(const EvenCloud& cloud, float step_m, float extinction_per_m) {
  RaySeen seen;
  follow_even_clouds({&cloud, 1}, step_m, 4096.0f, extinction_per_m, {&seen, 1});
  return seen;
}

TEST(CloudRays, AnEvenSlabLetsThroughByBeersLaw) {
  for (const float step_m : {1.0f, 4.0f, 16.0f})
    for (const float length_m : {3.0f, 50.0f, 77.7f, 120.0f})
      for (const float begin_m : {0.0f, 0.3f, 511.0f, 3000.0f}) {
        const float extinction = 0.03f;
        const RaySeen seen = follow({begin_m, begin_m + length_m, 1.0f}, step_m, extinction);
        const double expected = std::exp(-double{extinction} * double{length_m});
        EXPECT_NEAR(1.0 - double{seen.opacity}, expected, 0.005 * expected)
            << step_m << " " << length_m << " " << begin_m;
      }
}

// CLD-02
TEST(CloudRays, WhatLosesNothingShowsWhatLightsIt) {
  for (const float step_m : {1.0f, 4.0f, 16.0f, 64.0f})
    for (const float density : {0.01f, 0.2f, 1.0f}) {
      const RaySeen seen = follow({100.0f, 700.0f, density}, step_m, 0.03f);
      EXPECT_NEAR(seen.sky, seen.opacity, 1e-3f * seen.opacity) << step_m << " " << density;
    }
}

// CLD-06
TEST(CloudRays, AnEvenSphereShowsNoBands) {
  constexpr float kRadius_m = 60.0f, kExtinction = 0.02f, kDistance_m = 500.0f;
  std::vector<EvenCloud> rays;
  std::vector<double> expected;
  for (int i = 0; i < 2000; ++i) {
    const double b = double{kRadius_m} * i / 2000.0;
    const double half = std::sqrt(double{kRadius_m} * double{kRadius_m} - b * b);
    rays.push_back({static_cast<float>(double{kDistance_m} - half),
                    static_cast<float>(double{kDistance_m} + half), 1.0f});
    expected.push_back(std::exp(-2.0 * double{kExtinction} * half));
  }
  std::vector<RaySeen> seen(rays.size());
  follow_even_clouds(rays, 16.0f, 4096.0f, kExtinction, seen);
  for (std::size_t i = 0; i < rays.size(); ++i)
    EXPECT_NEAR(1.0 - double{seen[i].opacity}, expected[i], 1.0 / 255.0) << i;
}

TEST(CloudRays, ThickCloudsAreOpaque) {
  const RaySeen seen = follow({10.0f, 3000.0f, 1.0f}, 16.0f, 0.03f);
  EXPECT_EQ(seen.opacity, 1.0f);
  EXPECT_NEAR(seen.sky, 1.0f, 1e-3f);
  EXPECT_EQ(seen.front, 10.0f);
}

// A step hides at most 1 - e^-0.5, however long it is.
TEST(CloudRays, FarStepsAreNoDenserThanNearOnes) {
  for (const float begin_m : {0.0f, 4096.0f, 30000.0f, 150000.0f}) {
    const RaySeen seen = follow({begin_m, begin_m + 16.0f, 1.0f}, 16.0f, 0.03f);
    EXPECT_GT(seen.opacity, 0.0f);
    EXPECT_LE(seen.opacity, 1.0f - std::exp(-0.5f)) << begin_m;
  }
}

TEST(CloudRays, DropletsScatterAllLight) {
  constexpr int kSteps = 20000;
  std::vector<float> cosine(kSteps), phase(kSteps);
  for (int i = 0; i < kSteps; ++i)
    cosine[static_cast<std::size_t>(i)] = -1.0f + 2.0f * (static_cast<float>(i) + 0.5f) / kSteps;
  for (const float part : {1.0f, 0.5f}) {
    droplet_phase(cosine, part, phase);
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < phase.size(); ++i) {
      sum += 2.0 * kPi * double{phase[i]} * 2.0 / kSteps;
      mean += 2.0 * kPi * double{phase[i]} * double{cosine[i]} * 2.0 / kSteps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-4);
    EXPECT_NEAR(mean, double{part} * (0.8 * 0.8 - 0.2 * 0.3), 1e-4);
  }
}

// CLD-05
TEST(CloudRays, AnEvenCloudLaysEvenlyOverAnyDepths) {
  std::vector<float> distance(1000);
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = 300.0f + 1e5f * static_cast<float>(random_uniform(1, i));
  std::vector<glm::vec3> laid(distance.size());
  lay_even_cloud({0.3f, 0.4f, 0.5f}, 0.6f, 100.0f, 299.0f, distance, laid);
  for (const glm::vec3& light : laid) EXPECT_EQ(light, glm::vec3(0.3f, 0.4f, 0.5f));
  // What lies before it shows none of it; what lies within, as much as Beer's law says.
  const std::vector<float> near = {1.0f, 99.9f, 150.0f, 200.0f, 250.0f};
  laid.resize(near.size());
  lay_even_cloud({0.6f, 0.6f, 0.6f}, 0.6f, 100.0f, 300.0f, near, laid);
  EXPECT_EQ(laid[0], glm::vec3(0.0f));
  EXPECT_EQ(laid[1], glm::vec3(0.0f));
  for (std::size_t i = 2; i < near.size(); ++i) {
    const double part = (double{near[i]} - 100.0) / 200.0;
    EXPECT_NEAR(laid[i].x, 1.0 - std::pow(0.4, part), 1e-4);
  }
}

}  // namespace
}  // namespace swell::render
