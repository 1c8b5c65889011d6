// The lee of land against Sommerfeld's exact answer for a long straight breakwater, summed over the
// waves of a sea as the published diagrams are.
#include "ocean/coast/shelter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "constants.h"
#include "ocean/water.h"

namespace swell::ocean {
namespace {

// Heights on a square of `cells` cells about the origin.
terrain::HeightGrid make_land(int cells, double spacing_m,
                              const std::function<bool(glm::dvec2)>& is_land) {
  const double corner = -0.5 * spacing_m * cells;
  terrain::HeightGrid land{{{corner, corner}, spacing_m, cells + 1, cells + 1}};
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      land.height_m.push_back(is_land(land.grid.point(i, j)) ? 3.0f : -20.0f);
  return land;
}

double kept_at(const Shelter& shelter, glm::dvec2 p) {
  float kept = 1.0f;
  apply_shelter(shelter, {&p, 1}, {&kept, 1});
  return kept;
}

// (1 + i) / 2 times the integral of exp(-i pi u^2 / 2) from -infinity to s. Fresnel's integrals by
// Simpson's rule, from where the next terms of their expansion at infinity are below 1e-4.
std::complex<double> fresnel(double s) {
  const auto tail = [](double t) {  // from -infinity to t < 0, |t| large
    const std::complex<double> at = std::exp(std::complex<double>(0.0, -0.5 * kPi * t * t));
    return at * (std::complex<double>(0.0, 1.0) / (kPi * t)) *
           (1.0 + std::complex<double>(0.0, 1.0) / (kPi * t * t));
  };
  const double begin = std::min(s, 0.0) - 6.0;
  const int steps = 2 * static_cast<int>(std::ceil((s - begin) * (20.0 + 10.0 * std::abs(s))));
  const double h = (s - begin) / steps;
  std::complex<double> sum = 0.0;
  for (int n = 0; n <= steps; ++n) {
    const double u = begin + n * h;
    const double weight = n == 0 || n == steps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::exp(std::complex<double>(0.0, -0.5 * kPi * u * u));
  }
  return std::complex<double>(0.5, 0.5) * (tail(begin) + sum * h / 3.0);
}

// Sommerfeld's |u| behind a wall on the ray azimuth 0, at (r, azimuth) from its end, of a wave that
// comes from `from`; all azimuths in [0, 2 pi], counter-clockwise.
// Source: Penney, Price, The Diffraction Theory of Sea Waves, Phil. Trans. A 244, 1952.
double sommerfeld(double kr, double azimuth, double from) {
  const double s = 2.0 * std::sqrt(kr / kPi);
  const std::complex<double> i(0.0, 1.0);
  const auto part = [&](double angle) {
    return fresnel(s * std::cos(0.5 * angle)) * std::exp(i * kr * std::cos(angle));
  };
  return std::abs(part(azimuth - from) + part(azimuth + from));
}

// A wall from the origin to the east, 4 m thick.
terrain::HeightGrid breakwater() {
  return make_land(1024, 4.0, [](glm::dvec2 p) { return p.x > -1.0 && std::abs(p.y - 2.0) < 3.0; });
}

TEST(Shelter, FresnelsIntegralsAreThoseOfTheTables) {
  // C(1) = 0.7799, S(1) = 0.4383.
  const std::complex<double> at = fresnel(1.0) / std::complex<double>(0.5, 0.5);
  EXPECT_NEAR(at.real(), 0.5 + 0.7799, 2e-4);
  EXPECT_NEAR(at.imag(), -0.5 - 0.4383, 2e-4);
  EXPECT_NEAR(std::abs(fresnel(0.0)), 0.5, 1e-4);
}

// One wave, straight at the wall: behind its end about half of the height is left, further into the
// lee less, as Sommerfeld's answer has it.
TEST(Shelter, OneWaveSpreadsAsSommerfeldsDoes) {
  Workers workers(1);
  const LandMask mask = make_land_mask(terrain::ShoreMap(breakwater(), workers));
  const terrain::Grid grid{{-2048.0, -2048.0}, 16.0, 257, 257};
  std::vector<float> energy(grid.size()), fetch_m(grid.size());
  march_wave(mask, {{0.0, 1.0}, 80.0}, grid, energy, fetch_m);
  for (const double degrees : {70.0, 80.0, 90.0, 100.0})
    for (const double r_m : {320.0, 480.0, 640.0}) {
      const double azimuth = degrees * kDegree;
      const glm::dvec2 p = r_m * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
      const glm::dvec2 at = (p - grid.min_world) / grid.spacing_m + 0.5;
      const std::size_t k = grid.index(static_cast<int>(at.x), static_cast<int>(at.y));
      const double found = std::sqrt(static_cast<double>(energy[k]));
      const double exact = sommerfeld(2.0 * kPi / 80.0 * r_m, azimuth, 1.5 * kPi);
      EXPECT_LT(found, 1.25 * exact) << degrees << ' ' << r_m;
      EXPECT_GT(found, exact / 1.6) << degrees << ' ' << r_m;
    }
}

// Land on a part of the square, up to its border, with an islet of one point.
terrain::HeightGrid ragged_land() {
  return make_land(600, 5.0, [](glm::dvec2 p) {
    return (std::sin(0.004 * p.x) * std::cos(0.003 * p.y) > 0.2 && p.x < 900.0) ||
           glm::length(p - glm::dvec2(1200.0, -450.0)) < 4.0;
  });
}

// What squares of the mask say only saves looks at its points.
TEST(Shelter, SquaresOfAMaskTellTheLandThatItsPointsDo) {
  Workers workers(1);
  using Around = LandMask::Around;
  const LandMask mask = make_land_mask(terrain::ShoreMap(ragged_land(), workers));
  for (const Around some : {Around::kWater, Around::kLand, Around::kBoth})
    ASSERT_GT(std::ranges::count(mask.around, some), 20) << static_cast<int>(some);
  LandMask points_alone = mask;
  std::ranges::fill(points_alone.around, Around::kBoth);
  const glm::dvec2 corner = mask.grid.min_world;
  const double size_m = mask.grid.size_m();
  for (const int cells : {mask.grid.samples_x - 1, 128, 40, 15})
    for (const glm::dvec2& travel : {glm::dvec2(0.0, 1.0), glm::dvec2(-0.6, 0.8)}) {
      const terrain::Grid grid{corner, size_m / cells, cells + 1, cells + 1};
      std::vector<float> energy(grid.size()), fetch_m(grid.size());
      std::vector<float> exact_energy(grid.size()), exact_fetch_m(grid.size());
      march_wave(mask, {travel, 60.0}, grid, energy, fetch_m);
      march_wave(points_alone, {travel, 60.0}, grid, exact_energy, exact_fetch_m);
      EXPECT_EQ(energy, exact_energy) << cells;
      EXPECT_EQ(fetch_m, exact_fetch_m) << cells;
    }
}

// The height that is left at (r, azimuth) from the wall's end, by Sommerfeld's answer for each of
// the sea's frequencies and directions.
double height_of_diagram(const WaveSystem& system, double r_m, double azimuth) {
  constexpr int kFrequencies = 8, kDirections = 90;
  double energy = 0.0, all = 0.0;
  for (int f = 0; f < kFrequencies; ++f) {
    const double over_peak = frequency_of_energy(system, (f + 0.5) / kFrequencies);
    const double omega = 2.0 * kPi * over_peak * system.peak_hz;
    for (int d = 0; d < kDirections; ++d) {
      const double turn = ((d + 0.5) / kDirections - 0.5) * 2.0 * kPi;
      const double weight = directional_weight(spreading_of(system, over_peak), std::cos(turn));
      const double height = sommerfeld(omega * omega / 9.81 * r_m, azimuth, 1.5 * kPi + turn);
      energy += weight * height * height;
      all += weight;
    }
  }
  return std::sqrt(energy / all);
}

SeaDescription wind_from_south(double wind_mps) {
  SeaDescription sea;
  sea.wind_speed_mps = wind_mps;
  sea.wind_from_rad = kPi;
  return sea;
}

TEST(Shelter, BehindABreakwaterHeightsAreThoseOfTheDiagrams) {
  Workers workers(2);
  const terrain::ShoreMap shore(breakwater(), workers);
  SeaDescription swell;
  swell.spectrum = false;
  swell.swells = {{.hs_m = 1.0, .tp_s = 7.0, .from_rad = kPi}};
  for (const SeaDescription& sea : {wind_from_south(8.0), swell}) {
    const Shelter shelter = make_shelter(shore, make_beams(sea), workers);
    for (const double degrees : {40.0, 60.0, 80.0, 90.0, 110.0})
      for (const double r_m : {160.0, 400.0}) {
        const double azimuth = degrees * kDegree;
        const double exact = height_of_diagram(wave_systems(sea).front(), r_m, azimuth);
        const glm::dvec2 p = r_m * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
        EXPECT_LT(kept_at(shelter, p), 1.3 * exact) << sea.spectrum << ' ' << degrees << ' ' << r_m;
        EXPECT_GT(kept_at(shelter, p), exact / 1.3) << sea.spectrum << ' ' << degrees << ' ' << r_m;
      }
  }
}

// 1024 m of land with a round bay, whose mouth in the south is 64 m wide.
terrain::HeightGrid bay() {
  return make_land(512, 4.0, [](glm::dvec2 p) {
    const bool in_bay = glm::length(p) < 250.0 || (p.y < 0.0 && std::abs(p.x) < 32.0);
    return std::abs(p.x) < 512.0 && std::abs(p.y) < 512.0 && !in_bay;
  });
}

TEST(Shelter, ABayBehindANarrowMouthIsCalm) {
  Workers workers(2);
  const terrain::ShoreMap shore(bay(), workers);
  const Shelter shelter = make_shelter(shore, make_beams(wind_from_south(6.0)), workers);
  EXPECT_GT(kept_at(shelter, {0.0, -700.0}), 0.95);
  EXPECT_LT(kept_at(shelter, {0.0, 0.0}), 0.45);
  EXPECT_LT(kept_at(shelter, {150.0, 100.0}), 0.2);
  EXPECT_LT(kept_at(shelter, {-150.0, -100.0}), 0.15);
  // And behind the land.
  EXPECT_LT(kept_at(shelter, {0.0, 620.0}), 0.4);
}

TEST(Shelter, WindwardShoresKeepTheirWavesAndFarLeesGetThemBack) {
  Workers workers(2);
  const terrain::ShoreMap shore(
      make_land(512, 8.0, [](glm::dvec2 p) { return glm::length(p) < 250.0; }), workers);
  const Shelter shelter = make_shelter(shore, make_beams(wind_from_south(10.0)), workers);
  const double windward = kept_at(shelter, {0.0, -280.0}), lee = kept_at(shelter, {0.0, 280.0});
  EXPECT_GT(windward, 0.93);
  EXPECT_LT(lee, 0.4);
  double before = lee;
  for (const double y_m : {500.0, 800.0, 1200.0}) {
    const double kept = kept_at(shelter, {0.0, y_m});
    EXPECT_GT(kept, before) << y_m;
    before = kept;
  }
  EXPECT_EQ(kept_at(shelter, {0.0, 1e6}), 1.0);
}

// A wind from land raises waves with the fetch, by JONSWAP's m0 g^2 / U^4 = 1.6e-7 g F / U^2.
TEST(Shelter, WavesGrowWithTheFetch) {
  Workers workers(2);
  const terrain::ShoreMap shore(make_land(256, 160.0, [](glm::dvec2 p) { return p.y < -18000.0; }),
                                workers);
  const double wind_mps = 5.0;
  const Shelter shelter = make_shelter(shore, make_beams(wind_from_south(wind_mps)), workers);
  const auto energy = [&](double fetch_m) {
    const double kept = kept_at(shelter, {0.0, fetch_m - 18000.0});
    return kept * kept;
  };
  const double grown = 1.6e-7 / std::pow(0.2433 / 4.0, 2) * 9.81 * 10000.0 / (wind_mps * wind_mps);
  EXPECT_GT(energy(14000.0) - energy(4000.0), 0.9 * grown);
  EXPECT_LT(energy(14000.0) - energy(4000.0), 1.7 * grown);  // on oblique ways over more water
}

TEST(Shelter, NothingRisesBehindLandAndAnyWorkersGiveTheSame) {
  Workers one(1), three(3);
  const terrain::ShoreMap shore(make_land(256, 10.0,
                                          [](glm::dvec2 p) {
                                            return std::sin(0.011 * p.x) * std::cos(0.009 * p.y) >
                                                       0.6 &&
                                                   glm::length(p) < 1000.0;
                                          }),
                                one);
  ASSERT_TRUE(shore.has_line());
  const std::vector<Beam> beams = make_beams(wind_from_south(12.0));
  const Shelter shelter = make_shelter(shore, beams, one);
  for (const float kept : shelter.kept) {
    EXPECT_LE(kept, 1.0f);
    EXPECT_GE(kept, 0.0f);
  }
  EXPECT_EQ(make_shelter(shore, beams, three).kept, shelter.kept);
}

// Heights are those of the open sea times what is left, to the bit; slopes are theirs.
TEST(Shelter, WaterHasWhatIsLeftOfTheWaves) {
  Workers workers(1);
  const terrain::HeightGrid land = bay();
  const Shelter shelter =
      make_shelter(terrain::ShoreMap(land, workers), make_beams(wind_from_south(6.0)), workers);
  const Sea sea(wind_from_south(6.0));
  SeaFrame frame;
  advance(sea, 12.5, frame, workers);
  WaterParts parts{.sea = &sea};
  const WaterBody open(parts);
  parts.shelter = &shelter;
  const WaterBody sheltered(parts);
  for (const glm::dvec2& p : {glm::dvec2(0.3, -400.0), {120.0, 80.0}, {0.0, 600.0}, {3e4, 0.0}}) {
    float free_m = 0.0f, kept_m = 0.0f, kept = 1.0f;
    open.heights(frame, {&p, 1}, {&free_m, 1});
    sheltered.heights(frame, {&p, 1}, {&kept_m, 1});
    apply_shelter(shelter, {&p, 1}, {&kept, 1});
    EXPECT_EQ(kept_m, free_m * kept);
    frame.sheltered = false;
    sheltered.heights(frame, {&p, 1}, {&kept_m, 1});
    EXPECT_EQ(kept_m, free_m);
    frame.sheltered = true;
    glm::vec2 slope;
    sheltered.slopes(frame, {&p, 1}, {&slope, 1});
    EXPECT_LE(glm::length(glm::dvec2(slope)), sheltered.bounds().steepest);
  }
}

}  // namespace
}  // namespace swell::ocean
