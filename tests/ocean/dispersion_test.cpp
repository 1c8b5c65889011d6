#include "ocean/spectrum/dispersion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"
#include "math/random.h"

namespace swell::ocean {
namespace {

double omega_of(double period_s) { return 2.0 * kPiRef / period_s; }

// k by bisection of omega^2 = g k tanh(k h) with the C library's tanh in long double.
double bisected_wave_number(double omega, double depth_m) {
  long double low = omega * omega / kG, high = low + 2.0 * omega / std::sqrt(kG * depth_m);
  for (int i = 0; i < 200; ++i) {
    const long double k = 0.5L * (low + high);
    (kG * k * std::tanh(k * depth_m) < static_cast<long double>(omega) * omega ? low : high) = k;
  }
  return static_cast<double>(low);
}

struct Row {
  double period_s, depth_m, k, length_m, speed_mps, n, shoaling;
};

constexpr Row kTable[] = {{10, kInf, 0.0402430353, 156.130999, 15.613100, 0.500000, 1.000000},
                          {10, 100, 0.0402686311, 156.031758, 15.603176, 0.502560, 0.997767},
                          {10, 50, 0.0415284525, 151.298325, 15.129833, 0.565297, 0.955375},
                          {10, 20, 0.0518256815, 121.236907, 12.123691, 0.764990, 0.917454},
                          {10, 10, 0.0680190743, 92.373873, 9.237387, 0.873617, 0.983546},
                          {10, 5, 0.0928360391, 67.680454, 6.768045, 0.934797, 1.110808},
                          {10, 2, 0.1437814889, 43.699543, 4.369954, 0.973464, 1.354663},
                          {10, 1, 0.2019621424, 31.110708, 3.111071, 0.986658, 1.594745},
                          {5, 10, 0.1717028445, 36.593368, 7.318674, 0.610884, 0.934371},
                          {15, 30, 0.0268267935, 234.213057, 15.614204, 0.835273, 0.947547},
                          {8, 4, 0.1308838452, 48.005812, 6.000727, 0.919109, 1.064117},
                          {2, 0.5, 1.5489459872, 4.056426, 2.028213, 0.844667, 0.954652}};

// PHY-01, PHY-04.
TEST(Dispersion, HasTheWavesOfTheTable) {
  for (const Row& row : kTable) {
    const double omega = omega_of(row.period_s);
    const double k = wave_number(omega, row.depth_m, kG);
    EXPECT_NEAR(k, row.k, 0.51e-10) << row.period_s << " s, " << row.depth_m << " m";
    EXPECT_NEAR(2.0 * kPiRef / k, row.length_m, 1e-6);
    EXPECT_NEAR(omega / k, row.speed_mps, 1e-6);
    EXPECT_NEAR(group_ratio(k * row.depth_m), row.n, 0.6e-6);
    EXPECT_NEAR(shoaling_coefficient(k * row.depth_m), row.shoaling, 0.6e-6);
    EXPECT_NEAR(group_speed(omega, row.depth_m, kG), row.n * row.speed_mps, 1e-5);
  }
}

// PHY-01.
TEST(Dispersion, FindsTheRootThatBisectionFinds) {
  double worst = 0.0, worst_residual = 0.0;
  for (std::uint64_t n = 0; n < 5000; ++n) {
    const double omega = omega_of(0.5 * std::pow(60.0, random_uniform(1, n)));
    const double depth_m = 0.01 * std::pow(1e6, random_uniform(2, n));
    const double k = wave_number(omega, depth_m, kG);
    const double expected = bisected_wave_number(omega, depth_m);
    worst = std::max(worst, std::abs(k / expected - 1.0));
    const double residual = omega * omega - kG * k * std::tanh(k * depth_m);
    worst_residual = std::max(worst_residual, std::abs(residual) / (omega * omega));
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worst_residual, 1e-12);
}

// PHY-03.
TEST(Dispersion, HasTheDeepAndShallowLimits) {
  const double omega = omega_of(7.0);
  const double k_deep = omega * omega / kG;
  for (const double kh : {25.0, 40.0, 1e6}) {
    EXPECT_NEAR(wave_number(omega, kh / k_deep, kG) / k_deep, 1.0, 1e-6);
  }
  for (const double kh : {0.01, 1e-3, 1e-5}) {  // shallow: k h = omega sqrt(h / g)
    const double depth_m = kG * (kh / omega) * (kh / omega);
    EXPECT_NEAR(wave_number(omega, depth_m, kG) * depth_m / kh, 1.0, 1e-4);
  }
}

// PHY-01.
TEST(Dispersion, AnswersForNoDepthAndNoFrequency) {
  EXPECT_EQ(wave_number(1.0, 0.0, kG), kInf);
  EXPECT_EQ(wave_number(1.0, -3.0, kG), kInf);
  EXPECT_EQ(wave_number(0.0, 10.0, kG), 0.0);
  EXPECT_EQ(wave_number(0.0, 0.0, kG), 0.0);
  EXPECT_EQ(wave_number(0.5, kInf, kG), 0.25 / kG);
  EXPECT_EQ(group_ratio(0.0), 1.0);
  EXPECT_EQ(group_ratio(kInf), 0.5);
  EXPECT_EQ(group_speed(1.0, 0.0, kG), 0.0);
  EXPECT_EQ(shoaling_coefficient(0.0), kInf);
  EXPECT_EQ(shoaling_coefficient(kInf), 1.0);
}

// PHY-03.
TEST(Dispersion, ShortensWavesAsTheWaterGetsShallower) {
  for (const double period_s : {1.0, 6.0, 14.0}) {
    double k_before = 0.0;
    for (double depth_m = 500.0; depth_m > 0.01; depth_m *= 0.93) {
      const double k = wave_number(omega_of(period_s), depth_m, kG);
      EXPECT_GE(k, k_before * (1.0 - 2e-13));  // the stated error
      EXPECT_LE(omega_of(period_s) / k, std::sqrt(kG * depth_m) * (1.0 + 1e-14));
      k_before = k;
    }
  }
}

// PHY-04.
TEST(Dispersion, GivesEnergyTheSpeedOfTheFrequencysSlope) {
  for (const double depth_m : {0.5, 3.0, 12.0, 70.0, 1000.0}) {
    for (const double period_s : {2.0, 5.0, 10.0, 20.0}) {
      const double k = wave_number(omega_of(period_s), depth_m, kG);
      const auto omega = [&](double q) { return std::sqrt(kG * q * std::tanh(q * depth_m)); };
      const double slope = (omega(1.001 * k) - omega(0.999 * k)) / (0.002 * k);
      EXPECT_NEAR(group_speed(omega_of(period_s), depth_m, kG) / slope, 1.0, 1e-4);
      EXPECT_GE(group_ratio(k * depth_m), 0.5);
      EXPECT_LE(group_ratio(k * depth_m), 1.0);
    }
  }
}

// PHY-11.
TEST(Dispersion, ShoalsLeastWhereKhTanhKhIsOne) {
  double least = 10.0, least_kh = 0.0;
  for (double kh = 0.5; kh < 3.0; kh += 1e-5) {
    const double shoaling = shoaling_coefficient(kh);
    if (shoaling < least) least = shoaling, least_kh = kh;
  }
  EXPECT_NEAR(least, 0.912993, 1e-6);
  EXPECT_NEAR(least_kh, 1.1997, 2e-3);  // flat there
  EXPECT_NEAR(least_kh * std::tanh(least_kh), 1.0, 3e-3);
  EXPECT_NEAR(least_kh * std::tanh(least_kh) / (2.0 * kPiRef), 0.15915, 5e-4);  // h / L0
}

// PHY-12.
TEST(Dispersion, FollowsGreensLawInShallowWater) {
  // Green: Ks = (2 kh)^(-1/2) with kh = omega sqrt(h / g), so that H ~ h^(-1/4).
  const auto over_green = [](double kh) {
    const double shallow_kh = std::sqrt(kh * std::tanh(kh));
    return shoaling_coefficient(kh) * std::sqrt(2.0 * shallow_kh);
  };
  EXPECT_NEAR(over_green(0.05), 1.0006, 1e-4);
  EXPECT_NEAR(over_green(0.1), 1.0025, 1e-4);
  EXPECT_NEAR(over_green(0.2), 1.0099, 1e-4);
  EXPECT_NEAR(over_green(0.3), 1.022, 5e-4);
  EXPECT_NEAR(over_green(0.5), 1.060, 2e-3);
  const double omega = omega_of(12.0);
  const auto log_height = [&](double depth_m) {
    return std::log(shoaling_coefficient(wave_number(omega, depth_m, kG) * depth_m));
  };
  for (const double depth_m : {0.02, 0.1, 0.3}) {  // kh up to 0.1
    const double slope = (log_height(1.1 * depth_m) - log_height(depth_m)) / std::log(1.1);
    EXPECT_NEAR(slope, -0.25, 0.005) << depth_m;
  }
}

}  // namespace
}  // namespace swell::ocean
