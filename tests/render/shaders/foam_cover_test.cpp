// How much of the water foam hides, and where the sea's edge runs on the beach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/coast/swash.h"
#include "render/shaders/shader_kernels.h"
#include "texture/foam_pattern.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class FoamCover : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, FoamCover, texture::every_target(), texture::target_name);

struct FoamField {
  static constexpr int kPattern = 256;
  FoamField() {
    std::vector<float> code = texture::make_foam_pattern(kPattern, 4);
    for (float& c : code) c = 2.0f * c - 1.0f;
    texture::pack_map2(kPattern, code, code, 1.0f / 127.0f, map);
    lace = make_layer(map, 9.0, 1.0f, {0.0, 0.0}, {});
  }
  // The mean over one period, sampled at the pattern's texels.
  double mean_cover(float amount, int level) const {
    const std::vector<float> cover = covers(amount, level);
    double sum = 0.0;
    for (const float c : cover) sum += c;
    return sum / static_cast<double>(cover.size());
  }
  std::vector<float> covers(float amount, int level) const {
    std::vector<glm::vec3> p;
    for (int i = 0; i < kPattern * kPattern; ++i)
      p.emplace_back(9.0f * static_cast<float>(i % kPattern) / kPattern,
                     9.0f * static_cast<float>(i / kPattern) / kPattern, -1.0f);
    std::vector<float> cover(p.size());
    const float level_m = static_cast<float>(level) - lace.log2_texels_per_m;
    foam_cover(lace, p, level_m, std::vector<float>(p.size(), amount), cover);
    return cover;
  }
  texture::PackedMap2 map;
  SlopeLayer lace;
};

// Thresholds are spread evenly over [0, 1], and rims are 0.3 wide as thresholds: the mean of
// clamp((1.3 f - threshold) / 0.3) in closed form.
double exact_mean_cover(double f) {
  const double a = 1.3 * f;
  if (f <= 0.02) return 0.0;
  if (a <= 0.3) return a * a / 0.6;
  return a <= 1.0 ? a - 0.15 : 1.0 - (1.3 - a) * (1.3 - a) / 0.6;
}

TEST_P(FoamCover, IsTheFoamsPartOfTheWater) {
  const FoamField field;
  for (int i = 0; i <= 50; ++i) {
    const double f = 0.02 * i;
    const double mean = field.mean_cover(static_cast<float>(f), 0);
    EXPECT_NEAR(mean, exact_mean_cover(f), 2e-3) << f;
    // Soft rims: less of little foam, more of much, by 0.089 where that is most.
    EXPECT_NEAR(mean, f, 0.089) << f;
  }
}

TEST_P(FoamCover, IsNothingBelowAFiftiethAndAllFromOneOn) {
  const FoamField field;
  for (int level = 0; level <= 6; ++level) {
    for (const float f : {0.0f, 0.01f, 0.02f, -1.0f})
      EXPECT_EQ(std::ranges::max(field.covers(f, level)), 0.0f) << level;
    for (const float f : {1.0f, 1.5f})
      EXPECT_GE(std::ranges::min(field.covers(f, level)), 1.0f - 1e-6f) << level;
  }
  EXPECT_GT(std::ranges::max(field.covers(0.021f, 0)), 0.08f);
}

TEST_P(FoamCover, GrowsWithTheFoamAtEveryPlace) {
  const FoamField field;
  for (const int level : {0, 3}) {
    std::vector<float> before = field.covers(0.0f, level);
    for (int i = 1; i <= 20; ++i) {
      const std::vector<float> now = field.covers(0.05f * static_cast<float>(i), level);
      for (std::size_t k = 0; k < now.size(); ++k) ASSERT_GE(now[k], before[k]) << i;
      before = now;
    }
  }
}

// Coarse levels know the mean threshold of 1/2 only: there foam covers nothing up to 0.38 and all
// from 0.62 on.
TEST_P(FoamCover, OfFarWaterIsThatOfItsMeanThreshold) {
  const FoamField field;
  for (const double f : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double expected = std::clamp((1.3 * f - 0.5) / 0.3, 0.0, 1.0);
    EXPECT_NEAR(field.mean_cover(static_cast<float>(f), 7), expected, 0.03) << f;
  }
}

// ---- Swash

class SwashEdges : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, SwashEdges, texture::every_target(), texture::target_name);

struct Edges {
  std::vector<float> edge_m, retreat;
};

// The edge at one place that lags by nothing, over one period.
constexpr int kTimes = 1000;
Edges over_a_period(float reach_m) {
  Edges result;
  const std::vector<glm::vec3> p(1);
  for (int i = 0; i < kTimes; ++i) {
    Swash swash;
    swash.reach_m = reach_m;
    swash.cycles = static_cast<float>(i) / kTimes;
    float edge_m, retreat;
    swash_edge(swash, p, {&edge_m, 1}, {&retreat, 1});
    result.edge_m.push_back(edge_m);
    result.retreat.push_back(retreat);
  }
  return result;
}

// (1 + sin(phi - 0.352 cos phi)) / 2 of the reach, which differs by 0.09 and, in lobes, by 0.06
// either way about 0.85 along the shore, where phi lags by 0.3 of two sines.
double exact_edge_m(const Swash& swash, glm::dvec2 p) {
  const auto along = [&](glm::dvec3 lag) {
    return std::sin(kTurn * (lag.x * p.x + lag.y * p.y + lag.z));
  };
  const double a = along(swash.lag_a), b = along(swash.lag_b);
  const double phase = kTurn * (swash.cycles - 0.3 * (a + b));
  const double leaning = phase - kTurn * 0.056 * std::cos(phase);
  const double lobes = along(glm::dvec3(swash.lag_c) + glm::dvec3(0.0, 0.0, 0.7 * b));
  return swash.reach_m * (0.85 + 0.09 * b + 0.06 * lobes) * 0.5 * (1.0 + std::sin(leaning));
}

TEST_P(SwashEdges, RunFromTheWatersLevelTo85PercentOfTheirReach) {
  const Edges edges = over_a_period(2.0f);
  EXPECT_NEAR(std::ranges::min(edges.edge_m), 0.0, 1e-5);
  EXPECT_NEAR(std::ranges::max(edges.edge_m), 2.0 * 0.85, 1e-5);
  Swash swash;
  swash.reach_m = 2.0f;
  for (int i = 0; i < kTimes; ++i) {
    swash.cycles = static_cast<float>(i) / kTimes;
    ASSERT_NEAR(edges.edge_m[i], exact_edge_m(swash, {0.0, 0.0}), 1e-5) << i;
  }
}

// Not at all while it comes in fastest, wholly while it goes out fastest, half at both turns.
// What is drawn wet at a place is wet when it is asked.
TEST_P(SwashEdges, AreThoseOfQueries) {
  const ocean::Swash asked{.reach_m = 1.5, .period_s = 6.0};
  const double t_s = 1234.5;
  const glm::dvec2 eye(4321.0, -987.0);
  const auto along = [&](glm::dvec2 lag_m) {
    return glm::vec3(1.0 / lag_m.x, 1.0 / lag_m.y, fraction(eye.x / lag_m.x + eye.y / lag_m.y));
  };
  Swash swash;
  swash.reach_m = 1.5f;
  swash.cycles = fraction(t_s / 6.0);
  swash.lag_a = along(ocean::kSwashLags_m[0]);
  swash.lag_b = along(ocean::kSwashLags_m[1]);
  swash.lag_c = along(ocean::kSwashLags_m[2]);
  std::vector<glm::vec3> p;
  for (int i = 0; i < 1000; ++i)
    p.emplace_back(0.37f * static_cast<float>(i), -0.21f * static_cast<float>(i), 0.0f);
  std::vector<float> edge_m(p.size()), retreat(p.size());
  swash_edge(swash, p, edge_m, retreat);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(edge_m[i], ocean::swash_edge_m(asked, t_s, eye + glm::dvec2(p[i])), 3e-4);
}

TEST_P(SwashEdges, RetreatAfterTheyHaveComeIn) {
  const Edges edges = over_a_period(1.0f);
  for (int i = 0; i < kTimes; ++i) {
    const double phase = kTurn * i / kTimes, leaning = phase - kTurn * 0.056 * std::cos(phase);
    ASSERT_NEAR(edges.retreat[i], 0.5 * (1.0 - std::cos(leaning)), 1e-5) << i;
  }
}

// The shader means to lean forward, "up in less than half the time". But the sine of phi - 0.35
// cos phi is the same before and after its crest at a quarter: the edge rises for exactly half of
// the period, and lingers low.
TEST_P(SwashEdges, RiseForHalfOfThePeriod) {
  const std::vector<float> edge_m = over_a_period(1.0f).edge_m;
  int rises = 0;
  double below_half = 0.0;
  for (int i = 0; i < kTimes; ++i) {
    rises += edge_m[(i + 1) % kTimes] > edge_m[i];
    below_half += edge_m[i] < 0.5f * 0.85f;
  }
  EXPECT_NEAR(rises, kTimes / 2, 3);
  EXPECT_NEAR(below_half / kTimes, 0.61, 0.01);
}

// Nowhere beyond the reach, and not everywhere at one time.
TEST_P(SwashEdges, StayWithinTheirReachAllAlongTheShore) {
  Swash swash;
  swash.reach_m = 1.5f;
  swash.cycles = 0.3f;
  swash.lag_a = {1.0f / 310.0f, 1.0f / 230.0f, 0.2f};
  swash.lag_b = {-1.0f / 97.0f, 1.0f / 71.0f, 0.7f};
  std::vector<glm::vec3> p;
  for (int i = 0; i < 4000; ++i)
    p.emplace_back(3.0f * static_cast<float>(i), 1.7f * static_cast<float>(i), -2.0f);
  std::vector<float> edge_m(p.size()), retreat(p.size());
  swash_edge(swash, p, edge_m, retreat);
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_NEAR(edge_m[i], exact_edge_m(swash, glm::dvec2(p[i])), 2e-4) << i;
  const auto [low, high] = std::ranges::minmax(edge_m);
  EXPECT_GE(low, 0.0f);
  EXPECT_LT(low, 0.1f);
  EXPECT_GT(high, 1.2f);
  EXPECT_LE(high, 1.5f);
  EXPECT_GE(std::ranges::min(retreat), 0.0f);
  EXPECT_LE(std::ranges::max(retreat), 1.0f);
}

}  // namespace
}  // namespace swell::render
