// Sharp crests: the warp against waves summed up by hand, its statistics against theory.
#include "ocean/open_sea/crests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "allocation_count.h"
#include "constants.h"
#include "ocean/frame_at.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/simd_targets.h"
#include "ocean/velocity.h"

namespace swell::ocean {
namespace {

SeaDescription choppy(double choppiness) {
  SeaDescription description;
  description.resolution = 64;
  description.choppiness = choppiness;
  return description;
}

bool same_samples(const SeaFrame& a, const SeaFrame& b) {
  return std::ranges::equal(a.patches, b.patches, [](const PatchFrame& p, const PatchFrame& q) {
    return p.height_m == q.height_m && p.slope_x == q.slope_x && p.slope_y == q.slope_y;
  });
}

// ---- The warp

// A cos(k . x + phase), whole waves on a patch.
struct Wave {
  glm::dvec2 k_rad_m;
  double amplitude_m, phase;
};

// Linear waves at a place, and what they displace there.
struct Linear {
  double h = 0.0;
  glm::dvec2 slope{0.0}, displacement{0.0};
  glm::dmat2 displacement_slope{0.0};  // columns by x and y

  Linear(const std::vector<Wave>& waves, glm::dvec2 x) {
    for (const Wave& wave : waves) {
      const double angle = glm::dot(wave.k_rad_m, x) + wave.phase, k = glm::length(wave.k_rad_m);
      h += wave.amplitude_m * std::cos(angle);
      slope -= wave.amplitude_m * std::sin(angle) * wave.k_rad_m;
      displacement -= wave.amplitude_m * std::sin(angle) * wave.k_rad_m / k;
      displacement_slope -=
          wave.amplitude_m * std::cos(angle) / k * glm::outerProduct(wave.k_rad_m, wave.k_rad_m);
    }
  }
};

constexpr int kSize = 256;
constexpr double kLength_m = 100.0;

glm::dvec2 place_of(std::size_t sample) {
  const auto i = static_cast<int>(sample);
  return glm::dvec2(i % kSize, i / kSize) * (kLength_m / kSize);
}

PatchFrame warped(const std::vector<Wave>& waves, const Crests& crests) {
  constexpr std::size_t kSamples = static_cast<std::size_t>(kSize) * kSize;
  std::vector<float> h, sx, sy, dx, dy;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Linear at(waves, place_of(i));
    h.push_back(static_cast<float>(at.h));
    sx.push_back(static_cast<float>(at.slope.x));
    sy.push_back(static_cast<float>(at.slope.y));
    dx.push_back(static_cast<float>(at.displacement.x));
    dy.push_back(static_cast<float>(at.displacement.y));
  }
  PatchFrame patch;
  patch.length_m = glm::dvec2(kLength_m);
  patch.resolution = kSize;
  for (auto* field : {&patch.height_m, &patch.slope_x, &patch.slope_y, &patch.displaced_x_m,
                      &patch.displaced_y_m})
    field->resize(kSamples);
  Workers workers(1);
  sharpen_crests(crests, {h.data(), sx.data(), sy.data(), dx.data(), dy.data()}, patch, workers);
  return patch;
}

Wave wave(int count_x, int count_y, double amplitude_m, double phase) {
  return {kTurn / kLength_m * glm::dvec2(count_x, count_y), amplitude_m, phase};
}

// Where the water at x rests, by as many steps as it takes.
glm::dvec2 resting_place(const std::vector<Wave>& waves, double choppiness, glm::dvec2 x) {
  glm::dvec2 rest = x;
  for (int step = 0; step < 60; ++step) rest = x - choppiness * Linear(waves, rest).displacement;
  return rest;
}

TEST(Crests, AreTheLinearWavesWhereTheWaterComesFrom) {
  const std::vector<Wave> waves = {wave(3, 1, 0.5, 0.4), wave(5, -2, 0.3, 1.0),
                                   wave(-2, 7, 0.15, 2.0), wave(9, 4, 0.1, 3.0)};
  const Crests crests{0.8f, 0.1f, 0.03f};
  const double c = 0.8, r = 0.1;
  const PatchFrame patch = warped(waves, crests);
  for (std::size_t i = 0; i < patch.height_m.size(); i += 37) {
    const Linear at(waves, resting_place(waves, c, place_of(i)));
    const double z =
        at.h + 0.5 * r * (at.h * at.h + glm::dot(at.displacement, at.displacement)) - 0.03;
    ASSERT_NEAR(patch.height_m[i], z, 3e-3) << i;
    // The slope of z(x) = f(X(x)), by the chain rule.
    const glm::dvec2 by_rest =
        (1.0 + r * at.h) * at.slope + r * at.displacement_slope * at.displacement;
    const glm::dvec2 slope =
        glm::inverse(glm::transpose(glm::dmat2(1.0) + c * at.displacement_slope)) * by_rest;
    ASSERT_NEAR(patch.slope_x[i], slope.x, 6e-3) << i;
    ASSERT_NEAR(patch.slope_y[i], slope.y, 6e-3) << i;
  }
}

// Stokes 1847: A cos(u) + k A^2 / 2 cos(2 u), to the third order of k A.
TEST(Crests, OfOneWaveAreStokess) {
  const Wave one = wave(6, -2, 0.25, 0.7);
  const double k = glm::length(one.k_rad_m), a = one.amplitude_m, steepness = k * a;
  const PatchFrame patch = warped({one}, {1.0f, static_cast<float>(k), 0.0f});
  for (std::size_t i = 0; i < patch.height_m.size(); i += 37) {
    const double u = glm::dot(one.k_rad_m, place_of(i)) + one.phase;
    ASSERT_NEAR(patch.height_m[i], a * (std::cos(u) + 0.5 * steepness * std::cos(2.0 * u)),
                a * (steepness * steepness + 2e-3));
  }
}

// ---- A sea

// HFC-04, and what is left out of pictures.
TEST(Crests, AreLinearWavesWithoutChoppiness) {
  const SeaFrame linear = frame_at(Sea(choppy(0.0)), 9.0);
  for (const PatchFrame& patch : linear.patches) EXPECT_TRUE(patch.displaced_x_m.empty());
  const Sea sea(choppy(1.0));
  SeaFrame frame = frame_at(sea, 8.0);
  EXPECT_FALSE(same_samples(frame_at(sea, 9.0), linear));
  Workers workers(1);
  advance(sea, 9.0, frame, workers, false);
  EXPECT_TRUE(same_samples(frame, linear));
}

// HFC-05: a fixed number of steps, the same on every machine.
TEST(Crests, AreTheSameBitsOnEveryTargetAndThreadCount) {
  const Sea sea(choppy(1.0));
  const SeaFrame expected = frame_at(sea, 21.0);
  for_each_simd_target([&] {
    for (const int threads : {1, 3})
      EXPECT_TRUE(same_samples(frame_at(Sea(choppy(1.0)), 21.0, threads), expected)) << threads;
  });
}

TEST(Crests, AllocateNothingOnceTheyAreThere) {
  const Sea sea(choppy(1.0));
  Workers workers(1);
  SeaFrame frame;
  VelocityFrame velocity;
  const auto go = [&](double t_s) {
    advance(sea, t_s, frame, workers);
    advance_velocity(sea, frame, velocity, workers);
  };
  go(0.0);
  const std::uint64_t before = allocation_count();
  for (int i = 1; i < 5; ++i) go(i);
  EXPECT_EQ(allocation_count(), before);
}

// CrestMoments of a field over its samples and over seeds.
struct CrestMoments {
  double count = 0.0, sums[4] = {};
  void add(double value) {
    count += 1.0;
    for (double power = value; double& sum : sums) {
      sum += power;
      power *= value;
    }
  }
  double mean() const { return sums[0] / count; }
  double variance() const { return sums[1] / count - mean() * mean(); }
  double skewness() const {
    const double m = mean();
    const double third = sums[2] / count - 3.0 * m * sums[1] / count + 2.0 * m * m * m;
    return third / std::pow(variance(), 1.5);
  }
};

struct Statistics {
  CrestMoments height, curvature;
  double slope_variance = 0.0, stated_slope_variance = 0.0, stated_variance = 0.0;
};

constexpr int kCrestSeeds = 64;
constexpr double kPatch_m = 1000.0, kWind_mps = 15.0;
constexpr int kResolution = 128;

Statistics statistics_of(double choppiness) {
  Workers workers(1);
  Statistics sum;
  SeaFrame frame;
  for (int seed = 0; seed < kCrestSeeds; ++seed) {
    SeaDescription description = choppy(choppiness);
    description.wind_speed_mps = kWind_mps;
    description.patch_lengths_m = {kPatch_m};
    description.resolution = kResolution;
    description.seed = static_cast<std::uint64_t>(seed);
    const Sea sea(description);
    advance(sea, 50.0, frame, workers);
    const PatchFrame& patch = frame.patches[0];
    const auto at = [&](int i, int j) {
      constexpr int kLast = kResolution - 1;
      return static_cast<double>(patch.height_m[(j & kLast) * kResolution + (i & kLast)]);
    };
    for (int j = 0; j < kResolution; ++j) {
      for (int i = 0; i < kResolution; ++i) {
        sum.height.add(at(i, j));
        sum.curvature.add(at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) -
                          4.0 * at(i, j));
      }
    }
    double squares = 0.0;
    for (std::size_t i = 0; i < patch.slope_x.size(); ++i)
      squares += std::pow(patch.slope_x[i], 2.0) + std::pow(patch.slope_y[i], 2.0);
    sum.slope_variance += squares / static_cast<double>(patch.slope_x.size()) / kCrestSeeds;
    sum.stated_slope_variance += static_cast<double>(patch.slope_variance) / kCrestSeeds;
    sum.stated_variance += std::pow(sea.significant_height_m() / 4.0, 2.0) / kCrestSeeds;
  }
  return sum;
}

// Returns the skewness of long-crested waves of the second order: 3 times the integral over pairs
// of waves of the smaller wave number, over sigma^3. That mean is the integral over k of
// P(k' > k)^2; Pierson's and Moskowitz's energy below k is exp(-5/4 (k_m / k)^2) of all. The
// integral goes up to the patch's shortest wave.
double expected_skewness(double variance_m2) {
  const double omega_m = kTurn * 0.13 * kG / kWind_mps, k_m = omega_m * omega_m / kG;
  const double k_end = kTurn / kPatch_m * (0.5 * kResolution - 0.5);
  const auto below = [&](double k) { return std::exp(-1.25 * k_m * k_m / (k * k)); };
  double mean_smaller = 0.0;
  constexpr int kParts = 10000;
  for (int n = 0; n < kParts; ++n) {
    const double above = 1.0 - below(k_end * (n + 0.5) / kParts) / below(k_end);
    mean_smaller += above * above * k_end / kParts;
  }
  return 3.0 * mean_smaller * std::sqrt(variance_m2);
}

// HFC-02 and HFC-03.
TEST(Crests, AreAsMuchHigherAndSharperThanTroughsAsTheirChoppinessSays) {
  for (const double choppiness : {0.0, 0.5, 1.0}) {
    const Statistics sea = statistics_of(choppiness);
    const double skewness = choppiness * expected_skewness(sea.stated_variance);
    EXPECT_NEAR(sea.height.skewness(), skewness, 0.03) << choppiness;
    EXPECT_NEAR(sea.curvature.skewness(), -0.3 * choppiness, 0.02 + 0.15 * choppiness);
    // The mean level and the energies stay.
    EXPECT_NEAR(sea.height.mean() / std::sqrt(sea.height.variance()), 0.0, 0.01) << choppiness;
    EXPECT_NEAR(sea.height.variance() / sea.stated_variance, 1.0, 0.03) << choppiness;
    EXPECT_NEAR(sea.slope_variance / sea.stated_slope_variance, 1.0, 0.15) << choppiness;
  }
}

// Also where waves are so steep that they would fold.
TEST(Crests, StayWithinTheSeasBounds) {
  for (const double scale : {1.0, 4.0}) {
    for (int seed = 0; seed < 10; ++seed) {
      SeaDescription description = choppy(1.0);
      description.amplitude_scale = scale;
      description.seed = static_cast<std::uint64_t>(seed);
      const Sea sea(description);
      const SeaFrame frame = frame_at(sea, 5.0 * seed);
      double height_m = 0.0, slope = 0.0;
      for (const PatchFrame& patch : frame.patches) {
        const auto largest = [](const std::vector<float>& field) {
          double most = 0.0;
          for (const float value : field) most = std::max(most, std::abs(double{value}));
          return most;
        };
        height_m += largest(patch.height_m);
        slope = std::max({slope, largest(patch.slope_x), largest(patch.slope_y)});
      }
      EXPECT_LT(height_m, sea.height_bound_m()) << scale;
      EXPECT_LT(slope, sea.slope_bound()) << scale;
    }
  }
}

TEST(Crests, OfSeveralPatchesAreNotTheLastOnes) {
  const SeaFrame frame = frame_at(Sea(choppy(1.0)), 3.0);
  ASSERT_EQ(frame.patches.size(), 3u);
  EXPECT_FALSE(frame.patches[0].displaced_x_m.empty());
  EXPECT_FALSE(frame.patches[1].displaced_x_m.empty());
  EXPECT_TRUE(frame.patches[2].displaced_x_m.empty());
}

// ---- How it moves

TEST(Crests, RiseAsFastAsTheirHeightsGrow) {
  SeaDescription description = choppy(1.0);
  description.patch_lengths_m = {640.0, 97.0, 17.0};
  const Sea sea(description);
  constexpr double kStep_s = 0.01;
  const SeaFrame before = frame_at(sea, 40.0 - kStep_s), after = frame_at(sea, 40.0 + kStep_s);
  const SeaFrame now = frame_at(sea, 40.0);
  VelocityFrame velocity;
  Workers workers(2);
  advance_velocity(sea, now, velocity, workers);
  for (std::size_t p = 0; p < 2; ++p) {
    double error = 0.0, linear_error = 0.0, size = 0.0;
    SeaFrame linear;
    advance(sea, 40.0, linear, workers, false);
    VelocityFrame linear_velocity;
    advance_velocity(sea, linear, linear_velocity, workers);
    for (std::size_t i = 0; i < now.patches[p].height_m.size(); ++i) {
      const double rate =
          (double{after.patches[p].height_m[i]} - double{before.patches[p].height_m[i]}) /
          (2.0 * kStep_s);
      error += std::pow(double{velocity.z.patches[p].height_m[i]} - rate, 2.0);
      linear_error += std::pow(double{linear_velocity.z.patches[p].height_m[i]} - rate, 2.0);
      size += rate * rate;
    }
    EXPECT_LT(std::sqrt(error / size), 0.03) << "patch " << p;
    EXPECT_GT(std::sqrt(linear_error / size), 0.1) << "patch " << p;
  }
}

// ---- Sine waves

TEST(Crests, OfSinesAreStokessOfSecondOrder) {
  SeaDescription description;
  description.spectrum = false;
  description.choppiness = 1.0;
  description.sines = {
      {.amplitude_m = -0.7, .wavelength_m = 40.0, .to_rad = 1.0, .phase_rad = 0.4}};
  const Sea sea(description);
  const double k = kTurn / 40.0, omega = std::sqrt(kG * k), a = 0.7;
  const glm::dvec2 to(std::sin(1.0), std::cos(1.0));
  Workers workers(1);
  double highest = 0.0;
  for (const double t_s : {0.0, 3.3, -20.0}) {
    const SeaFrame frame = frame_at(sea, t_s);
    VelocityFrame velocity;
    advance_velocity(sea, frame, velocity, workers);
    for (int i = 0; i < 50; ++i) {
      const glm::dvec2 p(3.7 * i, -1.9 * i);
      float z = 0.0f, x = 0.0f, y = 0.0f;
      glm::vec3 v;
      sample_heights(frame, {&p, 1}, {&z, 1});
      sample_slopes(frame, {&p, 1}, {&x, 1}, {&y, 1});
      sample_velocities(velocity, {&p, 1}, {&v, 1});
      // From the crest on.
      const double u = k * glm::dot(to, p) - omega * t_s + 0.4 + 0.5 * std::numbers::pi;
      const double slope = -k * a * (std::sin(u) + k * a * std::sin(2.0 * u));
      EXPECT_NEAR(z, a * (std::cos(u) + 0.5 * k * a * std::cos(2.0 * u)), 2e-6);
      EXPECT_NEAR(x, slope * to.x, 1e-6);
      EXPECT_NEAR(y, slope * to.y, 1e-6);
      EXPECT_NEAR(v.z, -slope * omega / k, 4e-6);
      const double along = omega * a * (std::cos(u) + 0.5 * k * a * std::cos(2.0 * u));
      EXPECT_NEAR(v.x, along * to.x, 4e-6);
      EXPECT_NEAR(v.y, along * to.y, 4e-6);
      highest = std::max(highest, std::abs(double{z}));
    }
  }
  EXPECT_LT(highest, sea.height_bound_m());
  EXPECT_GT(highest, 0.95 * sea.height_bound_m());
}

}  // namespace
}  // namespace swell::ocean
