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

// PER-06: tilted normals have length 1 and at least the cosine asked for; those over it keep their
// bits; nothing jumps where tilting begins.
TEST_P(SeenSlopes, BackSidesCanBeTiltedToTheEye) {
  constexpr float kLeast = 0.08f;
  constexpr int kCount = 2001;
  std::vector<glm::vec3> to_eye, normal;
  for (int i = 0; i < kCount; ++i) {
    const double cosine = 0.000999 * (i - 1000), turn = 0.37 * i;
    const glm::dvec3 v(std::cos(turn), 0.6 * std::sin(turn), 0.8 * std::sin(turn));
    const glm::dvec3 aside = glm::normalize(glm::cross(v, glm::dvec3(0.3, -0.5, 0.81)));
    to_eye.emplace_back(v);
    normal.emplace_back(cosine * v + std::sqrt(1.0 - cosine * cosine) * aside);
  }
  std::vector<glm::vec3> tilted = normal;
  std::vector<float> cosine(kCount);
  tilted_normals(to_eye, kLeast, tilted, cosine);
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::dvec3 n(tilted[i]), v(to_eye[i]), from(normal[i]);
    EXPECT_NEAR(glm::length(n), 1.0, 1e-6);
    EXPECT_NEAR(glm::dot(n, v), cosine[i], 1e-6);
    EXPECT_GE(cosine[i], kLeast - 1e-6f);
    const double before = glm::dot(from, v);
    if (before > 0.0804) {
      EXPECT_EQ(tilted[i], normal[i]);
    } else if (before > -0.99) {  // at -1 all directions are as near
      // In the plane of both, by what the formula says: n + (e' - n.v) v.
      const double least = 0.08 / std::sqrt(1.0 - 0.08 * 0.08);
      const glm::dvec3 expected = glm::normalize(from + (least - before) * v);
      EXPECT_LT(glm::distance(n, expected), 1e-5);
    }
    if (i > 0 && before > -0.9 && before < 0.9) {
      EXPECT_LT(std::abs(cosine[i] - cosine[i - 1]), 0.0025f);
    }
  }
}

}  // namespace
}  // namespace swell::render
