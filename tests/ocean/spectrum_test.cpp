#include "ocean/spectrum/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "constants.h"
#include "ocean/spectrum/dispersion.h"

namespace swell::ocean {
namespace {

// Midpoint rule.
template <class F>
double integrate(double from, double to, int steps, F f) {
  double sum = 0.0;
  const double step = (to - from) / steps;
  for (int i = 0; i < steps; ++i) sum += f(from + (i + 0.5) * step);
  return sum * step;
}

TEST(Spectrum, HasTheSignificantHeightAndPeakPeriodOfTheTable) {
  struct Row {
    double wind_mps, height_m, period_s;
  };
  for (const Row& row : {Row{5, 0.6150, 3.921}, Row{10, 2.4598, 7.841}, Row{15, 5.5346, 11.762},
                         Row{20, 9.8393, 15.683}}) {
    const WaveSystem sea = make_wind_sea(row.wind_mps, 0.0, kG);
    EXPECT_NEAR(4.0 * std::sqrt(variance_below(sea, kInf)), row.height_m, 1e-4);
    EXPECT_NEAR(1.0 / sea.peak_hz, row.period_s, 1e-3);
  }
}

TEST(Spectrum, IntegratesToItsClosedForm) {
  const WaveSystem sea = make_wind_sea(15.0, 0.0, kG);
  for (const double limit_hz : {0.08, 0.1, 0.2, 1.0, 5.0}) {
    const double sum =
        integrate(0.0, limit_hz, 100000, [&](double f) { return frequency_spectrum(sea, f); });
    EXPECT_NEAR(sum / variance_below(sea, limit_hz), 1.0, 1e-4) << limit_hz;
  }
}

TEST(Spectrum, HoldsTheKnownPartOfTheEnergyBelowMultiplesOfThePeak) {
  const WaveSystem sea = make_wind_sea(12.0, 0.0, kG);
  const double peak = 0.13 * kG / 12.0;
  const double m0 = variance_below(sea, kInf);
  const std::pair<double, double> parts[] = {
      {1.5, 0.7812}, {2, 0.9248}, {3, 0.9847}, {4, 0.9951}, {5, 0.9980}};
  for (const auto& [multiple, part] : parts) {
    EXPECT_NEAR(variance_below(sea, multiple * peak) / m0, part, 5e-5);
  }
}

TEST(Spectrum, PeaksAtThePeakFrequency) {
  const WaveSystem sea = make_wind_sea(15.0, 0.0, kG);
  double best_hz = 0.0, best = 0.0;
  for (double f = 0.05; f < 0.2; f += 1e-6) {
    const double energy = frequency_spectrum(sea, f);
    if (energy > best) best = energy, best_hz = f;
  }
  EXPECT_NEAR(best_hz / (0.13 * kG / 15.0), 1.0, 1e-3);
}

TEST(Spreading, ExponentHasMastinsValues) {
  const std::pair<double, double> rows[] = {{0.5, 0.58575}, {0.8, 3.94857}, {1.0, 9.77},
                                            {1.5, 3.78304}, {2.0, 1.92968}, {3.0, 0.74719}};
  for (const auto& [ratio, p] : rows) EXPECT_NEAR(spreading_exponent(ratio), p, 1e-5);
}

TEST(Spreading, WeightDownwindHasTheKnownValues) {
  const std::pair<double, double> rows[] = {{0.5, 0.2500},   {1.0, 0.318310},  {2.0, 0.424413},
                                            {5.0, 0.646725}, {9.77, 0.893092}, {30.0, 1.551548}};
  for (const auto& [p, weight] : rows) EXPECT_NEAR(directional_weight(p, 1.0), weight, 1e-6);
}

TEST(Spreading, WeightIntegratesToOneWithTheKnownFirstMoment) {
  for (const double p : {0.1, 0.5, 1.0, 9.77, 50.0, 100.0, 200.0}) {
    const auto weight = [&](double theta) { return directional_weight(p, std::cos(theta)); };
    EXPECT_NEAR(integrate(-kPiRef, kPiRef, 200000, weight), 1.0, 1e-6) << p;
    const auto moment = [&](double theta) { return weight(theta) * std::cos(theta); };
    EXPECT_NEAR(integrate(-kPiRef, kPiRef, 200000, moment), p / (p + 1.0), 1e-6) << p;
  }
}

TEST(WaveVectorSpectrum, IntegratesToTheVariance) {
  const WaveSystem sea = make_wind_sea(15.0, 60.0 * kDegree, kG);
  // In k = q^2, which spreads the steep foot, and theta.
  const double k_end = 1.0;
  const double sum = integrate(0.0, std::sqrt(k_end), 2000, [&](double q) {
    const double k = q * q;
    return 2.0 * q * k * integrate(0.0, 2.0 * kPiRef, 200, [&](double theta) {
             return wave_vector_spectrum(sea, {k * std::cos(theta), k * std::sin(theta)});
           });
  });
  const double f_end_hz = std::sqrt(kG * k_end) / (2.0 * kPiRef);
  EXPECT_NEAR(sum / variance_below(sea, f_end_hz), 1.0, 1e-4);
}

TEST(WaveVectorSpectrum, IsLargestWhereTheWindBlowsTo) {
  const double k = 0.03;
  // From the west: waves travel east.
  const WaveSystem west = make_wind_sea(15.0, 270.0 * kDegree, kG);
  const double east = wave_vector_spectrum(west, {k, 0.0});
  EXPECT_GT(east, 2.0 * wave_vector_spectrum(west, {0.0, k}));
  EXPECT_GT(east, 100.0 * wave_vector_spectrum(west, {-k, 0.0}));
  // From 60 degrees: towards 240 degrees, south-west by west.
  const WaveSystem from_60 = make_wind_sea(15.0, 60.0 * kDegree, kG);
  double best = 0.0, best_deg = 0.0;
  for (double to = 0.0; to < 360.0; to += 0.5) {
    const double s =
        wave_vector_spectrum(from_60, {k * std::sin(to * kDegree), k * std::cos(to * kDegree)});
    if (s > best) best = s, best_deg = to;
  }
  EXPECT_NEAR(best_deg, 240.0, 0.5);
}

TEST(WaveVectorSpectrum, IsZeroWithoutWindAndAtTheMean) {
  EXPECT_EQ(wave_vector_spectrum(make_wind_sea(0.0, 1.0, kG), {0.1, 0.2}), 0.0);
  EXPECT_EQ(wave_vector_spectrum(make_wind_sea(15.0, 1.0, kG), {0.0, 0.0}), 0.0);
  EXPECT_EQ(variance_below(make_wind_sea(0.0, 1.0, kG), 1.0), 0.0);
}

TEST(WaveVectorSpectrum, StaysFiniteForAnyWind) {
  for (const double wind : {1e-300, 1e-9, 0.1, 60.0}) {
    const WaveSystem sea = make_wind_sea(wind, 0.3, kG);
    for (const double k : {1e-12, 1e-3, 1.0, 1e6}) {
      const double s = wave_vector_spectrum(sea, {0.6 * k, -0.8 * k});
      EXPECT_TRUE(std::isfinite(s) && s >= 0.0) << wind << ' ' << k;
    }
  }
}

TEST(Dispersion, HasItsDeepAndShallowLimits) {
  EXPECT_NEAR(deep_water_omega(0.25, kG), std::sqrt(0.25 * kG), 1e-12);
  EXPECT_NEAR(water_omega(0.25, 200.0, kG), std::sqrt(0.25 * kG), 1e-12);
  // Long waves travel at sqrt(g h).
  EXPECT_NEAR(water_omega(1e-4, 5.0, kG) / 1e-4, std::sqrt(kG * 5.0), 1e-5);
  EXPECT_EQ(water_omega(0.25, 0.0, kG), 0.0);
  EXPECT_NEAR(water_omega(0.2, 5.0, kG), std::sqrt(kG * 0.2 * std::tanh(1.0)), 1e-12);
}

}  // namespace
}  // namespace swell::ocean
