// Means over many seeds: slower than the other tests of the sea, and the check of its physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "constants.h"
#include "ocean/open_sea/sea.h"

namespace swell::ocean {
namespace {

constexpr int kSeaSeeds = 64;

// Variance of Pierson-Moskowitz waves with wave numbers below k_rad_m, in closed form.
double variance_below_k(double wind_mps, double k_rad_m) {
  const double f_m = 0.13 * kG / wind_mps, f = std::sqrt(kG * k_rad_m) / kTurn;
  return 0.0081 * kG * kG / (std::pow(kTurn, 4) * 5.0 * std::pow(f_m, 4)) *
         std::exp(-1.25 * std::pow(f_m / f, 4));
}

struct FieldMoments {
  double variance = 0.0;
  glm::dvec2 travel{0.0};  // mean of -dH/dt grad H: the integral of omega k S(k)
};

FieldMoments field_moments(const Sea& sea, Workers& workers) {
  const double dt = 0.01;
  SeaFrame before, now, after;
  advance(sea, 100.0 - dt, before, workers);
  advance(sea, 100.0, now, workers);
  advance(sea, 100.0 + dt, after, workers);
  FieldMoments sum;
  const PatchFrame& patch = now.patches[0];
  for (std::size_t i = 0; i < patch.height_m.size(); ++i) {
    const double h = patch.height_m[i];
    const double later = after.patches[0].height_m[i], earlier = before.patches[0].height_m[i];
    sum.variance += h * h;
    sum.travel -= (later - earlier) / (2.0 * dt) * glm::dvec2(patch.slope_x[i], patch.slope_y[i]);
  }
  const double samples = static_cast<double>(patch.height_m.size());
  return {sum.variance / samples, sum.travel / samples};
}

SeaDescription one_patch(double wind_from_deg, int seed) {
  SeaDescription description;
  description.wind_from_rad = wind_from_deg * kPiRef / 180.0;
  description.resolution = 128;
  description.patch_lengths_m = {3000.0};
  description.seed = static_cast<std::uint64_t>(seed);
  return description;
}

// Waves with |k| below this fit into the patch.
constexpr double kPatchEnd = kTurn / 3000.0 * 63.5;

TEST(SeaStatistics, FieldHasTheVarianceOfItsBand) {
  Workers workers(1);
  double mean = 0.0, mean_square = 0.0;
  for (int seed = 0; seed < kSeaSeeds; ++seed) {
    const double variance = field_moments(Sea(one_patch(60.0, seed)), workers).variance;
    mean += variance / kSeaSeeds;
    mean_square += variance * variance / kSeaSeeds;
  }
  const double want = variance_below_k(15.0, kPatchEnd);
  const double one_seed_error = std::sqrt(mean_square - mean * mean);
  EXPECT_NEAR(mean / want, 1.0, 0.02) << "one seed's standard error " << one_seed_error / want;
  EXPECT_LE(std::abs(mean - want), 3.0 * one_seed_error / std::sqrt(kSeaSeeds));
}

// The integral of omega k cos(theta) S over the band: D's first moment is p / (p + 1).
double expected_travel(double wind_mps) {
  const double f_m = 0.13 * kG / wind_mps, f_end = std::sqrt(kG * kPatchEnd) / kTurn;
  double sum = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double f = f_end * (i + 0.5) / steps;
    const double energy = 0.0081 * kG * kG / (std::pow(kTurn, 4) * std::pow(f, 5)) *
                          std::exp(-1.25 * std::pow(f_m / f, 4));
    const double p = 9.77 * std::pow(f / f_m, f < f_m ? 4.06 : -2.34);
    const double omega = kTurn * f;
    sum += omega * (omega * omega / kG) * p / (p + 1.0) * energy * f_end / steps;
  }
  return sum;
}

TEST(SeaStatistics, FieldTravelsWithTheWindAsStronglyAsTheFormSays) {
  Workers workers(1);
  for (const double from_deg : {60.0, 150.0}) {  // also: a turn of the wind turns the sea
    glm::dvec2 travel(0.0);
    for (int seed = 0; seed < kSeaSeeds; ++seed) {
      travel += field_moments(Sea(one_patch(from_deg, 1000 + seed)), workers).travel / 64.0;
    }
    const double to_deg = std::atan2(travel.x, travel.y) * 180.0 / kPiRef;
    EXPECT_NEAR(std::remainder(to_deg - from_deg - 180.0, 360.0), 0.0, 2.0);
    EXPECT_NEAR(glm::length(travel) / expected_travel(15.0), 1.0, 0.03);
  }
}

TEST(SeaStatistics, PatchesTogetherHaveTheSignificantHeightOfTheWind) {
  double mean_square = 0.0;
  for (int seed = 0; seed < kSeaSeeds; ++seed) {
    SeaDescription description;
    description.resolution = 64;
    description.seed = static_cast<std::uint64_t>(seed);
    const double height = Sea(description).significant_height_m();
    mean_square += height * height / kSeaSeeds;
  }
  EXPECT_NEAR(std::sqrt(mean_square) / (0.0246 * 15.0 * 15.0), 1.0, 0.05);
}

// 4 sqrt(m0), with m0 from the samples of all patches.
double sampled_significant_height(double wind_mps) {
  constexpr int kFields = 24;
  Workers workers(1);
  SeaFrame frame;
  double variance = 0.0;
  for (int seed = 0; seed < kFields; ++seed) {
    SeaDescription description;
    description.wind_speed_mps = wind_mps;
    description.resolution = 64;
    description.seed = static_cast<std::uint64_t>(2000 + seed);
    advance(Sea(description), 50.0, frame, workers);
    for (const PatchFrame& patch : frame.patches)
      for (const double h : patch.height_m) variance += h * h / (kFields * 64.0 * 64.0);
  }
  return 4.0 * std::sqrt(variance);
}

TEST(SeaStatistics, SampledHeightsHaveTheSignificantHeightOfThePatchesBand) {
  const double end_k = kTurn / 17.0 * 31.5;  // of the shortest default patch
  for (const double wind_mps : {5.0, 10.0, 15.0}) {
    const double want = 4.0 * std::sqrt(variance_below_k(wind_mps, end_k));
    EXPECT_NEAR(sampled_significant_height(wind_mps) / want, 1.0, 0.05) << wind_mps << " m/s";
  }
}

// --- Waves between zero up-crossings ------------------------------------------------------------

// Heights, crest to trough, of the waves between the zero up-crossings of one point's heights.
void append_wave_heights(const std::vector<float>& z_m, std::vector<double>& heights_m) {
  bool inside = false;  // after the first up-crossing
  float crest = 0.0f, trough = 0.0f;
  for (std::size_t i = 1; i < z_m.size(); ++i) {
    if (z_m[i - 1] < 0.0f && z_m[i] >= 0.0f) {
      if (inside) heights_m.push_back(double{crest} - trough);
      inside = true;
      crest = trough = 0.0f;
    }
    crest = std::max(crest, z_m[i]);
    trough = std::min(trough, z_m[i]);
  }
}

double mean_of_highest_third(std::vector<double> heights_m) {
  std::sort(heights_m.begin(), heights_m.end(), std::greater<>());
  const std::size_t third = heights_m.size() / 3;
  double sum = 0.0;
  for (std::size_t i = 0; i < third; ++i) sum += heights_m[i];
  return sum / static_cast<double>(third);
}

// What 16 points far from each other see of one sea.
struct Record {
  std::vector<double> heights_m;
  double mean_square_m2 = 0.0;
};

Record record_waves(const SeaDescription& description) {
  constexpr int kPoints = 16, kSteps = 3000;
  constexpr double kStep_s = 0.3;  // a fortieth of a period: crests are missed by 0.1 %
  Workers workers(1);
  const Sea sea(description);
  SeaFrame frame;
  std::vector<std::vector<float>> z_m(kPoints);
  Record record;
  const int n = description.resolution;
  for (int step = 0; step < kSteps; ++step) {
    advance(sea, step * kStep_s, frame, workers);
    for (int point = 0; point < kPoints; ++point) {
      const int i = point % 4 * n / 4, j = point / 4 * n / 4;
      const float z = frame.patches[0].height_m[j * n + i];
      z_m[point].push_back(z);
      record.mean_square_m2 += double{z} * z / (kPoints * kSteps);
    }
  }
  for (const auto& z : z_m) append_wave_heights(z, record.heights_m);
  return record;
}

// H1/3 / sigma of all records but one (none left out: -1).
double height_ratio(const std::vector<Record>& records, int left_out) {
  std::vector<double> heights_m;
  double mean_square = 0.0;
  int used = 0;
  for (int r = 0; r < static_cast<int>(records.size()); ++r) {
    if (r == left_out) continue;
    heights_m.insert(heights_m.end(), records[r].heights_m.begin(), records[r].heights_m.end());
    mean_square += records[r].mean_square_m2;
    ++used;
  }
  return mean_of_highest_third(std::move(heights_m)) / std::sqrt(mean_square / used);
}

struct Estimate {
  double value = 0.0, standard_error = 0.0;  // the error by leaving out one seed at a time
};

Estimate significant_height_ratio(double length_m, int resolution, int seeds) {
  std::vector<Record> records;
  for (int seed = 0; seed < seeds; ++seed) {
    SeaDescription description = one_patch(60.0, 3000 + seed);
    description.patch_lengths_m = {length_m};
    description.resolution = resolution;
    records.push_back(record_waves(description));
  }
  Estimate estimate{height_ratio(records, -1), 0.0};
  double squares = 0.0;
  for (int r = 0; r < seeds; ++r) {
    const double off = height_ratio(records, r) - estimate.value;
    squares += off * off;
  }
  estimate.standard_error = std::sqrt(squares * (seeds - 1) / seeds);
  return estimate;
}

// Spectral width nu of Pierson-Moskowitz waves below f_end: nu^2 = m0 m2 / m1^2 - 1.
double squared_width_below(double f_m, double f_end) {
  double m0 = 0.0, m1 = 0.0, m2 = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double f = f_end * (i + 0.5) / 20000;
    const double energy = std::pow(f, -5.0) * std::exp(-1.25 * std::pow(f_m / f, 4));
    m0 += energy;
    m1 += f * energy;
    m2 += f * f * energy;
  }
  return m0 * m2 / (m1 * m1) - 1.0;
}

TEST(SeaStatistics, HighestThirdOfNarrowBandWavesIsThatOfRayleighHeights) {
  // The patch ends at 0.9 f_m, and below that Pierson-Moskowitz falls steeply: a narrow band.
  const double f_m = 0.13 * kG / 15.0, f_end = 0.9 * f_m;
  const double k_end = kTurn * f_end * kTurn * f_end / kG;
  const Estimate ratio = significant_height_ratio(kTurn / k_end * 15.5, 32, 24);
  // A height is the sum of the envelope at a crest and at the trough half a period later. The two
  // are Gaussian with correlation 1 - pi^2 nu^2 / 2, so that their mean's standard deviation is
  // 1 - pi^2 nu^2 / 8 of one's. Heights are lower than twice the envelope for this reason: M. A.
  // Tayfun, Distribution of Crest-to-Trough Wave Heights, 1981.
  const double nu2 = squared_width_below(f_m, f_end);
  EXPECT_LE(nu2, 0.08 * 0.08);
  EXPECT_NEAR(ratio.value, 4.0043 * (1.0 - kPiRef * kPiRef * nu2 / 8.0),
              3.0 * ratio.standard_error);
  EXPECT_NEAR(ratio.value, 4.0043, 0.01 * 4.0043);
  EXPECT_LE(ratio.standard_error, 0.003 * 4.0043);
}

TEST(SeaStatistics, HighestThirdOfTheWholeSpectrumIsAFewPerCentLower) {
  const Estimate ratio = significant_height_ratio(3000.0, 64, 6);
  EXPECT_LT(ratio.value, 0.99 * 4.0043);
  EXPECT_GT(ratio.value, 0.95 * 4.0043);
}

}  // namespace
}  // namespace swell::ocean
