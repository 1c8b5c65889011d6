#include "texture/packed_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "allocation_count.h"
#include "texture/on_every_target.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

using PackedMap = OnEveryTarget;
INSTANTIATE_TEST_SUITE_P(Simd, PackedMap, every_target(), target_name);

PackedMap2 random_map(int size, std::uint64_t seed) {
  const std::size_t texels = static_cast<std::size_t>(size) * size;
  PackedMap2 map;
  pack_map2(size, random_floats(texels, -3.0, 3.0, seed),
            random_floats(texels, -1.0, 2.0, seed + 1), 0.0f, map);
  return map;
}

int wrap(int i, int size) { return ((i % size) + size) % size; }

// Texel (i, j) of a level, from the low bytes of its own word.
std::array<int, 2> texel(const PackedMap2& map, int level, int i, int j) {
  const int size = map.size >> level;
  const std::uint64_t word =
      map.words[map.level_offset[level] + static_cast<std::size_t>(wrap(j, size)) * size +
                wrap(i, size)];
  return {static_cast<std::int8_t>(word & 0xff), static_cast<std::int8_t>(word >> 32 & 0xff)};
}

// Bilinear in double at a coordinate snapped to 1/256 texel, with the taps used.
struct Reference {
  double value[2];
  int lowest[2], highest[2];
};
Reference reference_sample(const PackedMap2& map, float u, float v, int level) {
  const int size = map.size >> level;
  // The library snaps the fraction of a turn; so does exact arithmetic here.
  const double x = std::nearbyint((u - std::floor(static_cast<double>(u))) * size * 256.0) / 256.0;
  const double y = std::nearbyint((v - std::floor(static_cast<double>(v))) * size * 256.0) / 256.0;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  Reference out{};
  for (int c = 0; c < 2; ++c) {
    const int taps[4] = {texel(map, level, i, j)[c], texel(map, level, i + 1, j)[c],
                         texel(map, level, i, j + 1)[c], texel(map, level, i + 1, j + 1)[c]};
    out.value[c] = ((taps[0] * (1 - fx) + taps[1] * fx) * (1 - fy) +
                    (taps[2] * (1 - fx) + taps[3] * fx) * fy) *
                   map.scale;
    out.lowest[c] = *std::min_element(taps, taps + 4);
    out.highest[c] = *std::max_element(taps, taps + 4);
  }
  return out;
}

void expect_near_reference(const PackedMap2& map, float u, float v, int level, Sample2 got) {
  const Reference want = reference_sample(map, u, v, level);
  const float values[2] = {got.a, got.b};
  for (int c = 0; c < 2; ++c) {
    const double scale = map.scale, ulp = 1e-6 * scale * 127;
    const double range = (want.highest[c] - want.lowest[c]) * scale;
    ASSERT_NEAR(values[c], want.value[c], kWeightError * range + ulp)
        << u << " " << v << " " << level;
    ASSERT_GE(values[c], want.lowest[c] * scale - ulp);
    ASSERT_LE(values[c], want.highest[c] * scale + ulp);
  }
}

TEST_P(PackedMap, BlendsLikeDoubleArithmeticOnEveryLevel) {
  for (const int size : {1, 2, 8, 64, 256}) {
    const PackedMap2 map = random_map(size, 10 + size);
    const auto u = random_floats(3001, -5.0, 5.0, 1), v = random_floats(3001, -1000.0, 1000.0, 2);
    std::vector<int> level(u.size());
    for (std::size_t i = 0; i < level.size(); ++i) {
      level[i] = static_cast<int>(random_bits(3, i) % map.levels);
    }
    const auto samples = sample_packed2(map, u, v, level);
    for (std::size_t i = 0; i < u.size(); ++i) {
      expect_near_reference(map, u[i], v[i], level[i], samples[i]);
    }
  }
}

TEST_P(PackedMap, OneLevelForAllLanesGivesTheSameAsALevelPerLane) {
  const PackedMap2 map = random_map(128, 4);
  const auto u = random_floats(999, -50.0, 50.0, 5), v = random_floats(999, -50.0, 50.0, 6);
  for (int level = -1; level <= map.levels; ++level) {
    const std::vector<int> levels(u.size(), level);
    EXPECT_EQ(sample_packed2_level(map, u, v, level), sample_packed2(map, u, v, levels));
  }
}

TEST_P(PackedMap, LevelsAreClampedToTheMaps) {
  const PackedMap2 map = random_map(32, 7);
  const auto u = random_floats(100, 0.0, 1.0, 8);
  const auto at = [&](int level) {
    return sample_packed2(map, u, u, std::vector<int>(u.size(), level));
  };
  EXPECT_EQ(at(-1), at(0));
  EXPECT_EQ(at(std::numeric_limits<int>::min()), at(0));
  EXPECT_EQ(at(6), at(5));
  EXPECT_EQ(at(std::numeric_limits<int>::max()), at(5));
}

TEST_P(PackedMap, TexelPositionsGiveTheirTexels) {
  const PackedMap2 map = random_map(64, 9);
  const float unit = map.scale / 255.0f;
  for (int level = 0; level < map.levels; ++level) {
    const int size = map.size >> level;
    std::vector<float> u, v;
    for (int n = 0; n < size * size; ++n) {
      const int turn = n % 7 - 3;  // also left of the map and right of it
      u.push_back(static_cast<float>(n % size) / static_cast<float>(size) +
                  static_cast<float>(turn));
      v.push_back(static_cast<float>(n / size) / static_cast<float>(size) -
                  static_cast<float>(turn));
    }
    const auto samples = sample_packed2_level(map, u, v, level);
    for (int n = 0; n < size * size; ++n) {
      const auto bytes = texel(map, level, n % size, n / size);
      ASSERT_EQ(samples[n].a, static_cast<float>(255 * bytes[0]) * unit);
      ASSERT_EQ(samples[n].b, static_cast<float>(255 * bytes[1]) * unit);
      ASSERT_NEAR(samples[n].a, static_cast<float>(bytes[0]) * map.scale, 1e-6);
    }
  }
}

TEST_P(PackedMap, ConstantMapIsConstantEverywhere) {
  PackedMap2 map;
  pack_map2(32, std::vector<float>(1024, 0.7f), std::vector<float>(1024, -0.35f), 0.0f, map);
  const auto u = random_floats(2000, -1e6, 1e6, 11), v = random_floats(2000, -1.0, 1.0, 12);
  std::vector<int> level(u.size());
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = static_cast<int>(i % 6);
  const auto samples = sample_packed2(map, u, v, level);
  for (const Sample2& sample : samples) {
    ASSERT_EQ(sample, samples[0]);
    ASSERT_FLOAT_EQ(sample.a, 0.7f);
    ASSERT_NEAR(sample.b, -0.35f, 0.5f * map.scale * 1.0001f);
  }
  const Sample2 zero{0.0f, 0.0f};
  pack_map2(32, std::vector<float>(1024, 0.0f), std::vector<float>(1024, 0.0f), 0.0f, map);
  EXPECT_EQ(map.scale, 1.0f);
  for (const Sample2& sample : sample_packed2(map, u, v, level)) ASSERT_EQ(sample, zero);
}

TEST_P(PackedMap, RisesMonotonicallyBetweenTexels) {
  // A ramp down each axis between texels 0 and 1: all 65,536 fractions.
  PackedMap2 map;
  pack_map2(2, std::vector<float>{-127, 127, -127, 127}, std::vector<float>{-127, -127, 127, 127},
            1.0f, map);
  for (int fy = 0; fy < 256; ++fy) {
    std::vector<float> along, across(256, static_cast<float>(fy) / 512.0f);
    for (int fx = 0; fx < 256; ++fx) along.push_back(static_cast<float>(fx) / 512.0f);
    const auto row = sample_packed2_level(map, along, across, 0);
    const auto column = sample_packed2_level(map, across, along, 0);
    for (int f = 1; f < 256; ++f) {
      ASSERT_GE(row[f].a, row[f - 1].a);
      ASSERT_GE(column[f].b, column[f - 1].b);
      ASSERT_NEAR(row[f].a, -127 + 254 * f / 256.0, 254 * kWeightError);
      ASSERT_NEAR(row[f].b, -127 + 254 * fy / 256.0, 254 * kWeightError);
    }
  }
}

TEST_P(PackedMap, WrapsFarOutAndAcrossTheSeam) {
  const PackedMap2 map = random_map(16, 13);
  std::vector<float> near_u, far_u, v;
  for (int n = 0; n < 256; ++n) {
    near_u.push_back(static_cast<float>(n) / 16.0f);  // multiples of 2^-4 stay exact at 2^20
    far_u.push_back(static_cast<float>(n) / 16.0f - 1048560.0f);
    v.push_back(static_cast<float>(n % 16) / 16.0f);
  }
  EXPECT_EQ(sample_packed2_level(map, near_u, v, 0), sample_packed2_level(map, far_u, v, 0));
  expect_near_reference(
      map, 1.0f - 0x1p-10f, -0x1p-10f, 0,
      sample_packed2_level(map, std::vector{1.0f - 0x1p-10f}, std::vector{-0x1p-10f}, 0)[0]);
  // A tiny step left of the seam rounds onto it.
  EXPECT_EQ(sample_packed2_level(map, std::vector{-1e-12f}, std::vector{0.0f}, 0),
            sample_packed2_level(map, std::vector{0.0f}, std::vector{0.0f}, 0));
}

TEST_P(PackedMap, StrangeCoordinatesStayInsideTheMap) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  const PackedMap2 map = random_map(64, 14);
  const std::vector<float> u{nan, -nan, inf, -inf, 3e38f, -3e38f, 1e-45f, 0.5f};
  for (int level = 0; level < map.levels; ++level) {
    for (const float v : {0.25f, nan, inf, -3e38f}) {
      for (const Sample2& s :
           sample_packed2_level(map, u, std::vector<float>(u.size(), v), level)) {
        ASSERT_LE(std::abs(s.a), 128 * map.scale);
        ASSERT_LE(std::abs(s.b), 128 * map.scale);
      }
    }
  }
}

// --- Packing ---------------------------------------------------------------------------------

// Tent-filtered level in double.
std::vector<double> filter_reference(const std::vector<double>& from, int size) {
  const int half = size / 2;
  std::vector<double> to(static_cast<std::size_t>(half) * half);
  for (int j = 0; j < half; ++j) {
    for (int i = 0; i < half; ++i) {
      double sum = 0.0;
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          sum +=
              (2 - std::abs(x)) * (2 - std::abs(y)) *
              from[static_cast<std::size_t>(wrap(2 * j + y, size)) * size + wrap(2 * i + x, size)];
        }
      }
      to[static_cast<std::size_t>(j) * half + i] = sum / 16.0;
    }
  }
  return to;
}

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * a[i] + b[i] * b[i];
  return sum / static_cast<double>(a.size());
}

TEST_P(PackedMap, LevelsAreTentFilteredAndRoundedToNearest) {
  for (const int size : {1, 2, 4, 16, 32, 128}) {
    const std::size_t texels = static_cast<std::size_t>(size) * size;
    const auto a = random_floats(texels, -2.0, 2.0, 20), b = random_floats(texels, -1.0, 1.5, 21);
    PackedMap2 map;
    pack_map2(size, a, b, 0.0f, map);
    float largest = 0.0f;
    for (const float x : a) largest = std::max(largest, std::abs(x));
    for (const float x : b) largest = std::max(largest, std::abs(x));
    ASSERT_EQ(map.scale, largest / 127.0f);
    ASSERT_EQ(map.levels, static_cast<int>(std::log2(size)) + 1);
    ASSERT_EQ(map.level_offset.size(), map.levels);

    std::vector<double> level_a(a.begin(), a.end()), level_b(b.begin(), b.end());
    const double first = mean_square(level_a, level_b);
    for (int level = 0; level < map.levels; ++level) {
      const int side = size >> level;
      for (int n = 0; n < side * side; ++n) {
        const auto bytes = texel(map, level, n % side, n / side);
        ASSERT_NEAR(bytes[0], level_a[n] / map.scale, 0.5001);
        ASSERT_NEAR(bytes[1], level_b[n] / map.scale, 0.5001);
      }
      ASSERT_NEAR(map.lost_variance[level], first - mean_square(level_a, level_b), 1e-5 * first);
      level_a = filter_reference(level_a, side);
      level_b = filter_reference(level_b, side);
    }
  }
}

TEST_P(PackedMap, WordsHoldTheirNeighbourhoods) {
  const PackedMap2 map = random_map(64, 22);
  for (int level = 0; level < map.levels; ++level) {
    const int size = map.size >> level;
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        std::uint64_t want = 0;
        for (int n = 0; n < 8; ++n) {
          const int byte = texel(map, level, i + n % 2, j + n / 2 % 2)[n / 4];
          want |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(byte)) << (8 * n);
        }
        ASSERT_EQ(map.words[map.level_offset[level] + j * size + i], want) << level;
      }
    }
  }
}

TEST_P(PackedMap, AllLevelsAgreeOnPositions) {
  // A wave eight texels long at level 0 keeps its phase on the coarser levels.
  const int size = 64;
  std::vector<float> a, b;
  for (int n = 0; n < size * size; ++n) {
    a.push_back(static_cast<float>(std::cos(2 * 3.14159265358979 * (n % size) / 32.0)));
    b.push_back(static_cast<float>(std::sin(2 * 3.14159265358979 * (n / size) / 32.0)));
  }
  PackedMap2 map;
  pack_map2(size, a, b, 0.0f, map);
  for (int level = 0; level < 3; ++level) {
    double cos_phase = 0.0, sin_phase = 0.0;
    const int side = size >> level;
    for (int i = 0; i < side; ++i) {
      const double angle = 2 * 3.14159265358979 * i / (32.0 / (1 << level));
      cos_phase += texel(map, level, i, 0)[0] * std::cos(angle);
      sin_phase += texel(map, level, i, 0)[0] * std::sin(angle);
    }
    EXPECT_NEAR(std::atan2(sin_phase, cos_phase), 0.0, 1e-3) << level;
  }
}

TEST_P(PackedMap, FixedScaleClamps) {
  std::vector<float> a{-1000.0f, 1000.0f, 0.5f, -0.5f}, b{1.5f, 2.5f, -1.5f, 126.9f};
  PackedMap2 map;
  pack_map2(2, a, b, 1.0f, map);
  EXPECT_EQ(map.scale, 1.0f);
  EXPECT_EQ(texel(map, 0, 0, 0), (std::array<int, 2>{-127, 2}));  // ties to even
  EXPECT_EQ(texel(map, 0, 1, 0), (std::array<int, 2>{127, 2}));
  EXPECT_EQ(texel(map, 0, 0, 1), (std::array<int, 2>{0, -2}));
  EXPECT_EQ(texel(map, 0, 1, 1), (std::array<int, 2>{0, 127}));
}

TEST_P(PackedMap, RepackingAllocatesNothing) {
  PackedMap2 map = random_map(64, 23);
  const auto a = random_floats(4096, -1.0, 1.0, 24);
  const std::uint64_t before = allocation_count();
  pack_map2(64, a, a, 0.0f, map);
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST(PackedMapTargets, GiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  for (const int size : {1, 2, 4, 8, 16, 64, 256}) {
    select_simd_target(SimdTarget::kAvx2);
    const PackedMap2 narrow = random_map(size, 40);
    const auto u = random_floats(4099, -9.0, 9.0, 41), v = random_floats(4099, -9.0, 9.0, 42);
    std::vector<int> level(u.size());
    for (std::size_t i = 0; i < level.size(); ++i) level[i] = static_cast<int>(i % 9);
    const auto narrow_samples = sample_packed2(narrow, u, v, level);

    select_simd_target(SimdTarget::kAvx512);
    const PackedMap2 wide = random_map(size, 40);
    EXPECT_EQ(wide.scale, narrow.scale);
    EXPECT_EQ(wide.words, narrow.words);
    EXPECT_EQ(wide.lost_variance, narrow.lost_variance);
    EXPECT_EQ(sample_packed2(wide, u, v, level), narrow_samples);
  }
}

}  // namespace
}  // namespace swell::texture
