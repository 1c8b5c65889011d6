// Caustics against what is known of them: where a sine's light meets, how much light there is, and
// how weak caustics follow from the waves.
#include "render/sea/caustic_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/open_sea/sea.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

constexpr float kIndex = 1.333f;
constexpr float kDisc_per_m = 0.00174f;  // spread by the sun's disc

class CausticRaysOnTarget : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, CausticRaysOnTarget, texture::every_target(),
                         texture::target_name);

struct Wave {
  int along_x, along_y;  // whole waves in the patch
  double amplitude_m, phase_rad;
};

ocean::PatchFrame patch_of(const std::vector<Wave>& waves, double length_m, int size) {
  ocean::PatchFrame patch;
  patch.length_m = glm::dvec2(length_m);
  patch.resolution = size;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      double height = 0.0, slope_x = 0.0, slope_y = 0.0;
      for (const Wave& w : waves) {
        const double phase = kTurn * (w.along_x * i + w.along_y * j) / size + w.phase_rad;
        height += w.amplitude_m * std::cos(phase);
        slope_x -= w.amplitude_m * kTurn * w.along_x / length_m * std::sin(phase);
        slope_y -= w.amplitude_m * kTurn * w.along_y / length_m * std::sin(phase);
      }
      patch.height_m.push_back(static_cast<float>(height));
      patch.slope_x.push_back(static_cast<float>(slope_x));
      patch.slope_y.push_back(static_cast<float>(slope_y));
    }
  }
  return patch;
}

// A confused sea of waves much longer than the samples' spacing.
ocean::PatchFrame long_waves(double slope) {
  std::vector<Wave> waves;
  for (std::uint64_t n = 0; n < 24; ++n) {
    const auto count = [&](std::uint64_t stream) {
      return static_cast<int>(std::floor(random_uniform(stream, n) * 11.0)) - 5;
    };
    const int x = count(1), y = count(2);
    if (x == 0 && y == 0) continue;
    const double k = kTurn * std::hypot(x, y) / 6.0;
    waves.push_back({x, y, slope / k / std::sqrt(24.0), kTurn * random_uniform(3, n)});
  }
  return patch_of(waves, 6.0, 128);
}

std::vector<double> minus_laplacian(const ocean::PatchFrame& patch) {
  const int n = patch.resolution;
  const double per_m = 0.5 * n / patch.length_m.x;
  std::vector<double> result;
  const auto at = [&](const std::vector<float>& field, int i, int j) {
    return static_cast<double>(field[static_cast<std::size_t>((j & (n - 1)) * n + (i & (n - 1)))]);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      result.push_back(-per_m * (at(patch.slope_x, i + 1, j) - at(patch.slope_x, i - 1, j) +
                                 at(patch.slope_y, i, j + 1) - at(patch.slope_y, i, j - 1)));
  return result;
}

struct Moments {
  double mean_a, mean_b, deviation_a, deviation_b, correlation;
};
template <class A, class B>
Moments moments(const A& a, const B& b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    sum_a += x, sum_b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = aa / n - mean_a * mean_a, var_b = bb / n - mean_b * mean_b;
  return {mean_a, mean_b, std::sqrt(var_a), std::sqrt(var_b),
          (ab / n - mean_a * mean_b) / std::sqrt(var_a * var_b)};
}

// OPT-10. Beside the crest rays of neighbours cross first; they do so 4.003 / (A k^2) below it.
TEST_P(CausticRaysOnTarget, OfASineMeetWhereTheyMust) {
  constexpr int kSize = 128;
  constexpr double kLength_m = 3.0, kWaveNumber = kTurn / kLength_m;
  for (const double steepness : {0.05, 0.1, 0.2, 0.3}) {
    const double amplitude_m = steepness / kWaveNumber;
    const ocean::PatchFrame patch =
        patch_of({{1, 0, amplitude_m, std::numbers::pi}}, kLength_m, kSize);
    CausticRays rays;
    trace_rays(patch, {0.0f, 0.0f, 1.0f}, kIndex, rays);
    constexpr std::size_t kCrest = kSize / 2;
    // 2 texels + rise + depth (per_depth to the right - to the left) = 0.
    const double rise = static_cast<double>(rays.from_height_x[kCrest + 1]) -
                        static_cast<double>(rays.from_height_x[kCrest - 1]);
    const double closing = static_cast<double>(rays.per_depth_x[kCrest - 1]) -
                           static_cast<double>(rays.per_depth_x[kCrest + 1]);
    const double expected_m = 4.0030 / (amplitude_m * kWaveNumber * kWaveNumber) - amplitude_m;
    EXPECT_NEAR((2.0 + rise) / closing / expected_m, 1.0, 0.01) << steepness;
    // Nothing bends sideways.
    EXPECT_NEAR(rays.per_depth_y[kCrest + 10], 0.0f, 1e-6f);
  }
}

// A slope turns a slanting ray as Snell's law says: known angles, by the law in a plane.
TEST_P(CausticRaysOnTarget, BendBySnellsLawUnderASlantingSun) {
  for (const double slope : {-0.3, -0.1, 0.0, 0.2}) {
    ocean::PatchFrame patch = patch_of({}, 3.2, 16);
    std::ranges::fill(patch.slope_x, static_cast<float>(slope));
    CausticRays rays;
    const double from_zenith = 0.6;  // the sun stands over +x
    trace_rays(patch,
               {static_cast<float>(std::sin(from_zenith)), 0.0f,
                static_cast<float>(std::cos(from_zenith))},
               kIndex, rays);
    // The surface's normal leans by atan(slope) to -x.
    const double lean = std::atan(slope), n = static_cast<double>(kIndex);
    const double below = std::asin(std::sin(from_zenith + lean) / n) - lean;
    const double flat = std::asin(std::sin(from_zenith) / n);
    const double texels_per_m = 16 / 3.2;
    EXPECT_NEAR(static_cast<double>(rays.per_depth_x[5]) / texels_per_m,
                std::tan(flat) - std::tan(below), 2e-6)
        << slope;
  }
}

// OPT-11.
TEST_P(CausticRaysOnTarget, LoseAndMakeNoLight) {
  for (const float depth_m : {0.3f, 2.0f, 30.0f, 1000.0f}) {
    CausticRays rays;
    CausticScratch scratch;
    trace_rays(long_waves(0.2), {0.36f, 0.48f, 0.8f}, kIndex, rays);
    const std::span<const float> light = gather_rays(rays, depth_m, kDisc_per_m, scratch);
    const auto parts =
        std::accumulate(scratch.quads.begin(), scratch.quads.end(), std::uint64_t{0});
    EXPECT_EQ(parts, std::uint64_t{128} * 128 * 65536) << depth_m;
    const double sum = std::accumulate(light.begin(), light.end(), 0.0);
    EXPECT_NEAR(sum / (128.0 * 128.0), 1.0, 1e-6) << depth_m;
    EXPECT_GE(*std::ranges::min_element(light), -1e-6f) << depth_m;
  }
}

TEST_P(CausticRaysOnTarget, AreEvenUnderFlatWater) {
  CausticRays rays;
  CausticScratch scratch;
  trace_rays(patch_of({}, 5.0, 32), {0.6f, 0.0f, 0.8f}, kIndex, rays);
  for (const float x : gather_rays(rays, 4.0f, kDisc_per_m, scratch)) ASSERT_EQ(x, 1.0f);
}

// At the places of gather_rays(): the mean of four.
std::vector<double> between_points(const std::vector<double>& field, int n) {
  std::vector<double> result;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int x, int y) {
        return field[static_cast<std::size_t>((y & (n - 1)) * n + (x & (n - 1)))];
      };
      result.push_back(0.25 * (at(i, j) + at(i - 1, j) + at(i, j - 1) + at(i - 1, j - 1)));
    }
  }
  return result;
}

// OPT-12, and the pattern itself: weak caustics are c_d times the negative Laplacian of the sea.
TEST_P(CausticRaysOnTarget, AreTheNegativeLaplacianWhereTheyAreWeak) {
  const ocean::PatchFrame patch = long_waves(0.03);
  const std::vector<double> bends_per_m = between_points(minus_laplacian(patch), patch.resolution);
  const double bend = moments(bends_per_m, bends_per_m).deviation_a;
  for (const double contrast : {0.05, 0.1, 0.15}) {
    const double depth_m = contrast / bend / (1.0 - 1.0 / static_cast<double>(kIndex));
    CausticRays rays;
    CausticScratch scratch;
    trace_rays(patch, {0.0f, 0.0f, 1.0f}, kIndex, rays);
    const Moments m =
        moments(gather_rays(rays, static_cast<float>(depth_m), kDisc_per_m, scratch), bends_per_m);
    EXPECT_NEAR(m.deviation_a / contrast, 1.02, 0.05) << contrast;
    EXPECT_GT(m.correlation, 0.96) << contrast;
  }
}

// As the eye knows it from a pool: none just under the surface, most at the focus, less below.
TEST_P(CausticRaysOnTarget, HaveMostContrastAtTheFocus) {
  const ocean::PatchFrame patch = long_waves(0.1);
  CausticRays rays;
  CausticScratch scratch;
  trace_rays(patch, {0.0f, 0.0f, 1.0f}, kIndex, rays);
  std::vector<double> contrast;
  for (const float depth_m : {0.1f, 0.5f, 2.0f, 10.0f, 50.0f, 250.0f}) {
    const std::span<const float> light = gather_rays(rays, depth_m, kDisc_per_m, scratch);
    contrast.push_back(moments(light, light).deviation_a);
  }
  const auto most = std::ranges::max_element(contrast);
  EXPECT_GT(*most, 0.8);
  EXPECT_LT(contrast.front(), 0.15);
  EXPECT_LT(contrast.back(), 0.5 * *most);
  EXPECT_TRUE(std::is_sorted(contrast.begin(), most + 1));
  EXPECT_TRUE(std::is_sorted(most, contrast.end(), std::greater()));
}

// The long waves are what counts of a patch with more samples than a map has points.
TEST_P(CausticRaysOnTarget, OfAFinerPatchAreThoseOfACoarserOne) {
  const std::vector<Wave> waves = {{3, 1, 0.01, 0.4}, {-2, 4, 0.008, 2.0}};
  CausticRays fine, coarse;
  trace_rays(patch_of(waves, 6.0, 256), {0.0f, 0.0f, 1.0f}, kIndex, fine);
  trace_rays(patch_of(waves, 6.0, 128), {0.0f, 0.0f, 1.0f}, kIndex, coarse);
  ASSERT_EQ(fine.size, 128);
  const Moments m = moments(fine.per_depth_x, coarse.per_depth_x);
  EXPECT_GT(m.correlation, 0.99999);
  EXPECT_NEAR(m.deviation_a / m.deviation_b, 1.0, 0.01);
}

// Waves that do not change along an axis, on a patch twice as long along it: half as many texels to
// the metre there, and the same light.
TEST_P(CausticRaysOnTarget, HaveTexelsAsLongAlongEachAxisAsThePatchHas) {
  for (const bool along_x : {true, false}) {
    const Wave wave = along_x ? Wave{2, 0, 0.05, 0.4} : Wave{0, 2, 0.05, 0.4};
    const ocean::PatchFrame square = patch_of({wave}, 6.0, 64);
    ocean::PatchFrame stretched = square;
    (along_x ? stretched.length_m.y : stretched.length_m.x) = 12.0;
    CausticRays rays, long_rays;
    CausticScratch scratch, long_scratch;
    trace_rays(square, {0.36f, 0.48f, 0.8f}, kIndex, rays);
    trace_rays(stretched, {0.36f, 0.48f, 0.8f}, kIndex, long_rays);
    const float x = along_x ? 1.0f : 2.0f, y = along_x ? 2.0f : 1.0f;
    for (std::size_t i = 0; i < rays.per_depth_x.size(); ++i) {
      ASSERT_EQ(x * long_rays.per_depth_x[i], rays.per_depth_x[i]);
      ASSERT_EQ(y * long_rays.per_depth_y[i], rays.per_depth_y[i]);
      ASSERT_EQ(x * long_rays.from_height_x[i], rays.from_height_x[i]);
      ASSERT_EQ(y * long_rays.from_height_y[i], rays.from_height_y[i]);
    }
    trace_rays(square, {0.0f, 0.0f, 1.0f}, kIndex, rays);
    trace_rays(stretched, {0.0f, 0.0f, 1.0f}, kIndex, long_rays);
    EXPECT_TRUE(std::ranges::equal(gather_rays(rays, 4.0f, 0.02f, scratch),
                                   gather_rays(long_rays, 4.0f, 0.02f, long_scratch)));
  }
}

// ---- Reflected

// A sun straight above over a sine: a wave's trough mirrors as a hollow mirror does, of half its
// radius of curvature 1 / (A k^2), from the trough up.
TEST_P(CausticRaysOnTarget, MirroredByASineMeetOverItsTrough) {
  constexpr int kSize = 128;
  constexpr double kLength_m = 3.0, kWaveNumber = kTurn / kLength_m;
  for (const double steepness : {0.05, 0.1, 0.2, 0.3}) {
    const double amplitude_m = steepness / kWaveNumber;
    const ocean::PatchFrame patch = patch_of({{1, 0, amplitude_m, 0.0}}, kLength_m, kSize);
    CausticRays rays;
    trace_mirrored_rays(patch, {0.0f, 0.0f, 1.0f}, rays);
    constexpr std::size_t kTrough = kSize / 2;
    const double rise = static_cast<double>(rays.from_height_x[kTrough + 1]) -
                        static_cast<double>(rays.from_height_x[kTrough - 1]);
    const double closing = static_cast<double>(rays.per_depth_x[kTrough - 1]) -
                           static_cast<double>(rays.per_depth_x[kTrough + 1]);
    const double expected_m = 0.5 / (amplitude_m * kWaveNumber * kWaveNumber) - amplitude_m;
    EXPECT_NEAR((2.0 + rise) / closing / expected_m, 1.0, 0.01) << steepness;
    EXPECT_NEAR(rays.per_depth_y[kTrough + 10], 0.0f, 1e-6f);
  }
}

// A slope turns a mirrored ray by twice its own angle.
TEST_P(CausticRaysOnTarget, AreMirroredBySlopesUnderASlantingSun) {
  for (const double slope : {-0.2, -0.1, 0.0, 0.15}) {
    ocean::PatchFrame patch = patch_of({}, 3.2, 16);
    std::ranges::fill(patch.slope_x, static_cast<float>(slope));
    CausticRays rays;
    const double from_zenith = 0.6;  // the sun stands over +x
    const glm::vec3 to_sun(std::sin(from_zenith), 0.0f, std::cos(from_zenith));
    trace_mirrored_rays(patch, to_sun, rays);
    const double expected = std::tan(from_zenith) - std::tan(from_zenith + 2.0 * std::atan(slope));
    EXPECT_NEAR(static_cast<double>(rays.per_depth_x[5]) / (16 / 3.2), expected, 1e-5) << slope;
    EXPECT_NEAR(mirrored_slant(to_sun).x, -std::tan(from_zenith), 1e-6);
  }
}

// Weak ones are 2 h times the Laplacian of the sea: bright over troughs.
TEST_P(CausticRaysOnTarget, ReflectedAreTheLaplacianWhereTheyAreWeak) {
  const ocean::PatchFrame patch = long_waves(0.03);
  std::vector<double> bends_per_m = between_points(minus_laplacian(patch), patch.resolution);
  for (double& bend : bends_per_m) bend = -bend;
  const double bend = moments(bends_per_m, bends_per_m).deviation_a;
  for (const double contrast : {0.05, 0.1, 0.15}) {
    CausticRays rays;
    CausticScratch scratch;
    trace_mirrored_rays(patch, {0.0f, 0.0f, 1.0f}, rays);
    const auto height_m = static_cast<float>(contrast / bend / 2.0);
    const std::span<const float> light = gather_rays(rays, height_m, kDisc_per_m, scratch);
    EXPECT_NEAR(std::accumulate(light.begin(), light.end(), 0.0) / (128.0 * 128.0), 1.0, 1e-6);
    const Moments m = moments(light, bends_per_m);
    EXPECT_NEAR(m.deviation_a / contrast, 1.02, 0.05) << contrast;
    EXPECT_GT(m.correlation, 0.96) << contrast;
  }
}

}  // namespace
}  // namespace swell::render
