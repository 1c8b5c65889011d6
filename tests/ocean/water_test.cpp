// The water as a whole: what its sources add up to, and the bounds that hold for all of them.
#include "ocean/water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/water_surface.h"
#include "terrain/sea_floor.h"

namespace swell::ocean {
namespace {

SeaDescription two_sines() {
  SeaDescription sea;
  sea.spectrum = false;
  sea.sines = {{0.5, 20.0, 0.0, 0.0, 4.0}, {-0.25, 7.0, 1.0, 0.0, 0.0}};
  return sea;
}

SeaDescription windy() {
  SeaDescription sea;
  sea.wind_speed_mps = 8.0;
  sea.resolution = 64;
  sea.patch_lengths_m = {180.0, 27.0};
  return sea;
}

// A beach of 1:10 with the sea in the north, and three trains on it.
struct Beach {
  explicit Beach(const SeaDescription& description) : sea(description) {
    const terrain::Grid grid{{-400.0, -400.0}, 10.0, 81, 81};
    floor = terrain::make_plane_beach(grid, {{{-1.0, -150.0}, {0.0, -150.0}}, 0.1, 40.0});
    Workers workers(2);
    const WaveSystem wind = make_wind_sea(8.0, 0.0, 9.81);
    coast = make_coast_sea(floor, wind, 3, 1, PhaseMethod::kEikonal, true, workers);
  }
  WaterParts parts() const { return {&sea, {{0.0, 0.0}, {700.0, 700.0}}, &floor, &coast}; }

  Sea sea;
  terrain::HeightGrid floor;
  CoastSea coast;
};

std::vector<glm::dvec2> scattered(int count, double range_m) {
  std::vector<glm::dvec2> p;
  for (int i = 0; i < count; ++i)
    p.push_back(range_m *
                (glm::dvec2(random_uniform(5, 2 * i), random_uniform(5, 2 * i + 1)) - 0.5));
  return p;
}

TEST(WaterBounds, OfSinesAreTheSumsOfTheirAmplitudesAndSlopes) {
  const Sea sea(two_sines());
  const WaterBounds bounds = WaterBody({&sea, {{0.0, 0.0}, {2000.0, 3000.0}}}).bounds();
  EXPECT_FLOAT_EQ(bounds.height_m, 0.75f);
  const double slope = kTurn * (0.5 / 20.0 + 0.25 / 7.0);
  EXPECT_FLOAT_EQ(bounds.slope, static_cast<float>(slope));
  // The edge: 0.75 m, which fade over 200 m with a slope of 1.5 at most along each axis.
  EXPECT_NEAR(bounds.steepest, slope + 2.0 * 0.75 * 1.5 / 200.0, 1e-12);
  EXPECT_EQ(bounds.mean_wavelength_m, sea.mean_wavelength_m());
}

TEST(WaterBounds, AreThoseOfTheSeaAndTheTrainsTogether) {
  const Beach beach(windy());
  const WaterBounds bounds = WaterBody(beach.parts()).bounds();
  EXPECT_EQ(bounds.height_m,
            static_cast<float>(beach.sea.height_bound_m()) + beach.coast.trains.height_bound_m);
  EXPECT_EQ(bounds.slope, static_cast<float>(beach.sea.slope_bound()) + beach.coast.slope_bound());
  EXPECT_GT(bounds.steepest, static_cast<double>(bounds.slope));
  EXPECT_EQ(bounds.mean_wavelength_m, beach.sea.mean_wavelength_m());
}

TEST(WaterBounds, TakeTheLengthOfTheTrainsWhereTheSeaHasNoWaves) {
  SeaDescription calm;
  calm.spectrum = false;
  const Beach beach(calm);
  EXPECT_EQ(WaterBody(beach.parts()).bounds().mean_wavelength_m,
            static_cast<double>(beach.coast.peak_wavelength_m));
  WaterParts open = beach.parts();
  open.coast = nullptr;
  EXPECT_EQ(WaterBody(open).bounds().mean_wavelength_m, 0.0);
}

TEST(WaterBounds, HoldWhereSeaAndTrainsMeet) {
  const Beach beach(windy());
  const std::vector<glm::dvec2> p = scattered(3000, 800.0);
  std::vector<float> z(p.size());
  std::vector<glm::vec2> slope(p.size());
  Workers workers(1);
  SeaFrame frame;
  float highest = 0.0f, steepest = 0.0f;
  for (const double t_s : {0.0, 7.3, 600.0}) {
    advance(beach.sea, t_s, frame, workers);
    const WaterSurface surface(beach.parts(), frame);
    surface.heights(p, z);
    surface.slopes(p, slope);
    for (std::size_t i = 0; i < p.size(); ++i) {
      highest = std::max(highest, std::abs(z[i]));
      steepest = std::max(steepest, glm::length(slope[i]));
    }
  }
  const WaterBounds bounds = WaterBody(beach.parts()).bounds();
  EXPECT_LE(highest, bounds.height_m);
  EXPECT_GT(highest, 0.2f * bounds.height_m);
  EXPECT_LE(static_cast<double>(steepest), bounds.steepest);
  EXPECT_GT(static_cast<double>(steepest), 0.05 * bounds.steepest);
}

// Inside the area, in water deeper than the waves are high: share x trains, and what they leave.
TEST(WaterBody, AddsTheTrainsAndTheirRestOfTheSea) {
  const Beach beach(windy());
  Workers workers(1);
  SeaFrame frame;
  advance(beach.sea, 3.0, frame, workers);
  int both = 0;
  for (const glm::dvec2& p : scattered(500, 560.0)) {
    if (depth_at(beach.floor, p) < 0.3 + beach.sea.significant_height_m()) continue;
    float z, sea, trains, share;
    WaterBody(beach.parts()).heights(frame, {&p, 1}, {&z, 1});
    sample_heights(frame, {&p, 1}, {&sea, 1});
    sample_coast(beach.coast, 3.0, {&p, 1}, {&trains, 1}, {&share, 1});
    ASSERT_NEAR(z, trains + std::sqrt(1.0f - share * share) * sea, 1e-6f);
    both += share > 0.1f && share < 0.9f;
  }
  EXPECT_GT(both, 20);
}

}  // namespace
}  // namespace swell::ocean
