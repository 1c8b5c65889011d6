// What shaders make of maps: slopes, the variance they lose, levels of detail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "constants.h"
#include "math/view.h"
#include "render/shaders/shader_kernels.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class MapLayers : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, MapLayers, texture::every_target(), texture::target_name);

// ---- Levels of detail

// The exact error of Log2Coarse is tests/math's; here it comes once for the size and three
// quarters of it for the stretch.
constexpr double kLog2Error = 1.2e-4;

TEST_P(MapLayers, FootprintIsTheDistanceBetweenPixelsRays) {
  const View view = make_view({0.0, 0.0, 10.0}, 0.3, -0.5, 0.9, 0.1f, 640, 360);
  const ViewRays rays = make_rays(view);
  std::vector<float> depth, cosine, across, level;
  for (int i = 0; i < 300; ++i) depth.push_back(0.5f * std::pow(1.04f, static_cast<float>(i)));
  cosine.assign(depth.size(), 1.0f);
  across = level = cosine;
  footprints(rays, depth, cosine, across, level);
  const glm::dvec3 upper(view.ray(100.5f, 200.5f)), lower(view.ray(100.5f, 201.5f));
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double size_m = static_cast<double>(depth[i]) * glm::length(upper - lower);
    ASSERT_NEAR(across[i], std::log2(size_m), 2.0 * kLog2Error) << depth[i];
    ASSERT_EQ(level[i], across[i]);  // met straight on
  }
}

// Along the view a footprint is 1 / cos as long as across: four fifths of that count.
TEST_P(MapLayers, LevelTakesThreeQuartersOfTheStretchAlongTheView) {
  ViewRays rays;
  rays.pixel_angle = 0.002f;
  std::vector<float> depth, cosine, across, level;
  for (int i = 0; i <= 980; ++i) {
    cosine.push_back(0.02f + static_cast<float>(i) / 1000.0f);
    depth.push_back(1.0f + static_cast<float>(i * 7 % 500));
  }
  across = level = cosine;
  footprints(rays, depth, cosine, across, level);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double size_m = 0.002 * depth[i], length_m = size_m / cosine[i];
    const double expected = 0.2 * std::log2(size_m) + 0.8 * std::log2(length_m);
    ASSERT_NEAR(level[i], expected, 1.75 * kLog2Error) << cosine[i];
  }
}

// ---- Slopes

// A wave of `cycles` periods along x in a map of 64 texels and 16 m: its slope along x and along y.
constexpr double kSlopeX = 0.3, kSlopeY = -0.2, kGain = 1.5;
constexpr double kVariance = kGain * kGain * 0.5 * (kSlopeX * kSlopeX + kSlopeY * kSlopeY);
constexpr int kSize = 64;
constexpr float kLength_m = 16.0f;

struct WaveLayer {
  explicit WaveLayer(int cycles, float least_variance = 0.0f) {
    std::vector<float> a, b;
    for (int i = 0; i < kSize * kSize; ++i) {
      const double wave = std::cos(kTurn * (0.125 + cycles * (i % kSize) / 64.0));
      a.push_back(static_cast<float>(kSlopeX * wave));
      b.push_back(static_cast<float>(kSlopeY * wave));
    }
    texture::pack_map2(kSize, a, b, 0.0f, map, least_variance);
    layer = make_layer(map, kLength_m, static_cast<float>(kGain), {0.0, 0.0}, {});
  }
  // The mean square of the slopes at places on and between the map's texels, and the variance said
  // to be lost.
  std::pair<double, double> shown_and_lost(double level) const {
    std::vector<glm::vec3> p, slopes;
    for (const double x : places_of_texels())
      p.emplace_back(static_cast<float>(kLength_m * x / kSize), 0.0f, -1.0f);
    slopes.resize(p.size());
    add_slopes(layer, p, std::vector<float>(p.size(), static_cast<float>(level) - 2.0f), slopes);
    double shown = 0.0, lost = 0.0;
    for (const glm::vec3& s : slopes) {
      shown += s.x * s.x + s.y * s.y;
      lost += s.z;
    }
    return {shown / static_cast<double>(p.size()), lost / static_cast<double>(p.size())};
  }
  // Two Gauss points between texels and the next: means of squares of straight lines are exact.
  static std::vector<double> places_of_texels() {
    std::vector<double> places;
    for (int i = 0; i < kSize; ++i)
      for (const double side : {-0.5, 0.5}) places.push_back(i + 0.5 + side / std::sqrt(3.0));
    return places;
  }
  texture::PackedMap2 map;
  SlopeLayer layer;
};

// The wave at a place [texels of level 0], as straight lines between the texels of a level show it;
// filtering down takes the square of the cosine of half the phase step from level to level.
double drawn_wave(int cycles, int level, double x) {
  const double spacing = std::exp2(level), first = std::floor(x / spacing) * spacing;
  double left = 1.0;
  for (int l = 0; l < level; ++l) {
    const double half_step = 0.5 * kTurn * cycles * std::exp2(l) / kSize;
    left *= std::cos(half_step) * std::cos(half_step);
  }
  const auto at = [&](double place) { return std::cos(kTurn * (0.125 + cycles * place / kSize)); };
  const double t = (x - first) / spacing;
  return left * ((1.0 - t) * at(first) + t * at(first + spacing));
}

// Twice the mean of value(x), so that a whole cosine's square has 1.
template <class Value>
double twice_mean(const Value& value) {
  const std::vector<double> places = WaveLayer::places_of_texels();
  double sum = 0.0;
  for (const double x : places) sum += value(x);
  return 2.0 * sum / static_cast<double>(places.size());
}

double part_shown(int cycles, int level) {
  return twice_mean([&](double x) {
    const double wave = drawn_wave(cycles, level, x);
    return wave * wave;
  });
}

// On whole levels nothing is shown twice and nothing is forgotten, also not what lies between the
// texels.
TEST_P(MapLayers, SlopesAndLostVarianceAddUpToTheWavesOnEveryLevel) {
  for (const int cycles : {1, 3, 5, 8, 14}) {
    const WaveLayer wave(cycles);
    for (int level = 0; (cycles << level) < kSize && level < wave.map.detail_levels; ++level) {
      const auto [shown, lost] = wave.shown_and_lost(level);
      const double part = part_shown(cycles, level);
      EXPECT_NEAR(shown, part * kVariance, 0.006 * kVariance) << cycles << " " << level;
      EXPECT_NEAR(lost, (1.0 - part) * kVariance, 1e-5 * kVariance) << cycles << " " << level;
    }
  }
}

// The two levels' slopes are blended, and so are their lost variances. The square of a blend of a
// and b is less than the blend of their squares, by t (1 - t) (a - b)^2: at most a quarter, for
// waves that the coarser level lacks.
TEST_P(MapLayers, BetweenLevelsTheSumLacksTheSquareOfTheDifference) {
  for (const int cycles : {1, 5, 8}) {
    const WaveLayer wave(cycles);
    for (int level = 0; (cycles << level) < kSize / 2 && level + 1 < wave.map.detail_levels;
         ++level) {
      const double difference = twice_mean([&](double x) {
        const double d = drawn_wave(cycles, level, x) - drawn_wave(cycles, level + 1, x);
        return d * d;
      });
      const double finer = part_shown(cycles, level), coarser = part_shown(cycles, level + 1);
      for (const double t : {0.25, 0.5, 0.75}) {
        const auto [shown, lost] = wave.shown_and_lost(level + t);
        EXPECT_NEAR(lost, (1.0 - finer + t * (finer - coarser)) * kVariance, 1e-5 * kVariance);
        EXPECT_NEAR(shown + lost, (1.0 - t * (1.0 - t) * difference) * kVariance, 0.008 * kVariance)
            << cycles << " " << level;
      }
    }
  }
}

TEST_P(MapLayers, LevelsBeyondTheMapHoldNothingButVariance) {
  const WaveLayer wave(3);
  for (const double level : {5.0, 5.5, 7.0, 8.0, 30.0}) {
    const auto [shown, lost] = wave.shown_and_lost(level);
    EXPECT_EQ(shown, 0.0) << level;
    EXPECT_NEAR(lost, kVariance, 1e-4 * kVariance) << level;
  }
  EXPECT_EQ(wave.shown_and_lost(-9.0), wave.shown_and_lost(0.0));
}

TEST_P(MapLayers, LevelsOfTooLittleVarianceHoldNothingButVariance) {
  constexpr int kCycles = 5;
  const auto left = [](int level) {
    return part_shown(kCycles, level) * kVariance / (kGain * kGain);
  };
  for (const int levels : {0, 1, 2, 3}) {
    const double least = levels == 0 ? 1.1 * left(0) : 0.5 * (left(levels - 1) + left(levels));
    const WaveLayer wave(kCycles, static_cast<float>(least)), all(kCycles);
    ASSERT_EQ(wave.map.detail_levels, levels);
    // Whoever samples a map without detail all the same finds nothing.
    EXPECT_EQ(
        std::ranges::count(wave.map.words, texture::PackedWord{0, 0}) == std::ssize(wave.map.words),
        levels == 0);
    for (int level = 0; level <= 4; ++level) {
      const auto [shown, lost] = wave.shown_and_lost(level);
      if (level < levels) {
        EXPECT_EQ(std::pair(shown, lost), all.shown_and_lost(level)) << level;
      } else {
        EXPECT_EQ(shown, 0.0) << level;
        EXPECT_NEAR(lost, kVariance, 1e-4 * kVariance) << level;
      }
    }
  }
}

// No place is outside of a map that repeats, not even one that is no number; and what is read there
// are slopes of the map.
TEST_P(MapLayers, StrangePlacesStayInsideTheMap) {
  const WaveLayer wave(3);
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  std::vector<glm::vec3> p;
  for (const float x : {nan, -nan, inf, -inf, 3e38f, -3e38f, 1e-45f, 0.5f})
    for (const float y : {0.25f, nan, inf, -3e38f}) p.emplace_back(x, y, -1.0f);
  for (const float level_m : {-30.0f, -2.0f, -0.4f, 1.7f, 30.0f, inf, -inf, nan}) {
    std::vector<glm::vec3> slopes(p.size());
    add_slopes(wave.layer, p, std::vector<float>(p.size(), level_m), slopes);
    const double largest = 127.001 * wave.map.scale * kGain;
    for (const glm::vec3& s : slopes) {
      EXPECT_LE(std::abs(s.x), largest) << level_m;
      EXPECT_LE(std::abs(s.y), largest) << level_m;
    }
  }
}

// A single wave fades from four footprints long to two; what it shows and what it lost are one
// whole all the way.
TEST_P(MapLayers, SlopesAndLostVarianceOfASineAddUpOnItsWayOut) {
  SineLayer sine;
  sine.kx = 0.25f;  // 4 m
  sine.slope_x = 0.24f;
  sine.slope_y = 0.07f;
  sine.wavelength_log2 = 2.0f;
  const double whole = 0.5 * (0.24 * 0.24 + 0.07 * 0.07);
  std::vector<glm::vec3> p, slopes(64);
  for (int i = 0; i < 64; ++i) p.emplace_back(4.0f * static_cast<float>(i) / 64.0f, 0.0f, -1.0f);
  for (int step = -30; step <= 30; ++step) {
    const double level_m = 0.1 * step;
    add_sine(sine, p, std::vector<float>(64, static_cast<float>(level_m)), slopes);
    double shown = 0.0;
    for (const glm::vec3& s : slopes) shown += (s.x * s.x + s.y * s.y) / 64.0;
    const double seen = std::clamp(1.0 - level_m, 0.0, 1.0);
    EXPECT_NEAR(shown, seen * seen * whole, 1e-6 * whole) << level_m;
    EXPECT_NEAR(shown + slopes[0].z, whole, 1e-6 * whole) << level_m;
  }
}

}  // namespace
}  // namespace swell::render
