#include "texture/packed_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "allocation_count.h"
#include "math/parallel.h"
#include "texture/packed_texels.h"

namespace swell::texture {
namespace {

using PackedMap = OnEveryTarget;
INSTANTIATE_TEST_SUITE_P(Simd, PackedMap, every_target(), target_name);

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

// What is left of the mean square of the texels between them: by Simpson's rule along both axes,
// which is exact for squares of straight lines.
double mean_square_between(const std::vector<double>& v, int side) {
  constexpr double kWeights[] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  double sum = 0.0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const auto at = [&](int di, int dj) { return v[(j + dj) % side * side + (i + di) % side]; };
      for (int n = 0; n < 9; ++n) {
        const double x = 0.5 * (n % 3), y = 0.5 * (n / 3);
        const double sample = (1.0 - y) * ((1.0 - x) * at(0, 0) + x * at(1, 0)) +
                              y * ((1.0 - x) * at(0, 1) + x * at(1, 1));
        sum += kWeights[n % 3] * kWeights[n / 3] * sample * sample;
      }
    }
  return sum / (side * side);
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
      const double left = mean_square_between(level_a, side) + mean_square_between(level_b, side);
      ASSERT_NEAR(map.lost_variance[level], first - left, 1e-5 * first) << size << " " << level;
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
        PackedQuad want = 0;
        for (int n = 0; n < 8; ++n) {
          const int byte = texel(map, level, i + n % 2, j + n / 2 % 2)[n / 4];
          want |= static_cast<PackedQuad>(static_cast<std::uint8_t>(byte)) << (8 * n);
        }
        ASSERT_EQ(word_at(map, level, i, j).fine, want) << level;
      }
    }
  }
}

// Beside it the quad of the texel of the next level that it lies in; nothing after the last level
// with detail, and nothing after the last of all.
TEST_P(PackedMap, WordsHoldTheCoarserNeighbourhoodsAroundThem) {
  for (const int size : {1, 2, 4, 8, 64, 512}) {
    const PackedMap2 map = random_map(size, 25);
    for (int level = 0; level < map.levels; ++level) {
      const bool blends = level + 1 < map.levels && level + 1 != map.detail_levels;
      const int side = size >> level;
      for (int n = 0; n < side * side; ++n) {
        const int i = n % side, j = n / side;
        const PackedQuad around = blends ? word_at(map, level + 1, i / 2, j / 2).fine : 0;
        ASSERT_EQ(word_at(map, level, i, j).coarse, around) << size << " " << level;
      }
    }
  }
}

// Two by two texels and their mean hold nothing worth a sample; of small maps the first level is
// kept, of large ones the first seven.
TEST_P(PackedMap, AllLevelsButTheTwoCoarsestHoldDetail) {
  const std::vector<std::pair<int, int>> table = {{1, 1},  {2, 1},  {4, 1},   {8, 2},
                                                  {16, 3}, {64, 5}, {256, 7}, {1024, 7}};
  for (const auto& [size, detail_levels] : table)
    EXPECT_EQ(random_map(size, 26).detail_levels, detail_levels) << size;
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

TEST(PackedMapThreads, ShareRowsAndChangeNoBit) {
  Workers workers(3);
  for (const int size : {1, 64, 128, 512}) {
    const auto texels = static_cast<std::size_t>(size) * size;
    const std::vector<float> a = random_floats(texels, -3.0, 3.0, 41);
    const std::vector<float> b = random_floats(texels, -3.0, 3.0, 42);
    PackedMap2 alone, shared;
    pack_map2(size, a, b, 0.0f, alone);
    pack_map2(size, a, b, 0.0f, shared, 0.0f, &workers);
    EXPECT_EQ(shared.words, alone.words) << size;
    EXPECT_EQ(shared.lost_variance, alone.lost_variance) << size;
    PackedMap1 alone1, shared1;
    pack_map1(size, a, alone1);
    pack_map1(size, a, shared1, &workers);
    EXPECT_EQ(shared1.words, alone1.words) << size;
  }
}

TEST(PackedMapTargets, GiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  for (const int size : {1, 2, 4, 8, 16, 64, 256}) {
    select_simd_target(simd_targets().front());
    const PackedMap2 narrow = random_map(size, 40);

    select_simd_target(SimdTarget::kAvx512);
    const PackedMap2 wide = random_map(size, 40);
    EXPECT_EQ(wide.scale, narrow.scale);
    EXPECT_EQ(wide.words, narrow.words);
    EXPECT_EQ(wide.lost_variance, narrow.lost_variance);
  }
}

}  // namespace
}  // namespace swell::texture
