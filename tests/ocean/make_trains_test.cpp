// The wave trains that stand for a wind's sea at a coast: their energy, periods and directions.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constants.h"
#include "ocean/coast/peachey.h"

namespace swell::ocean {
namespace {

TEST(MakeTrains, HoldTheEnergyOfTheirBand) {
  const WaveSystem wind = make_wind_sea(12.0, 1.0, kG);
  const double m0 = variance_below(wind, kInf);
  const double peak_s = 12.0 / (0.13 * kG);
  for (const int count : {1, 4, 6, 16}) {
    double variance = 0.0, period_before = kInf;
    for (const WaveTrain& train : make_trains(wind, count, 5)) {
      variance += 0.5 * train.amplitude_m * train.amplitude_m;
      EXPECT_LE(train.period_s, period_before);
      period_before = train.period_s;
      EXPECT_LT(train.period_s, peak_s / 0.74);  // exp(-5/4 r^-4) = 0.02 at r = 0.752
      EXPECT_GT(train.period_s, peak_s / 1.87);  // and 0.9 at r = 1.856
      EXPECT_NEAR(glm::length(train.travel), 1.0, 1e-12);
    }
    EXPECT_NEAR(variance / (0.88 * m0), 1.0, 1e-12);
  }
}

TEST(MakeTrains, SpreadAroundTheWindAsTheSpectrumDoes) {
  const WaveSystem wind = make_wind_sea(10.0, 2.0, kG);
  glm::dvec2 sum(0.0);
  double peak_cos = 0.0;
  int near_peak = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    for (const WaveTrain& train : make_trains(wind, 8, seed)) {
      sum += train.travel;
      const double r = 10.0 / (0.13 * kG) / train.period_s;
      if (r < 0.95 || r > 1.05) continue;
      peak_cos += glm::dot(train.travel, wind.travel);
      ++near_peak;
    }
  }
  const glm::dvec2 mean = glm::normalize(sum);
  EXPECT_GT(glm::dot(mean, wind.travel), std::cos(2.0 * kDegree));
  // First moment p / (p + 1) with p = 9.77 (f / f_m)^mu, about 0.90 around the peak.
  EXPECT_NEAR(peak_cos / near_peak, 9.0 / 10.0, 0.02);
}

TEST(MakeTrains, DependOnTheSeedAlone) {
  const WaveSystem wind = make_wind_sea(10.0, 2.0, kG);
  const auto periods = [&](std::uint64_t seed) {
    std::vector<double> p;
    for (const WaveTrain& train : make_trains(wind, 5, seed)) p.push_back(train.period_s);
    return p;
  };
  EXPECT_EQ(periods(3), periods(3));
  EXPECT_NE(periods(3), periods(4));
}

}  // namespace
}  // namespace swell::ocean
