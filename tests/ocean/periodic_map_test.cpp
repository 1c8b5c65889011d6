// Maps periodic in space and time: their loop, their codes, their files.
#include "ocean/open_sea/periodic_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "math/random.h"
#include "ocean/small_recipe.h"
#include "scratch_folder.h"

namespace swell::ocean {
namespace {

double height(const PeriodicMap& map, int frame, std::size_t sample) {
  const auto of = static_cast<std::size_t>((frame + map.frames) % map.frames);
  return map.height[of * map.frame_samples() + sample] * static_cast<double>(map.height_scale);
}

double variance(const PeriodicMap& map, int frame) {
  double sum = 0.0;
  for (std::size_t i = 0; i < map.frame_samples(); ++i)
    sum += height(map, frame, i) * height(map, frame, i);
  return sum / static_cast<double>(map.frame_samples());
}

double step_between(const PeriodicMap& map, int frame) {
  double sum = 0.0;
  for (std::size_t i = 0; i < map.frame_samples(); ++i) {
    const double change = height(map, frame + 1, i) - height(map, frame, i);
    sum += change * change;
  }
  return std::sqrt(sum / static_cast<double>(map.frame_samples()));
}

// PER-03, with a first disturbance that travels, one at rest, and one of few waves, whose
// correlation with itself a loop later is large.
TEST(PeriodicMap, ItsLoopClosesAndKeepsItsVariance) {
  std::vector<MapRecipe> recipes(3, small_recipe());
  recipes[1].first = FirstDisturbance::kDrops;
  recipes[2].peak_waves = 1.0;
  recipes[2].frames = 33;
  for (const MapRecipe& recipe : recipes) {
    const PeriodicMap map = make_periodic_map(recipe);
    double usual = 0.0, blended_most = 0.0, least = 1e9, most = 0.0;
    const int blended = static_cast<int>(recipe.blend * recipe.frames);
    for (int f = 0; f < map.frames; ++f) {
      least = std::min(least, variance(map, f));
      most = std::max(most, variance(map, f));
      const double step = step_between(map, f);  // the last: back to frame 0
      if (f >= blended && f + 1 < map.frames)
        usual = std::max(usual, step);
      else
        blended_most = std::max(blended_most, step);
    }
    EXPECT_LT(blended_most, 1.5 * usual) << recipe.peak_waves;
    EXPECT_NEAR(map.variance, 1.0, 1e-3);
    // At rest a wave's height comes and goes with its own period, by as much as the blend.
    if (recipe.first != FirstDisturbance::kGusts) continue;
    const double within = recipe.peak_waves > 1.0 ? 0.05 : 0.1;
    EXPECT_GT(least, 1.0 - within);
    EXPECT_LT(most, 1.0 + within);
  }
}

// Without the blend's cosines and without its correction the variance would sink to a half; the
// frames that it makes have the variance of the others to 2 %.
TEST(PeriodicMap, BlendedFramesHaveTheVarianceOfTheOthers) {
  double blended = 0.0, others = 0.0;
  constexpr int kSeeds = 8, kBlended = 16;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    MapRecipe recipe = small_recipe();
    recipe.seed = static_cast<std::uint64_t>(seed);
    const PeriodicMap map = make_periodic_map(recipe);
    for (int f = 0; f < map.frames; ++f)
      (f < kBlended ? blended : others) += variance(map, f) / kSeeds;
  }
  EXPECT_NEAR(blended / kBlended, others / (64 - kBlended), 0.02);
}

TEST(PeriodicMap, TimesALoopApartAreTheSameAndFramesComeBack) {
  const PeriodicMap map = make_periodic_map(small_recipe());
  for (const double loops : {0.0, 0.25, 3.0 / 64.0}) {
    const MapTime a = map_time(map, loops), b = map_time(map, loops + 7.0);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof(a)), 0);
    EXPECT_EQ(a.frame[1], static_cast<int>(loops * 64.0));
    EXPECT_EQ(a.weight[1], 1.0f);
    EXPECT_EQ(a.weight[0] + a.weight[2] + a.weight[3], 0.0f);
  }
  const MapTime between = map_time(map, (63.0 + 0.3) / 64.0);
  EXPECT_EQ(between.frame[2], 0);
  double weights = 0.0, rates = 0.0;
  for (int i = 0; i < 4; ++i) weights += between.weight[i], rates += between.rate[i];
  EXPECT_NEAR(weights, 1.0, 1e-6);
  EXPECT_NEAR(rates, 0.0, 1e-4);
}

// Slopes against the derivative of waves whose transform is worked out here.
TEST(PeriodicMap, SlopesAreThoseOfTheHeights) {
  MapRecipe recipe = small_recipe();
  const PeriodicMap map = make_periodic_map(recipe);
  constexpr int kFrame = 30, kSize = 32;
  const std::size_t first = kFrame * map.frame_samples();
  double error = 0.0, size = 0.0;
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      double derivative = 0.0;
      for (int k = 1; k < kSize / 2; ++k) {  // of the row's Fourier sum
        double c = 0.0, s = 0.0;
        for (int n = 0; n < kSize; ++n) {
          const double phase = 2.0 * std::numbers::pi * k * n / kSize;
          const double h = height(map, kFrame, static_cast<std::size_t>(j * kSize + n));
          c += h * std::cos(phase) * 2.0 / kSize;
          s += h * std::sin(phase) * 2.0 / kSize;
        }
        const double phase = 2.0 * std::numbers::pi * k * i / kSize;
        derivative += 2.0 * std::numbers::pi * k * (s * std::cos(phase) - c * std::sin(phase));
      }
      const double slope = map.slope_x[first + static_cast<std::size_t>(j * kSize + i)] *
                           static_cast<double>(map.slope_scale);
      error += (slope - derivative) * (slope - derivative);
      size += derivative * derivative;
    }
  }
  EXPECT_LT(std::sqrt(error / size), 0.01);
}

TEST(PeriodicMap, EightBitsAreCoarserAndAsRight) {
  MapRecipe recipe = small_recipe();
  const PeriodicMap fine = make_periodic_map(recipe);
  recipe.bits = 8;
  const PeriodicMap coarse = make_periodic_map(recipe);
  for (std::size_t i = 0; i < fine.height.size(); i += 7) {
    EXPECT_NEAR(coarse.height[i] * coarse.height_scale, fine.height[i] * fine.height_scale,
                0.51f * coarse.height_scale);
    EXPECT_NEAR(coarse.slope_y[i] * coarse.slope_scale, fine.slope_y[i] * fine.slope_scale,
                0.51f * coarse.slope_scale);
  }
}

TEST(PeriodicMap, RecipesOutOfRangeAreRefused) {
  const auto refused = [](auto change) {
    MapRecipe recipe = small_recipe();
    change(recipe);
    EXPECT_THROW(make_periodic_map(recipe), std::invalid_argument);
  };
  refused([](MapRecipe& r) { r.size = 48; });
  refused([](MapRecipe& r) { r.size = 1024; });
  refused([](MapRecipe& r) { r.frames = 3; });
  refused([](MapRecipe& r) { r.size = 512, r.frames = 1024; });
  refused([](MapRecipe& r) { r.bits = 12; });
  refused([](MapRecipe& r) { r.courant = 0.9; });
  refused([](MapRecipe& r) { r.blend = 0.9; });
  refused([](MapRecipe& r) { r.spreading = NAN; });
  refused([](MapRecipe& r) { r.peak_waves = 30.0; });
  refused([](MapRecipe& r) { r.first = FirstDisturbance::kHeights; });
  refused([](MapRecipe& r) {
    r.first = FirstDisturbance::kHeights;
    r.heights.assign(32 * 32, 1.0f);  // flat
  });
  refused([](MapRecipe& r) {
    r.first = FirstDisturbance::kHeights;
    r.heights.assign(32 * 32, 1.0f);
    r.heights[5] = INFINITY;
  });
}

// ---- Files

PeriodicMap tiny_map(int bits) {
  MapRecipe recipe = small_recipe();
  recipe.size = 16;
  recipe.frames = 8;
  recipe.bits = bits;
  return make_periodic_map(recipe);
}

TEST(MapFile, ComesBackAsItWas) {
  for (const int bits : {8, 16}) {
    const PeriodicMap map = tiny_map(bits);
    const std::vector<std::uint8_t> bytes = encode_map(map);
    EXPECT_EQ(bytes.size(), 48u + 3u * 8u * 256u * static_cast<std::size_t>(bits / 8));
    const PeriodicMap back = decode_map(bytes, "x");
    EXPECT_EQ(encode_map(back), bytes);
    EXPECT_EQ(back.height, map.height);
    EXPECT_EQ(back.slope_x, map.slope_x);
    EXPECT_EQ(back.slope_y, map.slope_y);
    EXPECT_EQ(back.variance, map.variance);
    EXPECT_EQ(back.travel, map.travel);
  }
}

std::string fault(std::vector<std::uint8_t> bytes) {
  try {
    decode_map(bytes, "sea.map");
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST(MapFile, BrokenFilesAreRefusedWithOneLine) {
  const std::vector<std::uint8_t> good = encode_map(tiny_map(8));
  ASSERT_EQ(fault(good), "none");
  const auto with = [&](std::size_t at, auto value) {
    std::vector<std::uint8_t> bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return fault(bytes);
  };
  EXPECT_EQ(fault({}),
            "sea.map: map file, got another kind of file, allowed one of swell-bench "
            "waves --make-map");
  EXPECT_EQ(with(0, 'x'), fault({}));
  EXPECT_EQ(with(8, 2u), "sea.map: map file, got version 2, allowed version 1");
  EXPECT_EQ(with(12, 17u),
            "sea.map: map file, got 17 samples a side, allowed powers of two from 16 to 512");
  EXPECT_EQ(with(12, 0u),
            "sea.map: map file, got 0 samples a side, allowed powers of two from 16 to 512");
  EXPECT_EQ(with(16, 0xffffffffu),
            "sea.map: map file, got 4294967295 frames of 16 x 16, allowed 4 "
            "to 1024 frames, 8388608 samples in all");
  EXPECT_EQ(with(20, 9u), "sea.map: map file, got 9 bits a sample, allowed 8 or 16");
  EXPECT_EQ(with(24, std::nan("")),
            "sea.map: map file, got nan for its travel or a scale, allowed 0.000001 to 1000000");
  EXPECT_EQ(with(32, 1e300),
            "sea.map: map file, got 1e+300 for its travel or a scale, allowed 0.000001 to 1000000");
  EXPECT_EQ(with(16, 9u),
            "sea.map: map file, got 6192 bytes, allowed 6960 for 9 frames of 16 x 16");
  std::vector<std::uint8_t> flat = good;
  std::fill(flat.begin() + 48, flat.end(), std::uint8_t{0});
  EXPECT_EQ(fault(flat), "sea.map: map file, got a flat map, allowed one with waves");
  // Cut anywhere: refused.
  for (std::size_t size = 0; size < good.size(); size += 97)
    EXPECT_NE(fault({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}), "none");
}

// Whatever bytes are in the right places: refused, or a map whose numbers are finite.
TEST(MapFile, RandomBytesDoNoHarm) {
  const std::vector<std::uint8_t> good = encode_map(tiny_map(16));
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    std::vector<std::uint8_t> bytes = good;
    for (std::uint64_t n = 0; n < 12; ++n) {
      const std::uint64_t random = random_bits(trial, n);
      const std::size_t within = n < 6 ? 48 : bytes.size();
      bytes[random % within] = static_cast<std::uint8_t>(random >> 40);
    }
    try {
      const PeriodicMap map = decode_map(bytes, "x");
      EXPECT_TRUE(std::isfinite(map.variance) && std::isfinite(map.slope_variance));
    } catch (const std::invalid_argument&) {
    }
  }
}

TEST(MapFile, FilesThatAreNoneAreRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(read_map(folder.path().string()), std::invalid_argument);
  EXPECT_THROW(read_map(folder.file("missing.map")), std::invalid_argument);
  const std::vector<std::uint8_t> bytes = encode_map(tiny_map(8));
  EXPECT_EQ(encode_map(read_map(folder.write("sea.map", bytes).string())), bytes);
}

}  // namespace
}  // namespace swell::ocean
