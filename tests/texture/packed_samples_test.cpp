// Samples of packed maps against arithmetic in double, on one mip level and between two.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "texture/packed_texels.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

class PackedSamples : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, PackedSamples, every_target(), target_name);

constexpr int kLowest = std::numeric_limits<int>::min();
constexpr int kHighest = std::numeric_limits<int>::max();
constexpr Sample2 kNothing{0.0f, 0.0f};

// What weights that add up to 1 may be off by, of the range of what they weigh, against fractions
// that are whole 1/256 texels of a level:
// Along x, f / 255 stands for f / 256, which is f / 255 too many 256ths: up to 1 at f = 255. Along
// y, f / 256 is exact.
constexpr double kErrorOnALevel = 1.0 / 256.0;
// Between levels, t is rounded to the next 127th.
constexpr double kErrorBetweenLevels = kErrorOnALevel + 0.5 / 127.0;
// Coordinates are truncated to those fractions, less than 1/256 too low. Along x that is between
// 1/256 too low and as much too high in all; along y up to 1/256 too low comes on top.
constexpr double kErrorOfTruncating = 1.0 / 256.0;
// The error of rounding, as a part of the largest value: the sum and both factors of its unit are
// rounded to float, then the result.
constexpr double kRoundings = 4 * 0x1p-24;

struct Places {
  std::vector<int> x_fx8, y_fx8, level;
  void add(int x, int y, int l) { x_fx8.push_back(x), y_fx8.push_back(y), level.push_back(l); }
  std::size_t size() const { return level.size(); }
  operator MapPlaces() const { return {x_fx8, y_fx8, level}; }
};

// Anywhere among the integers, and at their ends, on levels below `levels`.
Places random_places(int count, int levels, std::uint64_t seed) {
  Places places;
  for (int i = 0; i < count; ++i)
    places.add(static_cast<int>(random_bits(seed, i)), static_cast<int>(random_bits(seed + 1, i)),
               static_cast<int>(random_bits(seed + 2, i) % static_cast<unsigned>(levels)));
  for (const int x : {kLowest, -1, 0, kHighest})
    for (const int y : {kLowest, -1, 0, kHighest}) places.add(x, y, (x ^ y) & 1 ? 0 : levels - 1);
  return places;
}

// Fractions in [0, 1], both ends among them.
std::vector<float> random_blends(std::size_t count, std::uint64_t seed) {
  std::vector<float> t = random_floats(count, -0.2, 1.2, seed);
  for (float& x : t) x = std::clamp(x, 0.0f, 1.0f);
  return t;
}

std::vector<Sample2> blended(const PackedMap2& map, const Places& places,
                             const std::vector<float>& t) {
  std::vector<Sample2> sums(places.size(), kNothing);
  add_blended(map, places, t, 1.0f, sums);
  return sums;
}

// Both channels' values and their taps' range, in bytes.
struct Blend {
  std::array<double, 2> value{}, lowest{}, highest{};
};

// Bilinear in double; x and y [texels of the level].
Blend bilinear(const PackedMap2& map, int level, double x, double y) {
  const double i = std::floor(x), j = std::floor(y), fx = x - i, fy = y - j;
  const int column = static_cast<int>(i), row = static_cast<int>(j);
  Blend out;
  for (int c = 0; c < 2; ++c) {
    const int taps[4] = {texel(map, level, column, row)[c], texel(map, level, column + 1, row)[c],
                         texel(map, level, column, row + 1)[c],
                         texel(map, level, column + 1, row + 1)[c]};
    out.value[c] =
        (taps[0] * (1 - fx) + taps[1] * fx) * (1 - fy) + (taps[2] * (1 - fx) + taps[3] * fx) * fy;
    out.lowest[c] = *std::min_element(taps, taps + 4);
    out.highest[c] = *std::max_element(taps, taps + 4);
  }
  return out;
}

// At whole 1/256 texels of the level, as samplers see coordinates, or just where they are.
Blend level_at_256ths(const PackedMap2& map, int x_fx8, int y_fx8, int level) {
  return bilinear(map, level, (x_fx8 >> level) / 256.0, (y_fx8 >> level) / 256.0);
}
Blend level_in_place(const PackedMap2& map, int x_fx8, int y_fx8, int level) {
  const double texel_fx8 = 256.0 * (1 << level);
  return bilinear(map, level, x_fx8 / texel_fx8, y_fx8 / texel_fx8);
}

// Both levels by t, 0 for what follows the last level with detail; by `level_at`, one of the above.
template <class LevelAt>
Blend trilinear(const PackedMap2& map, int x_fx8, int y_fx8, int base, double t,
                const LevelAt& level_at) {
  Blend out = level_at(map, x_fx8, y_fx8, base), next;
  if (base + 1 < map.detail_levels) next = level_at(map, x_fx8, y_fx8, base + 1);
  for (int c = 0; c < 2; ++c) {
    out.value[c] += t * (next.value[c] - out.value[c]);
    out.lowest[c] = std::min(out.lowest[c], next.lowest[c]);
    out.highest[c] = std::max(out.highest[c], next.highest[c]);
  }
  return out;
}

// `got` is the blend but for an error of the weights, and stays between what was blended.
void expect_near(const Blend& want, double weight_error, float scale, Sample2 got) {
  const double rounded = kRoundings * 127.0;
  const std::array<float, 2> values = {got.a, got.b};
  for (int c = 0; c < 2; ++c) {
    const double value = static_cast<double>(values[c]) / scale;
    const double range = want.highest[c] - want.lowest[c];
    ASSERT_NEAR(value, want.value[c], weight_error * range + rounded);
    ASSERT_GE(value, want.lowest[c] - rounded);
    ASSERT_LE(value, want.highest[c] + rounded);
  }
}

constexpr std::array kSizes = {1, 2, 4, 8, 16, 64, 256, 512};

TEST_P(PackedSamples, BlendTexelsLikeDoubleArithmeticOnEveryLevel) {
  for (const int size : kSizes) {
    const PackedMap2 map = random_map(size, 10 + static_cast<std::uint64_t>(size));
    const Places at = random_places(3001, map.levels, 1);
    const auto samples = sample_level(map, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
      SCOPED_TRACE(testing::Message() << size << " level " << at.level[i] << " sample " << i);
      const int x = at.x_fx8[i], y = at.y_fx8[i], level = at.level[i];
      expect_near(level_at_256ths(map, x, y, level), kErrorOnALevel, map.scale, samples[i]);
      expect_near(level_in_place(map, x, y, level), kErrorOnALevel + kErrorOfTruncating, map.scale,
                  samples[i]);
    }
  }
}

TEST_P(PackedSamples, BlendLevelsLikeDoubleArithmetic) {
  for (const int size : kSizes) {
    const PackedMap2 map = random_map(size, 20 + static_cast<std::uint64_t>(size));
    const Places at = random_places(3001, map.detail_levels, 2);
    const std::vector<float> t = random_blends(at.size(), 5);
    const auto samples = blended(map, at, t);
    for (std::size_t i = 0; i < at.size(); ++i) {
      SCOPED_TRACE(testing::Message() << size << " level " << at.level[i] << " + " << t[i]);
      const int x = at.x_fx8[i], y = at.y_fx8[i], base = at.level[i];
      expect_near(trilinear(map, x, y, base, t[i], level_at_256ths), kErrorBetweenLevels, map.scale,
                  samples[i]);
      expect_near(trilinear(map, x, y, base, t[i], level_in_place),
                  kErrorBetweenLevels + kErrorOfTruncating, map.scale, samples[i]);
    }
  }
}

// All texels of a level, in turn, in repetitions of the map to all sides.
Places texel_positions(const PackedMap2& map, int level) {
  const int size = map.size >> level;
  Places at;
  for (int n = 0; n < size * size; ++n) {
    const int turn = n % 7 - 3;
    at.add((n % size + turn * size) * (256 << level), (n / size - turn * size) * (256 << level),
           level);
  }
  return at;
}

// Samples at the texels' positions: sums with this weight, times `unit`.
void expect_texels(const PackedMap2& map, int level, int weight, float unit,
                   const std::vector<Sample2>& samples) {
  const int size = map.size >> level;
  for (int n = 0; n < size * size; ++n) {
    const auto bytes = texel(map, level, n % size, n / size);
    ASSERT_EQ(samples[n].a, static_cast<float>(weight * bytes[0]) * unit) << level;
    ASSERT_EQ(samples[n].b, static_cast<float>(weight * bytes[1]) * unit) << level;
    ASSERT_NEAR(samples[n].a, static_cast<float>(bytes[0]) * map.scale, 1e-6);
  }
}

// On their level, where a blend begins, and on the next one where it ends.
TEST_P(PackedSamples, AtTexelPositionsAreTheirTexels) {
  const PackedMap2 map = random_map(64, 9);
  constexpr int kWeight = 255 * 256, kBlendWeight = kWeight * 127;
  const float unit = map.scale * (1.0f / kWeight), blend_unit = map.scale * (1.0f / kBlendWeight);
  for (int level = 0; level < map.levels; ++level) {
    const Places at = texel_positions(map, level);
    expect_texels(map, level, kWeight, unit, sample_level(map, at));
    if (level >= map.detail_levels) continue;
    expect_texels(map, level, kBlendWeight, blend_unit,
                  blended(map, at, std::vector<float>(at.size(), 0.0f)));
    if (level == 0) continue;
    Places from_finer = at;
    for (int& l : from_finer.level) l -= 1;
    expect_texels(map, level, kBlendWeight, blend_unit,
                  blended(map, from_finer, std::vector<float>(at.size(), 1.0f)));
  }
}

// At both ends of a blend one level is left; nothing at all after the last one with detail.
TEST_P(PackedSamples, BetweenLevelsBeginAndEndOnThem) {
  for (const int size : {8, 32, 256}) {
    const PackedMap2 map = random_map(size, 30);
    const Places at = random_places(999, map.detail_levels, 31);
    const auto first = blended(map, at, std::vector<float>(at.size(), 0.0f));
    const auto last = blended(map, at, std::vector<float>(at.size(), 1.0f));
    Places coarser = at;
    for (int& level : coarser.level) level += 1;
    const auto fine = sample_level(map, at), coarse = sample_level(map, coarser);
    const double rounded = 2.0 * kRoundings * 127.0 * map.scale;
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_NEAR(first[i].a, fine[i].a, rounded);
      ASSERT_NEAR(first[i].b, fine[i].b, rounded);
      if (coarser.level[i] == map.detail_levels) {
        ASSERT_EQ(last[i], kNothing);
      } else {
        ASSERT_NEAR(last[i].a, coarse[i].a, rounded);
        ASSERT_NEAR(last[i].b, coarse[i].b, rounded);
      }
    }
  }
}

TEST_P(PackedSamples, OfAConstantMapAreConstantEverywhere) {
  PackedMap2 map;
  pack_map2(32, std::vector<float>(1024, 0.7f), std::vector<float>(1024, -0.35f), 0.0f, map);
  const auto check = [&](const std::vector<Sample2>& samples) {
    for (const Sample2& sample : samples) {
      ASSERT_EQ(sample, samples[0]);
      ASSERT_FLOAT_EQ(sample.a, 0.7f);
      ASSERT_NEAR(sample.b, -0.35f, 0.5f * map.scale * 1.0001f);
    }
  };
  check(sample_level(map, random_places(2000, map.levels, 11)));
  const Places blends = random_places(2000, map.detail_levels - 1, 13);
  const std::vector<float> t = random_blends(blends.size(), 15);
  check(blended(map, blends, t));
  // The last level with detail fades out as t grows, in 127ths.
  Places fading = blends;
  std::ranges::fill(fading.level, map.detail_levels - 1);
  const auto faded = blended(map, fading, t);
  for (std::size_t i = 0; i < faded.size(); ++i)
    ASSERT_FLOAT_EQ(faded[i].a, 0.7f * (127.0f - std::nearbyint(127.0f * t[i])) / 127.0f) << t[i];

  pack_map2(32, std::vector<float>(1024, 0.0f), std::vector<float>(1024, 0.0f), 0.0f, map);
  EXPECT_EQ(map.scale, 1.0f);
  for (const Sample2& sample : sample_level(map, blends)) ASSERT_EQ(sample, kNothing);
  for (const Sample2& sample : blended(map, blends, t)) ASSERT_EQ(sample, kNothing);
}

TEST_P(PackedSamples, RiseMonotonicallyBetweenTexels) {
  // A ramp down each axis between texels 0 and 1: all 65,536 fractions.
  PackedMap2 map;
  pack_map2(2, std::vector<float>{-127, 127, -127, 127}, std::vector<float>{-127, -127, 127, 127},
            1.0f, map);
  const std::vector<float> no_blend(256, 0.0f);
  for (int fy = 0; fy < 256; ++fy) {
    Places along, across;
    for (int f = 0; f < 256; ++f) along.add(f, fy, 0), across.add(fy, f, 0);
    for (const auto& [row, column] :
         {std::pair{sample_level(map, along), sample_level(map, across)},
          std::pair{blended(map, along, no_blend), blended(map, across, no_blend)}}) {
      for (int f = 0; f < 256; ++f) {
        ASSERT_GE(row[f].a, row[std::max(f - 1, 0)].a);
        ASSERT_GE(column[f].b, column[std::max(f - 1, 0)].b);
        ASSERT_NEAR(row[f].a, -127 + 254 * f / 255.0, 127 * kRoundings);
        ASSERT_NEAR(row[f].b, -127 + 254 * fy / 256.0, 127 * kRoundings);
      }
    }
  }
}

TEST_P(PackedSamples, GoMonotonicallyFromLevelToLevel) {
  const PackedMap2 map = random_map(64, 16);
  constexpr int kSteps = 1000;
  std::vector<float> t;
  for (int step = 0; step <= kSteps; ++step) t.push_back(static_cast<float>(step) / kSteps);
  const Places ends = random_places(100, map.detail_levels, 17);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    Places at;
    for (int step = 0; step <= kSteps; ++step) at.add(ends.x_fx8[i], ends.y_fx8[i], ends.level[i]);
    const auto samples = blended(map, at, t);
    const bool a_rises = samples.back().a >= samples[0].a,
               b_rises = samples.back().b >= samples[0].b;
    for (std::size_t n = 1; n < samples.size(); ++n) {
      ASSERT_TRUE(a_rises ? samples[n].a >= samples[n - 1].a : samples[n].a <= samples[n - 1].a);
      ASSERT_TRUE(b_rises ? samples[n].b >= samples[n - 1].b : samples[n].b <= samples[n - 1].b);
    }
  }
}

TEST_P(PackedSamples, AreAddedTimesAGain) {
  const PackedMap2 map = random_map(128, 18);
  const Places at = random_places(999, map.detail_levels, 19);
  const std::vector<float> t = random_blends(at.size(), 20);
  const auto alone = blended(map, at, t);
  const auto a = random_floats(at.size(), -5.0, 5.0, 21),
             b = random_floats(at.size(), -5.0, 5.0, 22);
  for (const float gain : {1.0f, 0.0f, 2.5f, -0.7f}) {
    std::vector<Sample2> sums;
    for (std::size_t i = 0; i < at.size(); ++i) sums.push_back({a[i], b[i]});
    add_blended(map, at, t, gain, sums);
    // Rounded with the gain as without it, and once more as a sum.
    const double rounded =
        2.0 * kRoundings * std::abs(gain) * 127 * map.scale + 0x1p-24 * (5 + std::abs(gain) * 3);
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_NEAR(sums[i].a, a[i] + static_cast<double>(gain) * alone[i].a, rounded) << gain;
      ASSERT_NEAR(sums[i].b, b[i] + static_cast<double>(gain) * alone[i].b, rounded) << gain;
    }
  }
}

// The map repeats, and so do the integers: 2^32 is a whole number of maps.
TEST_P(PackedSamples, AreTheSameInEveryRepetition) {
  const PackedMap2 map = random_map(16, 13);
  const Places near = random_places(1000, map.detail_levels, 14);
  const std::vector<float> t = random_blends(near.size(), 15);
  for (const auto& [right, down] : {std::pair{1u, 0u}, {0u, 1u}, {7u, ~6u}, {1u << 19, ~0u}}) {
    Places far = near;
    for (int& x : far.x_fx8) x = static_cast<int>(static_cast<unsigned>(x) + right * 256u * 16u);
    for (int& y : far.y_fx8) y = static_cast<int>(static_cast<unsigned>(y) + down * 256u * 16u);
    EXPECT_EQ(sample_level(map, near), sample_level(map, far));
    EXPECT_EQ(blended(map, near, t), blended(map, far, t));
  }
}

TEST_P(PackedSamples, DependOnTheirOwnLanesAlone) {
  const PackedMap2 map = random_map(128, 4);
  const Places places = random_places(64, map.detail_levels, 5);
  const std::vector<float> t = random_blends(places.size(), 8);
  const auto together = blended(map, places, t), of_levels = sample_level(map, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Places alone;
    alone.add(places.x_fx8[i], places.y_fx8[i], places.level[i]);
    EXPECT_EQ(blended(map, alone, {t[i]})[0], together[i]);
    EXPECT_EQ(sample_level(map, alone)[0], of_levels[i]);
  }
}

TEST(PackedSamplesTargets, GiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  for (const int size : kSizes) {
    const PackedMap2 map = random_map(size, 40);
    const Places on_level = random_places(4099, map.levels, 41);
    const Places between = random_places(4099, map.detail_levels, 44);
    const std::vector<float> t = random_blends(between.size(), 47);
    select_simd_target(simd_targets().front());
    const auto narrow = sample_level(map, on_level), narrow_blends = blended(map, between, t);
    select_simd_target(SimdTarget::kAvx512);
    EXPECT_EQ(sample_level(map, on_level), narrow);
    EXPECT_EQ(blended(map, between, t), narrow_blends);
  }
}

}  // namespace
}  // namespace swell::texture
