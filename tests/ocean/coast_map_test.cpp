// The maps that a coast is shaded with: slopes of its waves, foam where they break.
#include "ocean/coast/coast_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simd_targets.h"

namespace swell::ocean {
namespace {

constexpr int kSize = 64;
constexpr double kMapStep_m = 1200.0 / kSize;  // between the map's points
constexpr glm::dvec2 kCorner{-600.0, -300.0};

// A beach of 1:40 along y = 0, the sea to the north; 1200 x 1200 m.
terrain::HeightGrid straight_beach() {
  const terrain::Grid grid{kCorner, 10.0, 121, 121};
  return terrain::make_plane_beach(grid, {{{-600.0, 0.0}, {600.0, 0.0}}, 0.025, 60.0});
}

CoastSea coast_with_trains(double wind_mps, int trains, int threads = 2) {
  Workers workers(threads);
  return make_coast_sea(straight_beach(), make_wind_sea(wind_mps, 0.3, 9.81), trains, 1,
                        PhaseMethod::kEikonal, true, workers);
}

struct Baked {
  std::vector<float> x, y, foam;
  bool operator==(const Baked&) const = default;
};

Baked bake(const CoastMap& map, double t_s, Workers& workers) {
  constexpr std::size_t kPoints = kSize * kSize;
  Baked baked{std::vector<float>(kPoints, NAN), std::vector<float>(kPoints, NAN),
              std::vector<float>(kPoints, NAN)};
  bake_coast(map, t_s, baked.x, baked.y, baked.foam, workers);
  return baked;
}

Baked bake(const CoastSea& coast, double t_s, int threads = 2) {
  Workers workers(threads);
  return bake(make_coast_map(coast, kSize, workers), t_s, workers);
}

glm::dvec2 point(int i, int j) { return kCorner + kMapStep_m * glm::dvec2(i, j); }

// In the middle of the beach, where waves are some grid steps long.
TEST(CoastMap, SlopesAreTheHeightsDerivative) {
  const CoastSea coast = coast_with_trains(12.0, 4);
  const Baked baked = bake(coast, 3.0);
  constexpr double kStep = 0.01;
  double error2 = 0.0, size2 = 0.0;
  for (int j = 20; j < 50; ++j) {
    for (int i = 10; i < 54; ++i) {
      const glm::dvec2 p = point(i, j);
      const glm::dvec2 four[] = {p + glm::dvec2(kStep, 0.0), p - glm::dvec2(kStep, 0.0),
                                 p + glm::dvec2(0.0, kStep), p - glm::dvec2(0.0, kStep)};
      float z[4], share[4];
      sample_coast(coast, 3.0, four, z, share);
      const double dx = (z[0] - z[1]) / (2.0 * kStep), dy = (z[2] - z[3]) / (2.0 * kStep);
      const std::size_t k = static_cast<std::size_t>(j) * kSize + i;
      error2 += (baked.x[k] - dx) * (baked.x[k] - dx) + (baked.y[k] - dy) * (baked.y[k] - dy);
      size2 += dx * dx + dy * dy;
    }
  }
  ASSERT_GT(size2, 0.01);
  EXPECT_LT(std::sqrt(error2 / size2), 0.05);
}

TEST(CoastMap, FoamIsOnlyWhereWavesBreak) {
  // 10 m/s: m0 = 0.28 m2, five trains' amplitudes sum up to 1.6 m: they fill 0.39 of 4 m of depth,
  // and spill from 0.6 of that limit on, 6.7 m. Shoaling takes both a little further out.
  const CoastSea coast = coast_with_trains(10.0, 5);
  float most = 0.0f;
  Workers workers(2);
  const CoastMap map = make_coast_map(coast, kSize, workers);
  for (const double t_s : {0.0, 3.0, 11.0}) {
    const Baked baked = bake(map, t_s, workers);
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        const float foam = baked.foam[static_cast<std::size_t>(j) * kSize + i];
        const double depth_m = 0.025 * point(i, j).y;
        ASSERT_TRUE(foam >= 0.0f && foam <= 1.0f) << foam;
        if (depth_m < 0.0 || depth_m > 9.0) {
          ASSERT_EQ(foam, 0.0f) << "depth_m=" << depth_m;
        }
        most = std::max(most, foam);
      }
    }
  }
  EXPECT_GT(most, 0.7f);
}

TEST(CoastMap, FoamFollowsTheCrestOfASingleTrain) {
  const CoastSea coast = coast_with_trains(10.0, 1);
  const double period_s = coast.trains.period_s[0];
  // Past a point in the surf: a crest arrives where the height is greatest.
  constexpr int kI = 32, kJ = 20, kMoments = 200;
  Workers workers(1);
  const CoastMap map = make_coast_map(coast, kSize, workers);
  double crest_s = 0.0;
  float highest = -1e9f;
  std::vector<float> foam;
  for (int n = 0; n < kMoments; ++n) {
    const double t_s = period_s * n / kMoments;
    const glm::dvec2 p = point(kI, kJ);
    float z, share;
    sample_coast(coast, t_s, {&p, 1}, {&z, 1}, {&share, 1});
    foam.push_back(bake(map, t_s, workers).foam[kJ * kSize + kI]);
    if (z > highest) {
      highest = z;
      crest_s = t_s;
    }
  }
  const auto at = [&](double after) {
    const int n = static_cast<int>(std::lround((crest_s / period_s + after) * kMoments));
    return foam[static_cast<std::size_t>(((n % kMoments) + kMoments) % kMoments)];
  };
  ASSERT_GT(at(0.0), 0.5f);
  EXPECT_GE(at(0.0), at(0.1));
  EXPECT_GT(at(0.1), at(0.2));
  EXPECT_GT(at(0.2), at(0.4));
  EXPECT_EQ(at(0.6), 0.0f);
  EXPECT_EQ(at(-0.1), 0.0f);
}

TEST(CoastMap, SurfBeginsAtThreeFifthsOfTheLimit) {
  // The limit of 2 m of depth: 0.39 x 2 m.
  EXPECT_EQ(breaking_part(0.59 * 0.78, 2.0), 0.0);
  EXPECT_NEAR(breaking_part(0.8 * 0.78, 2.0), 0.5, 1e-12);
  EXPECT_EQ(breaking_part(0.78, 2.0), 1.0);
  EXPECT_EQ(breaking_part(5.0, 2.0), 1.0);
  EXPECT_EQ(breaking_part(1.0, 0.0), 0.0);
  EXPECT_EQ(breaking_part(1.0, -3.0), 0.0);
}

TEST(CoastMap, ThreadsChangeNoBit) {
  EXPECT_EQ(bake(coast_with_trains(10.0, 4, 1), 7.0, 1),
            bake(coast_with_trains(10.0, 4, 3), 7.0, 3));
}

TEST(CoastMap, EveryTargetGivesTheSameBits) {
  const CoastSea coast = coast_with_trains(10.0, 5);
  std::vector<Baked> results;
  for_each_simd_target([&] { results.push_back(bake(coast, 7.0)); });
  for (const Baked& result : results) EXPECT_EQ(result, results.front());
}

}  // namespace
}  // namespace swell::ocean
