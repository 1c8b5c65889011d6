#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "constants.h"
#include "ocean/open_sea/sea.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

// A patch of random heights in [-1, 1).
PatchFrame random_patch(double length_m, int resolution, unsigned seed) {
  std::mt19937 bits(seed);
  PatchFrame patch;
  patch.length_m = glm::dvec2(length_m);
  patch.resolution = resolution;
  patch.height_m.resize(static_cast<std::size_t>(resolution) * resolution);
  for (float& h : patch.height_m) h = static_cast<float>(bits()) * 0x1p-31f - 1.0f;
  return patch;
}

SeaFrame random_frame() {
  SeaFrame frame;
  frame.patches = {random_patch(97.0, 32, 1), random_patch(640.0 / 3.0, 128, 2)};
  frame.patches[1].length_m.y = 151.0;
  return frame;
}

std::vector<glm::dvec2> random_points(int count, double range_m, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<glm::dvec2> points(count);
  for (glm::dvec2& p : points) {
    p.x = range_m * (static_cast<double>(bits()) * 0x1p-31 - 1.0);
    p.y = range_m * (static_cast<double>(bits()) * 0x1p-31 - 1.0);
  }
  return points;
}

std::vector<float> heights(const SeaFrame& frame, const std::vector<glm::dvec2>& points) {
  std::vector<float> result(points.size());
  sample_heights(frame, points, result);
  return result;
}

// Bilinear interpolation in double.
double patch_height(const PatchFrame& patch, glm::dvec2 p) {
  const int n = patch.resolution;
  const glm::dvec2 u = p * (static_cast<double>(n) / patch.length_m);
  const glm::dvec2 cell = glm::floor(u), f = u - cell;
  const auto sample = [&](double i, double j) {
    const auto wrap = [&](double v) { return static_cast<int>(v - n * std::floor(v / n)); };
    return static_cast<double>(patch.height_m[wrap(j) * n + wrap(i)]);
  };
  const double low = sample(cell.x, cell.y) * (1.0 - f.x) + sample(cell.x + 1.0, cell.y) * f.x;
  const double high =
      sample(cell.x, cell.y + 1.0) * (1.0 - f.x) + sample(cell.x + 1.0, cell.y + 1.0) * f.x;
  return low * (1.0 - f.y) + high * f.y;
}

TEST(SampleHeights, ReturnsThePatchSamplesThemselvesInEveryPeriod) {
  SeaFrame frame;
  frame.patches = {random_patch(97.0, 32, 3)};
  std::vector<glm::dvec2> points;
  std::vector<float> want;
  for (const int period : {0, 1, -1, 1000, -12345}) {
    for (int j = 0; j < 32; ++j) {
      for (int i = 0; i < 32; ++i) {
        points.emplace_back(97.0 * period + 97.0 * i / 32, 97.0 * j / 32 - 97.0 * period);
        want.push_back(frame.patches[0].height_m[static_cast<std::size_t>(j * 32 + i)]);
      }
    }
  }
  for_each_simd_target([&] { EXPECT_EQ(heights(frame, points), want); });
}

TEST(SampleHeights, RepeatsExactlyBetweenSamplesToo) {
  SeaFrame frame;
  frame.patches = {random_patch(97.0, 32, 4)};
  std::vector<glm::dvec2> points, shifted;
  for (int i = 0; i < 1000; ++i) {
    points.emplace_back(97.0 * (i * 37 % 4096) / 4096.0, 97.0 * (i * 101 % 4096) / 4096.0);
    shifted.push_back(points.back() + glm::dvec2(5 * 97.0, -3 * 97.0));
  }
  EXPECT_EQ(heights(frame, points), heights(frame, shifted));
}

TEST(SampleHeights, InterpolatesLinearlyBetweenSamples) {
  const SeaFrame frame = random_frame();
  const auto points = random_points(5000, 2000.0, 5);
  for_each_simd_target([&] {
    const auto got = heights(frame, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double want =
          patch_height(frame.patches[0], points[i]) + patch_height(frame.patches[1], points[i]);
      // Positions are rounded to half of 1/65536 of a cell, steps are up to 2 on both axes.
      ASSERT_NEAR(got[i], want, 1e-4) << i;
    }
  });
}

TEST(SampleHeights, GivesTheSameBitsForAnyBatchAndTarget) {
  SeaDescription description;
  description.resolution = 32;
  description.sines = {{.amplitude_m = 0.4, .wavelength_m = 13.0, .to_rad = 0.7}};
  Workers workers(1);
  SeaFrame frame;
  advance(Sea(description), 3.25, frame, workers);
  const auto points = random_points(37, 5000.0, 6);
  const auto want = heights(frame, points);
  for_each_simd_target([&] {
    for (std::size_t count = 0; count <= points.size(); ++count) {
      const auto got = heights(frame, {points.begin(), points.begin() + count});
      EXPECT_TRUE(std::equal(got.begin(), got.end(), want.begin()));
    }
  });
}

TEST(SampleHeights, AroundAnOriginGivesTheHeightsOfTheWorldPoints) {
  SeaFrame frame = random_frame();
  frame.sines = {{.cycles_per_m = {0.01, 0.02}, .cycles = 0.3, .amplitude_m = 1.0}};
  const auto wide = random_points(1000, 2000.0, 7);
  for (const glm::dvec2& origin : {glm::dvec2(0.0), glm::dvec2(-1e6 + 0.3, 12345.678)}) {
    std::vector<glm::vec2> offsets(wide.begin(), wide.end());
    std::vector<glm::dvec2> world;
    for (const glm::vec2& offset : offsets) world.push_back(origin + glm::dvec2(offset));
    const auto want = heights(frame, world);
    std::vector<std::vector<float>> bits;
    for_each_simd_target([&] {
      std::vector<float> got(offsets.size());
      sample_heights(frame, origin, offsets, got);
      // 0.2 mm of position error on slopes of up to 1 per metre.
      for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], want[i], 1e-3) << i;
      bits.push_back(got);
    });
    EXPECT_EQ(bits.front(), bits.back());
  }
}

TEST(SampleHeights, AroundAnOriginOfZeroReturnsTheSamples) {
  SeaFrame frame;
  frame.patches = {random_patch(64.0, 32, 8)};
  std::vector<glm::vec2> offsets;
  std::vector<float> want;
  for (int j = -40; j < 40; ++j) {
    for (int i = -40; i < 40; ++i) {
      offsets.emplace_back(2.0f * static_cast<float>(i), 2.0f * static_cast<float>(j));
      want.push_back(frame.patches[0].height_m[(j + 64) % 32 * 32 + (i + 64) % 32]);
    }
  }
  std::vector<float> got(offsets.size());
  sample_heights(frame, {0.0, 0.0}, offsets, got);
  EXPECT_EQ(got, want);
}

TEST(SampleHeights, EvaluatesSinesExactly) {
  SeaDescription description;
  description.spectrum = false;
  description.sines = {
      {.amplitude_m = 1.5, .wavelength_m = 50.0, .to_rad = 0.5, .phase_rad = 0.25},
      {.amplitude_m = 0.3, .wavelength_m = 3.0, .to_rad = 4.0, .phase_rad = 2.0, .period_s = 2.0}};
  const Sea sea(description);
  Workers workers(1);
  SeaFrame frame;
  const auto points = random_points(500, 1e5, 9);
  for (const double t : {0.0, 12.5, 86400.0}) {
    advance(sea, t, frame, workers);
    for_each_simd_target([&] {
      const auto got = heights(frame, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        double want = 0.0;
        for (const SineWave& sine : description.sines) {
          const double k = kTurn / sine.wavelength_m;
          const double omega = sine.period_s > 0.0 ? kTurn / sine.period_s : std::sqrt(9.81 * k);
          const double along =
              points[i].x * std::sin(sine.to_rad) + points[i].y * std::cos(sine.to_rad);
          want += sine.amplitude_m * std::sin(k * along - omega * t + sine.phase_rad);
        }
        ASSERT_NEAR(got[i], want, 2e-6) << i;
      }
    });
  }
}

TEST(SampleHeights, FollowsASineCrestAtItsPhaseSpeed) {
  SeaDescription description;
  description.spectrum = false;
  // Crest at x = L/4 for t = 0, travelling east at sqrt(g L / 2 pi).
  description.sines = {
      {.amplitude_m = 1.0, .wavelength_m = 40.0, .to_rad = std::numbers::pi / 2.0}};
  const double speed = std::sqrt(9.81 * 40.0 / kTurn);
  const Sea sea(description);
  Workers workers(1);
  SeaFrame frame;
  for (const double t : {0.0, 1.0, 51.0}) {
    advance(sea, t, frame, workers);
    EXPECT_NEAR(heights(frame, {{10.0 + speed * t, 3.0}})[0], 1.0f, 1e-6f);
  }
}

}  // namespace
}  // namespace swell::ocean
