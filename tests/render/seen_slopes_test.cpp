// Which slopes of rough water are seen, against facets that count by the area they turn to the eye.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/shader_kernels.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class SeenSlopes : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, SeenSlopes, texture::every_target(), texture::target_name);

struct Facets {
  double cosine;      // mean, of the facets that are seen
  double mirrored_z;  // mean height of the rays that they mirror
};

// By quadrature over normal slopes of deviation sigma along each axis, on level water seen at an
// angle whose cosine to the vertical is c.
Facets facets_seen(double c, double sigma) {
  constexpr int kSteps = 300;
  const double h = std::sqrt(1.0 - c * c);
  double seen = 0.0, cosine = 0.0, mirrored_z = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double u = 10.0 * (i + 0.5) / kSteps - 5.0, v = 10.0 * (j + 0.5) / kSteps - 5.0;
      const double projected = c + sigma * u * h;
      if (projected <= 0.0) continue;
      const double length = std::sqrt(1.0 + sigma * sigma * (u * u + v * v));
      const double weight = projected * std::exp(-0.5 * (u * u + v * v));
      seen += weight;
      cosine += weight * projected / length;
      mirrored_z += weight * (2.0 * projected / (length * length) - c);
    }
  }
  return {cosine / seen, mirrored_z / seen};
}

constexpr double kSigmas[] = {0.03, 0.06, 0.1, 0.15, 0.2};
constexpr double kCosines[] = {0.005, 0.03, 0.09, 0.17, 0.34, 0.5};

TEST_P(SeenSlopes, HaveTheMeanCosineOfFacetsAndMirrorAsHigh) {
  for (const double sigma : kSigmas) {
    for (const double c : kCosines) {
      const Facets expected = facets_seen(c, sigma);
      const std::vector<float> cosine = {static_cast<float>(c)};
      std::vector<float> seen(1), mirroring(1);
      seen_cosines(cosine, static_cast<float>(2.0 * sigma * sigma), seen, mirroring);
      EXPECT_NEAR(seen[0], expected.cosine, 0.045) << sigma << " " << c;
      EXPECT_NEAR(2.0f * mirroring[0] - c, expected.mirrored_z, 0.05) << sigma << " " << c;
    }
  }
}

// Back sides count as faces seen at a low angle, the steeper the lower; no slope is lost or
// doubled.
TEST_P(SeenSlopes, RiseWithTheSlopeAndAreNeverHidden) {
  for (const double sigma : kSigmas) {
    std::vector<float> cosine;
    for (int i = -100; i <= 100; ++i) cosine.push_back(0.01f * static_cast<float>(i));
    std::vector<float> seen(cosine.size()), mirroring(cosine.size());
    seen_cosines(cosine, static_cast<float>(2.0 * sigma * sigma), seen, mirroring);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_GT(seen[i], 0.0f);
      EXPECT_GE(seen[i], cosine[i]);
      if (i > 0) {
        EXPECT_GT(seen[i], seen[i - 1]) << sigma << " " << cosine[i];
      }
    }
  }
}

// Without slopes finer than triangles nothing is hidden, and nothing changes.
TEST_P(SeenSlopes, AreAllSlopesOfSmoothWater) {
  const std::vector<float> cosine = {-0.3f, -0.01f, 0.0f, 0.02f, 0.7f};
  std::vector<float> unhidden(cosine.size());
  unhidden_cosines(cosine, 0.0f, unhidden);
  EXPECT_EQ(unhidden, cosine);
}

}  // namespace
}  // namespace swell::render
