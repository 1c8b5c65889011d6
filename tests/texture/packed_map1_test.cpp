// Maps of one channel against those of two, which are held against arithmetic in double.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "texture/packed_texels.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

class OneChannel : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, OneChannel, every_target(), target_name);

struct BothMaps {
  explicit BothMaps(int size)
      : values(random_floats(static_cast<std::size_t>(size) * size, -1.2, 1.2, 5)) {
    pack_map1(size, values, one);
    pack_map2(size, values, values, 1.0f / 127.0f, two);
  }
  std::vector<float> values;
  PackedMap1 one;
  PackedMap2 two;
};

TEST_P(OneChannel, WordsAreTheQuadsOfThatChannel) {
  for (const int size : {1, 2, 8, 16, 64, 256}) {
    const BothMaps maps(size);
    ASSERT_EQ(maps.one.levels, maps.two.levels);
    for (int level = 0; level < maps.one.levels; ++level) {
      const int side = size >> level;
      for (int i = 0; i < side * side; ++i) {
        const std::uint32_t word = maps.one.words[static_cast<std::size_t>(side) * side + i];
        const PackedQuad quad = word_at(maps.two, level, i % side, i / side).fine;
        ASSERT_EQ(word, static_cast<std::uint32_t>(quad)) << size << " level " << level << " " << i;
      }
    }
  }
}

TEST_P(OneChannel, SamplesAreTheSameAnywhere) {
  const BothMaps maps(64);
  std::vector<int> x, y, level;
  for (int i = 0; i < 3000; ++i) {
    x.push_back(static_cast<int>(random_bits(1, i)));
    y.push_back(static_cast<int>(random_bits(2, i)));
    level.push_back(static_cast<int>(random_bits(3, i) % static_cast<unsigned>(maps.one.levels)));
  }
  const MapPlaces places{x, y, level};
  const std::vector<float> one = sample_level(maps.one, places);
  const std::vector<Sample2> two = sample_level(maps.two, places);
  double most = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_NEAR(one[i], two[i].a, 2e-7) << i;
    most = std::max(most, std::abs(static_cast<double>(one[i])));
  }
  EXPECT_GT(most, 0.8);
}

TEST(OneChannelDeathTest, OtherSizesAreTheCallersMistake) {
  PackedMap1 map;
  EXPECT_DEATH(pack_map1(3, std::vector<float>(9), map), "size=3");
  EXPECT_DEATH(pack_map1(4, std::vector<float>(9), map), "values=9");
}

}  // namespace
}  // namespace swell::texture
