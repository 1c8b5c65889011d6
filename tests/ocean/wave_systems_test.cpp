// Seas other than the fully developed one: JONSWAP's, of a fetch or of a height and a period, and
// swells.
#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"
#include "ocean/coast/peachey.h"
#include "ocean/open_sea/sea.h"
#include "ocean/spectrum/spectrum.h"

namespace swell::ocean {
namespace {

// The integral of f^n F(f) df by the midpoint rule on a fine grid around the peak.
double moment(const WaveSystem& system, int n) {
  const double step_hz = system.peak_hz / 4000.0;
  double sum = 0.0;
  for (int i = 0; i < 400000; ++i) {
    const double f = (i + 0.5) * step_hz;
    sum += std::pow(f, n) * frequency_spectrum(system, f) * step_hz;
  }
  return sum;
}

double height_of(const WaveSystem& system) { return 4.0 * std::sqrt(variance_below(system, kInf)); }

TEST(WaveSystems, VarianceIsTheIntegralOfTheSpectrum) {
  for (const double gamma : {1.0, 2.0, 3.3, 7.0}) {
    WaveSystem sea = make_wind_sea(12.0, 0.0, kG);
    sea.gamma = gamma;
    EXPECT_NEAR(variance_below(sea, kInf) / moment(sea, 0), 1.0, 3e-4) << gamma;
    for (const double part : {0.1, 0.5, 0.9}) {
      const double f_hz = sea.peak_hz * frequency_of_energy(sea, part);
      EXPECT_NEAR(variance_below(sea, f_hz) / variance_below(sea, kInf), part, 1e-5) << gamma;
    }
  }
}

// JONSWAP of gamma 3.3 has 1.52 times the variance of Pierson and Moskowitz's spectrum with the
// same alpha and peak, and a mean period Tz of 0.777 Tp (0.71 for a gamma of 1).
// Source: DNV-RP-C205, Environmental Conditions and Environmental Loads, section 3.5.5:
// A_gamma = 1 - 0.287 ln(gamma), Tz / Tp = 0.6673 + 0.05037 g - 0.006230 g^2 + 0.0003341 g^3.
TEST(WaveSystems, JonswapHasTheFiguresOfTheRecommendedPractice) {
  for (const double gamma : {1.0, 2.0, 3.3, 5.0}) {
    WaveSystem sea = make_wind_sea(12.0, 0.0, kG), plain = sea;
    sea.gamma = gamma;
    const double gain = variance_below(sea, kInf) / variance_below(plain, kInf);
    EXPECT_NEAR(gain * (1.0 - 0.287 * std::log(gamma)), 1.0, 0.01) << gamma;
    const double mean_s = std::sqrt(moment(sea, 0) / moment(sea, 2));
    const double want =
        0.6673 + 0.05037 * gamma - 0.006230 * gamma * gamma + 0.0003341 * gamma * gamma * gamma;
    EXPECT_NEAR(mean_s * sea.peak_hz, want, 0.012) << gamma;
  }
}

// x = g F / U^2; Hs g / U^2 = 0.0016 sqrt(x) (Hasselmann et al. 1973; within the scatter of the
// laws of peak and alpha), and never more than the fully developed sea.
TEST(WaveSystems, GrowWithTheFetch) {
  double before_m = 0.0, before_s = 0.0;
  for (const double fetch_m : {1e3, 1e4, 1e5, 1e6}) {
    const WaveSystem sea = make_fetch_sea(10.0, 0.0, kG, fetch_m, 3.3);
    const double x = kG * fetch_m / 100.0;
    if (x < 2e3) {  // further on the laws part: 1.25 at x = 1e4
      EXPECT_NEAR(height_of(sea) * kG / 100.0 / (0.0016 * std::sqrt(x)), 1.0, 0.12) << fetch_m;
    }
    EXPECT_GT(height_of(sea), before_m);
    EXPECT_GT(1.0 / sea.peak_hz, before_s);
    before_m = height_of(sea);
    before_s = 1.0 / sea.peak_hz;
  }
  const WaveSystem endless = make_fetch_sea(10.0, 0.0, kG, 1e7, 1.0);
  const WaveSystem developed = make_wind_sea(10.0, 0.0, kG);
  EXPECT_EQ(endless.peak_hz, developed.peak_hz);
  EXPECT_EQ(endless.alpha, developed.alpha);
}

TEST(WaveSystems, HaveTheHeightAndThePeriodThatWereAskedFor) {
  SeaDescription sea;
  sea.wind_speed_mps = 3.0;
  sea.hs_m = 2.5;
  sea.tp_s = 8.0;
  sea.gamma = 3.3;
  ASSERT_EQ(wave_systems(sea).size(), 1u);
  EXPECT_NEAR(height_of(wave_systems(sea)[0]), 2.5, 1e-9);
  EXPECT_NEAR(wave_systems(sea)[0].peak_hz, 1.0 / 8.0, 1e-12);

  sea.tp_s.reset();
  sea.gamma.reset();  // the developed sea of this height: Hs = 0.2413 U^2 / g, Tp = U / (0.13 g)
  const double wind = std::sqrt(2.5 * kG / 0.24131);
  EXPECT_NEAR(1.0 / wave_systems(sea)[0].peak_hz, wind / (0.13 * kG), 1e-3);
  EXPECT_NEAR(wave_systems(sea)[0].alpha, kPhillips, 1e-9);

  sea.hs_m = 0.0;
  EXPECT_TRUE(wave_systems(sea).empty());
  sea.hs_m.reset();
  sea.wind_speed_mps = 0.0;
  EXPECT_TRUE(wave_systems(sea).empty());
  sea.hs_m = 1.0;  // waves without wind
  EXPECT_NEAR(height_of(wave_systems(sea)[0]), 1.0, 1e-9);
}

// The sea's own waves, with the patches that hold them, and where they go.
TEST(WaveSystems, ASwellIsInTheSea) {
  SeaDescription sea;
  sea.wind_speed_mps = 0.0;
  sea.patch_lengths_m = {2400.0, 363.0, 63.0};
  sea.swells = {{.hs_m = 2.0, .tp_s = 14.0, .from_rad = 0.5 * kPiRef}};  // from the east
  double sum = 0.0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sea.seed = static_cast<std::uint64_t>(seed);
    const Sea one(sea);
    const double height = one.significant_height_m();
    sum += height * height;
    // The mean wave number is that of f^2, 1 / 0.777^2 of the peak's.
    EXPECT_NEAR(one.mean_wavelength_m() / (kG * 14.0 * 14.0 / (2.0 * kPiRef)), 0.604, 0.06);
  }
  EXPECT_NEAR(std::sqrt(sum / kSeeds), 2.0, 0.12);

  const WaveSystem swell = wave_systems(sea).at(0);
  EXPECT_NEAR(swell.travel.x, -1.0, 1e-6);  // to the west
  // The directions' spread.
  double weight = 0.0, square = 0.0;
  for (int i = -500; i <= 500; ++i) {
    const double angle = kPiRef * i / 500.0;
    const double w = directional_weight(swell.spreading, std::cos(angle));
    weight += w;
    square += w * angle * angle;
  }
  EXPECT_NEAR(std::sqrt(square / weight), 15.0 * kPiRef / 180.0, 0.01);
}

TEST(WaveSystems, ASwellBesideAWindSeaAddsItsVariance) {
  SeaDescription sea;
  sea.wind_speed_mps = 8.0;
  sea.patch_lengths_m = {1200.0, 182.0, 32.0};
  const double wind_only = std::pow(Sea(sea).significant_height_m(), 2.0);
  sea.swells = {{.hs_m = 1.5, .tp_s = 11.0}};
  const double both = std::pow(Sea(sea).significant_height_m(), 2.0);
  EXPECT_NEAR(std::sqrt(both - wind_only), 1.5, 0.35);  // one seed of few waves
  sea.swells = {{.hs_m = 0.0, .tp_s = 11.0}};
  EXPECT_EQ(std::pow(Sea(sea).significant_height_m(), 2.0), wind_only);
}

TEST(WaveSystems, TrainsAreDealtOutByHeight) {
  const WaveSystem wind = make_wind_sea(8.0, 0.0, kG);
  WaveSystem swell = make_wind_sea(0.0, 1.0, kG);
  swell.peak_hz = 1.0 / 14.0;
  swell.spreading = 30.0;
  swell = with_height(swell, 0.5 * height_of(wind));
  const std::vector<WaveSystem> both = {wind, swell};
  const auto trains = make_trains(both, 6, 3);
  ASSERT_EQ(trains.size(), 6u);
  int long_ones = 0;
  for (const WaveTrain& train : trains) long_ones += train.period_s > 9.0;
  EXPECT_EQ(long_ones, 2);
  // One system alone is as ever.
  const auto alone = make_trains(std::span(both).first(1), 6, 3), before = make_trains(wind, 6, 3);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(alone[n].period_s, before[n].period_s);
}

TEST(WaveSystems, ValuesOutsideTheirRangeAreRefusedByName) {
  const auto expect_refused = [](auto change, const std::string& name) {
    SeaDescription sea;
    change(sea);
    try {
      const Sea made(sea);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(name)) << error.what();
    }
  };
  expect_refused([](auto& s) { s.hs_m = -1.0; }, "hs_m");
  expect_refused([](auto& s) { s.tp_s = 0.1; }, "tp_s");
  expect_refused([](auto& s) { s.fetch_km = 0.0; }, "fetch_km");
  expect_refused([](auto& s) { s.gamma = 0.5; }, "gamma");
  expect_refused([](auto& s) { s.swells.resize(kMaxSwells + 1); }, "swells");
  expect_refused([](auto& s) { s.swells = {{.tp_s = 0.0}}; }, "swells.tp_s");
}

}  // namespace
}  // namespace swell::ocean
