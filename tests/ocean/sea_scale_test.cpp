#include "ocean/spectrum/sea_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"
#include "ocean/open_sea/sea.h"

namespace swell::ocean {
namespace {

TEST(SeaScale, StepsMeetAndHoldTheirPresets) {
  for (int code = 1; code <= kMaxDouglas; ++code) {
    EXPECT_EQ(douglas_step(code).low, douglas_step(code - 1).high) << code;
    EXPECT_GT(douglas_step(code).preset, douglas_step(code).low) << code;
    EXPECT_LT(douglas_step(code).preset, douglas_step(code).high) << code;
  }
  for (int number = 1; number <= kMaxBeaufort; ++number) {
    EXPECT_EQ(beaufort_step(number).low, beaufort_step(number - 1).high) << number;
    EXPECT_GT(beaufort_step(number).preset, beaufort_step(number).low) << number;
    EXPECT_LT(beaufort_step(number).preset, beaufort_step(number).high) << number;
  }
  EXPECT_EQ(douglas_step(0).preset, 0.0);
  EXPECT_EQ(beaufort_step(0).preset, 0.0);
}

TEST(SeaScale, AnExactBoundBelongsToTheLowerCode) {
  EXPECT_EQ(douglas_code(0.0), 0);
  EXPECT_EQ(douglas_code(1e-9), 1);
  EXPECT_EQ(douglas_code(4.0), 5);
  EXPECT_EQ(douglas_step(5).name, "rough");
  EXPECT_EQ(douglas_code(std::nextafter(4.0, 5.0)), 6);
  EXPECT_EQ(douglas_code(14.0), 8);
  EXPECT_EQ(douglas_code(100.0), 9);
}

// Hs = 4 sqrt(0.0081 / 5) g / omega_m^2 with omega_m = 2 pi 0.13 g / U10: 0.2413 U10^2 / g.
TEST(SeaScale, HeightsAndWindsFollowTheFormOfTheSpectrum) {
  for (const double wind : {1.5, 7.0, 15.0, 26.0}) {
    const double height = developed_height_m(wind, kG);
    EXPECT_NEAR(height, 0.24131 * wind * wind / kG, 1e-4 * height);
    EXPECT_NEAR(wind_of_developed_height(height, kG), wind, 1e-12 * wind);
  }
  EXPECT_EQ(developed_height_m(0.0, kG), 0.0);
  EXPECT_EQ(wind_of_developed_height(0.0, kG), 0.0);
  // T = U / (0.13 g), lambda = g T^2 / (2 pi).
  EXPECT_NEAR(peak_wavelength_m(20.0, kG), 384.0, 0.5);
}

// The check of the physics: what the patches hold, for this seed, is the sea that was asked for.
TEST(SeaScale, EveryCodeMakesASeaInsideItsStep) {
  for (int code = 0; code <= kMaxDouglas; ++code) {
    SeaDescription sea;
    sea.wind_speed_mps = wind_of_developed_height(douglas_step(code).preset, kG);
    sea.patch_lengths_m = patch_lengths_for_peak(peak_wavelength_m(sea.wind_speed_mps, kG));
    for (sea.seed = 1; sea.seed <= 3; ++sea.seed)
      EXPECT_EQ(douglas_code(Sea(sea).significant_height_m()), code) << "seed " << sea.seed;
  }
}

}  // namespace
}  // namespace swell::ocean
