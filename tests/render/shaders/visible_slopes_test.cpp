// Which slopes of rough water are seen, against facets that count by the area they turn to the eye.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/shaders/shader_kernels.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class VisibleSlopes : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, VisibleSlopes, texture::every_target(), texture::target_name);

// Unpolarised, by Snell's law and Fresnel's two formulas, from air into water.
double fresnel(double cos_i) {
  constexpr double n = 1.333;
  const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
  const double s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  const double p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return 0.5 * (s * s + p * p);
}

struct Facets {
  double area = 0.0;                                         // turned to the eye, over the level's
  double cosine = 0.0, mirrored_z = 0.0, reflectance = 0.0;  // means of the facets that are seen
};

// By quadrature over normal slopes of deviation sigma along each axis, on level water seen at an
// angle whose cosine to the vertical is c.
Facets facets_seen(double c, double sigma) {
  constexpr int kSteps = 300;
  const double h = std::sqrt(1.0 - c * c);
  double all = 0.0;
  Facets sum;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double u = 10.0 * (i + 0.5) / kSteps - 5.0, v = 10.0 * (j + 0.5) / kSteps - 5.0;
      const double density = std::exp(-0.5 * (u * u + v * v));
      all += density;
      const double projected = c + sigma * u * h;
      if (projected <= 0.0) continue;
      const double length = std::sqrt(1.0 + sigma * sigma * (u * u + v * v));
      const double weight = projected * density;
      sum.area += weight;
      sum.cosine += weight * projected / length;
      sum.mirrored_z += weight * (2.0 * projected / (length * length) - c);
      sum.reflectance += weight * fresnel(std::min(projected / length, 1.0));
    }
  }
  return {sum.area / all, sum.cosine / sum.area, sum.mirrored_z / sum.area,
          sum.reflectance / sum.area};
}

constexpr double kSigmas[] = {0.03, 0.06, 0.1, 0.15, 0.2};
constexpr double kCosines[] = {0.005, 0.03, 0.09, 0.17, 0.34, 0.5};

TEST_P(VisibleSlopes, HaveTheMeansOfTheFacetsThatAreSeen) {
  for (const double sigma : kSigmas) {
    for (const double c : kCosines) {
      const Facets expected = facets_seen(c, sigma);
      const SeenFacets seen =
          seen_facets(static_cast<float>(c), static_cast<float>(2.0 * sigma * sigma));
      EXPECT_NEAR(seen.cosine, expected.cosine, 0.045) << sigma << " " << c;
      EXPECT_NEAR(2.0f * seen.mirroring - c, expected.mirrored_z, 0.05) << sigma << " " << c;
      EXPECT_NEAR(fresnel(static_cast<double>(seen.reflecting)), expected.reflectance, 0.05)
          << sigma << " " << c;
      EXPECT_NEAR(seen.area, expected.area, 0.004) << sigma << " " << c;
    }
  }
}

TEST_P(VisibleSlopes, RiseWithTheCosineAndAreNeverHidden) {
  for (const double sigma : kSigmas) {
    float before = 0.0f;
    for (int i = -100; i <= 100; ++i) {
      const float c = 0.01f * static_cast<float>(i);
      const float seen = seen_facets(c, static_cast<float>(2.0 * sigma * sigma)).cosine;
      EXPECT_GT(seen, before) << sigma << " " << c;
      EXPECT_GE(seen, c);
      before = seen;
    }
  }
}

// Slopes of which a part is drawn: what the eye sees of each of them is lit by the rest of the
// slopes, so that the mean over all of what is drawn must not depend on how much is.
TEST_P(VisibleSlopes, ReflectAsMuchHoweverManyAreDrawn) {
  for (const double sigma : {0.06, 0.1, 0.15}) {
    for (const double c : {0.03, 0.09, 0.17, 0.34}) {
      const double expected = facets_seen(c, sigma).reflectance;
      const auto variance = static_cast<float>(2.0 * sigma * sigma);
      for (const double drawn : {0.3, 0.6, 0.9}) {
        std::vector<float> cosine, unhidden(81);
        for (int i = -40; i <= 40; ++i)
          cosine.push_back(static_cast<float>(c + 0.1 * i * sigma * std::sqrt(drawn)));
        unhidden_cosines(cosine, static_cast<float>(c), variance, static_cast<float>(drawn),
                         unhidden);
        double sum = 0.0, all = 0.0;
        for (int i = -40; i <= 40; ++i) {
          const double density = std::exp(-0.005 * i * i);
          const float rest = static_cast<float>(1.0 - drawn) * variance;
          const float reflecting =
              seen_facets(unhidden[static_cast<std::size_t>(i + 40)], rest).reflecting;
          sum += density * fresnel(static_cast<double>(reflecting));
          all += density;
        }
        EXPECT_NEAR(sum / all, expected, 0.035) << sigma << " " << c << " " << drawn;
      }
    }
  }
}

// Where no slopes are drawn nothing is hidden, and nothing changes.
TEST_P(VisibleSlopes, AreAllSlopesWhereNoneIsDrawn) {
  const std::vector<float> cosine = {-0.3f, -0.01f, 0.0f, 0.02f, 0.7f};
  std::vector<float> unhidden(cosine.size());
  unhidden_cosines(cosine, 0.1f, 0.02f, 0.0f, unhidden);
  EXPECT_EQ(unhidden, cosine);
}

// PER-06: tilted normals have length 1 and at least the cosine asked for; those over it keep their
// bits; nothing jumps where tilting begins.
TEST_P(VisibleSlopes, BackSidesCanBeTiltedToTheEye) {
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
