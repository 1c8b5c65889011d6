// What comes back of a lidar's light, and the patterns that its beams make.
#include "render/measure/lidar_echo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"
#include "math/random.h"
#include "render/measure/lidar_patterns.h"

namespace swell::render {
namespace {

// The echo of many facets with Gaussian slopes: what they mirror into a cone about the beam,
// over what a white matt surface sends there.
double counted_echo(double tilt_rad, glm::dvec2 slope, double unresolved) {
  constexpr double kCone_rad = 0.06;
  constexpr std::uint64_t kFacets = 300'000;
  const glm::dvec3 to_sensor(std::sin(tilt_rad), 0.0, std::cos(tilt_rad));
  double flux = 0.0;
  for (std::uint64_t n = 0; n < kFacets; ++n) {
    const GaussianPair g = random_gaussian_pair(11, n);
    const glm::dvec2 s = slope + std::sqrt(0.5 * unresolved) * glm::dvec2(g.first, g.second);
    const glm::dvec3 facet(-s.x, -s.y, 1.0);  // its area over a square metre of sea is its length
    const double lit = glm::dot(facet, to_sensor);
    if (lit <= 0.0) continue;
    const glm::dvec3 normal = glm::normalize(facet);
    const glm::dvec3 mirrored = 2.0 * glm::dot(normal, to_sensor) * normal - to_sensor;
    if (glm::dot(mirrored, to_sensor) > std::cos(kCone_rad)) flux += 0.0198 * lit;
  }
  const double cone_sr = 2.0 * kPiRef * (1.0 - std::cos(kCone_rad));
  const double radiance = flux / static_cast<double>(kFacets) / cone_sr / std::cos(tilt_rad);
  return kPiRef * radiance;
}

TEST(LidarEcho, OfClearWaterIsThatOfCountedFacets) {
  for (const double wind_mps : {4.0, 10.0})
    for (const double tilt_rad : {0.0, 0.1, 0.2}) {
      const double unresolved = unresolved_slope(wind_mps, 0.0);
      for (const glm::dvec2& slope : {glm::dvec2(0.0), glm::dvec2(0.05, -0.1)}) {
        const glm::dvec3 along(-std::sin(tilt_rad), 0.0, -std::cos(tilt_rad));
        const double expected = counted_echo(tilt_rad, slope, unresolved);
        EXPECT_NEAR(clear_water_echo(along, slope, unresolved), expected, 0.06 * expected + 0.002)
            << wind_mps << " m/s, " << tilt_rad;
      }
    }
}

TEST(LidarEcho, OfClearWaterIsStraightDownAlone) {
  const auto echo = [](double tilt_deg) {
    const double tilt = tilt_deg * kPiRef / 180.0;
    return clear_water_echo({std::sin(tilt), 0.0, -std::cos(tilt)}, {0.0, 0.0},
                            unresolved_slope(5.0, 0.0));
  };
  EXPECT_GT(echo(0.0), 0.15);
  EXPECT_LT(echo(30.0), 1e-4);
  EXPECT_EQ(echo(80.0), 0.0);
  EXPECT_EQ(echo(100.0), 0.0) << "upwards";
}

TEST(LidarEcho, OfFoamIsThatOfAMattSurface) {
  EXPECT_NEAR(water_echo(0.0, 1.0, 0.5), 0.165, 1e-12);
  EXPECT_NEAR(water_echo(0.2, 0.25, 1.0), 0.15 + 0.0825, 1e-12);
}

TEST(LidarEcho, IsSeenAsOftenAsTheModelSays) {
  for (const double q : {0.8, 0.95, 1.0, 1.05, 1.3}) {
    int seen = 0;
    constexpr int kTries = 40000;
    for (std::uint64_t n = 0; n < kTries; n += 2) {
      const GaussianPair g = random_gaussian_pair(3, n);
      seen += is_detected(0.1 * q, 40.0, 40.0, g.first);
      seen += is_detected(0.4 * q, 80.0, 40.0, g.second);
    }
    const double expected = 0.5 * std::erfc(-10.0 * (1.0 - 1.0 / q) / std::sqrt(2.0));
    EXPECT_NEAR(seen / double{kTries}, expected, 0.01) << q;
  }
  EXPECT_TRUE(is_detected(0.0, 1e5, 0.0, -5.0)) << "no receiver";
}

TEST(LidarPatterns, HaveTheAnglesOfTheirDataSheets) {
  const SpinningModel* const vlp = find_spinning_model("vlp-16");
  const SpinningModel* const hdl = find_spinning_model("hdl-32e");
  ASSERT_TRUE(vlp && hdl && find_spinning_model("os1-64") && find_spinning_model("os1-128"));
  EXPECT_EQ(find_spinning_model("vlp"), nullptr);
  for (int beam = 0; beam < 16; ++beam)
    EXPECT_NEAR(vlp->elevation_deg(beam), -15.0 + 2.0 * beam, 1e-12);
  EXPECT_NEAR(hdl->elevation_deg(0), -30.67, 0.01);
  EXPECT_NEAR(hdl->elevation_deg(23), 0.0, 1e-12);
  EXPECT_NEAR(hdl->elevation_deg(31), 10.67, 0.01);
  EXPECT_NEAR(find_spinning_model("os1-128")->elevation_deg(127), 22.5, 1e-12);
}

TEST(LidarPatterns, TurnClockwiseColumnByColumn) {
  const auto beams =
      spinning_beams(*find_spinning_model("vlp-16"),
                     {.columns = 360, .duration_s = 0.2, .start_azimuth_rad = 0.5 * kPiRef});
  ASSERT_EQ(beams.size(), 360u * 16u);
  EXPECT_NEAR(beams[0].azimuth_rad, 0.5 * kPiRef, 1e-12);
  EXPECT_NEAR(beams[90 * 16].azimuth_rad, 0.0, 1e-12);
  EXPECT_NEAR(beams[90 * 16].time_s, 0.05, 1e-12);
  EXPECT_EQ(beams[90 * 16 + 15].time_s, beams[90 * 16].time_s);
  EXPECT_NEAR(beams[90 * 16 + 15].elevation_rad, 15.0 * kPiRef / 180.0, 1e-12);
}

TEST(LidarPatterns, GridsFillTheirField) {
  const auto beams =
      grid_beams({.width = 4, .height = 2, .width_rad = 0.8, .height_rad = 0.2, .duration_s = 0.1});
  ASSERT_EQ(beams.size(), 8u);
  EXPECT_NEAR(beams[0].azimuth_rad, 0.3, 1e-12);
  EXPECT_NEAR(beams[3].azimuth_rad, -0.3, 1e-12);
  EXPECT_NEAR(beams[0].elevation_rad, 0.05, 1e-12);
  EXPECT_NEAR(beams[4].elevation_rad, -0.05, 1e-12);
  EXPECT_NEAR(beams[4].time_s, 0.05, 1e-12);
}

}  // namespace
}  // namespace swell::render
