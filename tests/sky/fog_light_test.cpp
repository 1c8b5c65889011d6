// Light in fog against known answers, sums along the way, and what has to come out again.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "constants.h"
#include "sky/fog.h"

namespace swell::sky {
namespace {

// A way down through an even layer of height H, from h.
FogWay way_down(double per_m, double top_m, double eye_m, double angle_rad) {
  return {per_m * eye_m / std::sin(angle_rad), per_m * (top_m - eye_m), -std::sin(angle_rad)};
}

// FOG-02.
TEST(FogLight, PhaseHasBlinnsValues) {
  for (const double l : {0.0, 0.3, 0.6, 0.85}) {
    EXPECT_NEAR(blinn_phase(1.0, l), 1.0 / (1.0 - l), 1e-12);
    EXPECT_NEAR(blinn_phase(-1.0, l), (1.0 - l) * (1.0 - l) / std::pow(1.0 + l, 3.0), 1e-12);
  }
  EXPECT_DOUBLE_EQ(blinn_phase(0.3, 0.0), 1.0);
}

TEST(FogLight, PhaseIntegratesAsItShould) {
  const auto integral = [](auto phase) {
    constexpr int kSteps = 200000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) sum += phase(-1.0 + 2.0 * (i + 0.5) / kSteps);
    return 2.0 * kPiRef * sum * 2.0 / kSteps;
  };
  const double known[][2] = {{0.3, 6.766507}, {0.6, 3.141593}, {0.85, 1.018895}};
  for (const auto& [l, value] : known) {
    EXPECT_NEAR(integral([l](double c) { return blinn_phase(c, l); }), value, 2e-6);
    EXPECT_NEAR(integral([l](double c) { return fog_phase(c, l); }), 1.0, 1e-6);
  }
}

// FOG-03.
TEST(FogLight, LayerScattersAsKnown) {
  const FogWay way = way_down(1e-3, 200.0, 100.0, 0.3);
  const double sun = std::sin(0.7);
  EXPECT_NEAR(scattered_once(way, sun) / 1e-3, 228.671, 5e-4);
  EXPECT_NEAR(scattered_by_paper(way, 1e-3 * 200.0, sun) / 1e-3, 210.463, 5e-4);
}

TEST(FogLight, IsTheSumAlongTheWay) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const double depth = std::pow(10.0, -4.0 + 5.5 * unit(random));
    const double rise = -1.0 + 2.0 * unit(random);
    // What lies above falls by rise a unit of depth and does not end below 0.
    const double above = std::max(rise, 0.0) * depth + 3.0 * unit(random);
    const double sun = 0.02 + 0.98 * unit(random);
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = depth * (i + 0.5) / kSteps;
      sum += std::exp(-t - (above - rise * t) / sun);
    }
    sum *= depth / kSteps;
    EXPECT_NEAR(scattered_once({depth, above, rise}, sun), sum, 1e-4 * sum + 1e-12)
        << depth << ' ' << above << ' ' << rise << ' ' << sun;
  }
}

// FOG-01.
TEST(FogLight, LimitsAreFinite) {
  EXPECT_NEAR(scattered_once({1e-12, 1e-12, -0.5}, 0.5), 1e-12, 1e-18);
  EXPECT_EQ(scattered_once({0.0, 0.0, -0.5}, 0.5), 0.0);
  // A level way without end: what its beginning has of the sun.
  EXPECT_NEAR(scattered_once({1e6, 0.2, 0.0}, 0.5), std::exp(-0.4), 1e-9);
  EXPECT_NEAR(scattered_by_paper({1e6, 0.2, 0.0}, 0.3, 0.5), std::exp(-0.6), 1e-9);
  // A sun at the horizon, and a look straight at the sun.
  EXPECT_NEAR(scattered_once({1.0, 0.5, 0.0}, 1e-3), 0.0, 1e-30);
  EXPECT_NEAR(scattered_once({2.0, 1.0, 0.5}, 0.5), 2.0 * std::exp(-2.0), 1e-9);
  for (const FogWay& way : {FogWay{1e9, 1e9, 1.0}, FogWay{1e9, 1e8, -1.0}, FogWay{50.0, 40.0, 0.8}})
    for (const double sun : {1e-3, 0.1, 1.0}) {
      const double light = scattered_once(way, sun);
      EXPECT_TRUE(std::isfinite(light) && light >= 0.0) << light;
    }
}

// Source: D. Atlas, Optical extinction by rainfall, Journal of Meteorology 10, 1953: visibility.
TEST(FogLight, RainTakesContrastAsAtlasMeasured) {
  struct Known {
    double rain_mm_h, visibility_km;
  };
  for (const Known& known : {Known{1.0, 11.6}, Known{10.0, 2.72}, Known{100.0, 0.637}}) {
    FoggyAir air;
    air.rain_mm_h = known.rain_mm_h;
    const glm::dvec3 per_m = fog_per_m(air);
    EXPECT_NEAR(std::exp(-per_m.x * known.visibility_km * 1e3), 0.02, 2e-4) << known.rain_mm_h;
    EXPECT_EQ(per_m.x, per_m.z);
  }
  FoggyAir air;
  air.visibility_m = 1000.0;
  const double fog = fog_per_m(air).y;
  air.rain_mm_h = 10.0;
  EXPECT_NEAR(fog_per_m(air).y, fog + rain_per_m(10.0), 1e-15);
  EXPECT_NEAR(fog_above_m(air, 500.0), 1000.0, 1e-9);
  air.fog_top_m = 0.0;
  EXPECT_EQ(fog_per_m(air).y, rain_per_m(10.0));
  EXPECT_EQ(rain_per_m(0.0), 0.0);
}

TEST(FogLight, NoneWithoutHeightOrAttenuation) {
  FoggyAir air;
  EXPECT_EQ(fog_per_m(air), glm::dvec3(0.0));
  air.visibility_m = 1000.0;
  air.fog_top_m = 0.0;
  EXPECT_EQ(fog_per_m(air), glm::dvec3(0.0));
  air.fog_top_m = 50.0;
  EXPECT_NEAR(fog_per_m(air).x, 3.912e-3, 1e-6);
  air.profile = FogProfile::kExponential;
  EXPECT_NEAR(fog_above_m(air, 0.0), 50.0, 1e-12);
  EXPECT_NEAR(fog_above_m(air, 50.0), 50.0 / std::numbers::e, 1e-12);
}

// Light from the sky on all sides, over white ground, stays as it is.
TEST(FogLight, WhiteFurnaceStaysWhite) {
  for (const double depth : {1e-6, 0.01, 0.4, 3.0, 50.0}) {
    const FogLight light = light_in_fog(depth, 0.75, 0.0, 0.0, 1.0, 1.0);
    EXPECT_NEAR(light.even, 1.0, 1e-12);
    EXPECT_NEAR(light.ambient, 1.0, 1e-12);
  }
}

// What the sun's beam loses leaves the layer: the same light, counted where it comes out, above and
// below, by sums over directions of their own.
TEST(FogLight, AllThatIsLostComesOut) {
  for (const double depth : {0.02, 0.4, 2.0, 8.0})
    for (const double sun_sine : {0.1, 0.5, 0.95})
      for (const double l : {0.0, 0.6, 0.8}) {
        const FogLight light = light_in_fog(depth, l, sun_sine, 1.0, 0.0, 0.0);
        constexpr int kRings = 160, kSectors = 120;
        const double across_sun = std::sqrt(1.0 - sun_sine * sun_sine);
        double out = 0.0;
        for (int i = 0; i < kRings; ++i) {
          const double z = (i + 0.5) / kRings, across = std::sqrt(1.0 - z * z);
          const double even = light.even * (1.0 - std::exp(-depth / z));
          const double down = scattered_once({depth / z, 0.0, -z}, sun_sine);
          const double up = scattered_once({depth / z, depth, z}, sun_sine);
          for (int k = 0; k < kSectors; ++k) {
            const double level =
                across * across_sun * std::cos(2.0 * kPiRef * (k + 0.5) / kSectors);
            out += z * (2.0 * even + down * fog_phase(level - z * sun_sine, l) +
                        up * fog_phase(level + z * sun_sine, l));
          }
        }
        out *= 2.0 * kPiRef / (kRings * kSectors);
        const double lost = sun_sine * (1.0 - light.sun_passes);
        EXPECT_NEAR(out, lost, 0.02 * lost) << depth << ' ' << sun_sine << ' ' << l;
        // And no more falls on the sea than on the fog.
        EXPECT_LE(light.ambient * kPiRef + sun_sine * light.sun_passes, sun_sine * 1.0001);
      }
}

}  // namespace
}  // namespace swell::sky
