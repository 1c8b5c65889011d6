// Means over many seeds: slower than the other tests of the sea, and the check of its physics.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ocean/sea.h"

namespace swell::ocean {
namespace {

constexpr double kPiRef = std::numbers::pi;
constexpr double kTwoPi = 2.0 * kPiRef;
constexpr double kG = 9.81;
constexpr int kSeeds = 64;

// Variance of Pierson-Moskowitz waves with wave numbers below k_rad_m, in closed form.
double variance_below_k(double wind_mps, double k_rad_m) {
  const double f_m = 0.13 * kG / wind_mps, f = std::sqrt(kG * k_rad_m) / kTwoPi;
  return 0.0081 * kG * kG / (std::pow(kTwoPi, 4) * 5.0 * std::pow(f_m, 4)) *
         std::exp(-1.25 * std::pow(f_m / f, 4));
}

struct Moments {
  double variance = 0.0;
  glm::dvec2 travel{0.0};  // mean of -dH/dt grad H: the integral of omega k S(k)
};

Moments field_moments(const Sea& sea, Workers& workers) {
  const double dt = 0.01;
  SeaFrame before, now, after;
  advance(sea, 100.0 - dt, before, workers);
  advance(sea, 100.0, now, workers);
  advance(sea, 100.0 + dt, after, workers);
  Moments sum;
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
constexpr double kPatchEnd = kTwoPi / 3000.0 * 63.5;

TEST(SeaStatistics, FieldHasTheVarianceOfItsBand) {
  Workers workers(1);
  double mean = 0.0, mean_square = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double variance = field_moments(Sea(one_patch(60.0, seed)), workers).variance;
    mean += variance / kSeeds;
    mean_square += variance * variance / kSeeds;
  }
  const double want = variance_below_k(15.0, kPatchEnd);
  const double one_seed_error = std::sqrt(mean_square - mean * mean);
  EXPECT_NEAR(mean / want, 1.0, 0.02) << "one seed's standard error " << one_seed_error / want;
  EXPECT_LE(std::abs(mean - want), 3.0 * one_seed_error / std::sqrt(kSeeds));
}

// The integral of omega k cos(theta) S over the band: D's first moment is p / (p + 1).
double expected_travel(double wind_mps) {
  const double f_m = 0.13 * kG / wind_mps, f_end = std::sqrt(kG * kPatchEnd) / kTwoPi;
  double sum = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double f = f_end * (i + 0.5) / steps;
    const double energy = 0.0081 * kG * kG / (std::pow(kTwoPi, 4) * std::pow(f, 5)) *
                          std::exp(-1.25 * std::pow(f_m / f, 4));
    const double p = 9.77 * std::pow(f / f_m, f < f_m ? 4.06 : -2.34);
    const double omega = kTwoPi * f;
    sum += omega * (omega * omega / kG) * p / (p + 1.0) * energy * f_end / steps;
  }
  return sum;
}

TEST(SeaStatistics, FieldTravelsWithTheWindAsStronglyAsTheFormSays) {
  Workers workers(1);
  for (const double from_deg : {60.0, 150.0}) {  // also: a turn of the wind turns the sea
    glm::dvec2 travel(0.0);
    for (int seed = 0; seed < kSeeds; ++seed) {
      travel += field_moments(Sea(one_patch(from_deg, 1000 + seed)), workers).travel / 64.0;
    }
    const double to_deg = std::atan2(travel.x, travel.y) * 180.0 / kPiRef;
    EXPECT_NEAR(std::remainder(to_deg - from_deg - 180.0, 360.0), 0.0, 2.0);
    EXPECT_NEAR(glm::length(travel) / expected_travel(15.0), 1.0, 0.03);
  }
}

TEST(SeaStatistics, PatchesTogetherHaveTheSignificantHeightOfTheWind) {
  double mean_square = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SeaDescription description;
    description.resolution = 64;
    description.seed = static_cast<std::uint64_t>(seed);
    const double height = Sea(description).significant_height_m();
    mean_square += height * height / kSeeds;
  }
  EXPECT_NEAR(std::sqrt(mean_square) / (0.0246 * 15.0 * 15.0), 1.0, 0.05);
}

}  // namespace
}  // namespace swell::ocean
