// Trains near a coast and their share of the surface.
#include "ocean/coast/coast.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/random.h"

namespace swell::ocean {
namespace {

// A beach of 1:40 along y = 0, the sea to the north; 1200 x 1200 m.
terrain::HeightGrid beach() {
  const terrain::Grid grid{{-600.0, -300.0}, 5.0, 241, 241};
  return terrain::make_plane_beach(grid, {{{-600.0, 0.0}, {600.0, 0.0}}, 0.025, 60.0});
}

CoastSea make_coast(double wind_mps, bool blend, int threads = 2) {
  Workers workers(threads);
  return make_coast_sea(beach(), make_wind_sea(wind_mps, 0.3, 9.81), 4, 1, PhaseMethod::kEikonal,
                        blend, workers);
}

std::vector<glm::dvec2> random_coast_points(int count) {
  std::vector<glm::dvec2> p;
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::uint64_t>(2 * i);
    p.emplace_back(2400.0 * random_uniform(5, n) - 1200.0,
                   2400.0 * random_uniform(5, n + 1) - 900.0);
  }
  return p;
}

float share_at(const CoastSea& coast, glm::dvec2 p) {
  float share = -1.0f;
  sample_coast_share(coast, {&p, 1}, {&share, 1});
  return share;
}

TEST(Coast, TrainsHaveTheShoreAndTheSpectrumTheDeep) {
  // 6 m/s: peak wavelength 34.6 m by L = U^2 / (2 pi 0.13^2 g), trains alone below 3.5 m of depth.
  const CoastSea coast = make_coast(6.0, true);
  EXPECT_NEAR(coast.peak_wavelength_m, 36.0 / (2.0 * M_PI * 0.13 * 0.13 * 9.81), 0.01);
  EXPECT_FLOAT_EQ(share_at(coast, {0.0, 100.0}), 1.0f);  // 2.5 m deep
  EXPECT_FLOAT_EQ(share_at(coast, {0.0, 700.0}), 0.0f);  // 17.5 m deep
  const float between = share_at(coast, {0.0, 320.0});   // 8 m deep
  EXPECT_GT(between, 0.1f);
  EXPECT_LT(between, 0.9f);
}

// sin and cos of 0, 30, 45 and 90 degrees.
TEST(Coast, TrainsAndSpectrumShareTheEnergy) {
  EXPECT_EQ(spectrum_weight(0.0f), 1.0f);
  EXPECT_FLOAT_EQ(spectrum_weight(0.5f), 0.8660254f);
  EXPECT_FLOAT_EQ(spectrum_weight(0.70710678f), 0.70710678f);
  EXPECT_EQ(spectrum_weight(1.0f), 0.0f);
  EXPECT_EQ(spectrum_weight(1.0000001f), 0.0f);
}

// 6 m/s: half of either's energy where the depth is midway between 3.46 and 13.8 m, at a distance
// of 40 times that.
TEST(Coast, BothHaveHalfOfTheEnergyMidway) {
  const CoastSea coast = make_coast(6.0, true);
  const double midway_m = 0.25 * static_cast<double>(coast.peak_wavelength_m);
  EXPECT_NEAR(share_at(coast, {0.0, 40.0 * midway_m}), std::sqrt(0.5), 0.01);
}

TEST(Coast, ShareFallsToZeroAtTheGridsRim) {
  const CoastSea coast = make_coast(10.0, false);
  EXPECT_FLOAT_EQ(share_at(coast, {0.0, 300.0}), 1.0f);
  for (const glm::dvec2& p : {glm::dvec2(-600.0, 100.0), {600.0, 100.0}, {0.0, 900.0}})
    EXPECT_NEAR(share_at(coast, p), 0.0f, 1e-6f);
  for (const glm::dvec2& p : {glm::dvec2(-601.0, 100.0), {5000.0, 0.0}, {0.0, -1e6}})
    EXPECT_EQ(share_at(coast, p), 0.0f);
}

TEST(Coast, HeightsAreTheTrainsTimesTheirShare) {
  const CoastSea coast = make_coast(10.0, true);
  const std::vector<glm::dvec2> p = random_coast_points(1000);
  std::vector<float> height(p.size()), share(p.size()), trains(p.size()), expected(p.size());
  sample_coast(coast, 12.5, p, height, share);
  sample_coast_share(coast, p, expected);
  sample_trains(coast.trains, 12.5, p, trains);
  int some = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(share[i], expected[i]);
    ASSERT_EQ(height[i], share[i] == 0.0f ? 0.0f : share[i] * trains[i]);
    some += height[i] != 0.0f;
  }
  EXPECT_GT(some, 100);
}

// By differences over 2 cm, with what they round.
TEST(Coast, HeightsAreNoSteeperThanTheirBound) {
  const CoastSea coast = make_coast(10.0, true);
  constexpr double kStep_m = 0.02;
  float steepest = 0.0f;
  for (int n = 0; n < 20; ++n) {
    for (const glm::dvec2& p : random_coast_points(2000)) {
      const std::array<glm::dvec2, 3> at = {p, p + glm::dvec2(kStep_m, 0.0),
                                            p + glm::dvec2(0.0, kStep_m)};
      std::array<float, 3> z, share;
      sample_coast(coast, 1.7 * n, at, z, share);
      steepest = std::max(steepest, std::hypot(z[1] - z[0], z[2] - z[0]) / 0.02f);
    }
  }
  EXPECT_LE(steepest, coast.slope_bound() + 1e-3f);
  EXPECT_GT(steepest, 0.3f * coast.slope_bound());
}

}  // namespace
}  // namespace swell::ocean
