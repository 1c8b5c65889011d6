// What samplers read from maps, at 10^8 places: the same bits on every SIMD target, and so on every
// family of processors (docs/understand/sameness.md).
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "math/bits_hash.h"
#include "math/parallel.h"
#include "texture/packed_texels.h"
#include "texture/rgba_texels.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

constexpr int kPlaceBlocks = 25'600;
constexpr std::size_t kPlaceBlock = 1 << 12;
constexpr int kBitsSize = 64;

class TargetBitsOfSamples : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, TargetBitsOfSamples, every_target(), target_name);

// BlockPlaces in 1/256 texels anywhere among the integers, and on levels of a map; as floats within
// two maps' widths of the origin; and blends in [0, 1].
struct BlockPlaces {
  std::vector<int> x_fx8, y_fx8, level;
  std::vector<float> x, y, t;
  operator MapPlaces() const { return {x_fx8, y_fx8, level}; }
};

BlockPlaces block_places(int block, int levels) {
  BlockPlaces places;
  for (std::size_t i = 0; i < kPlaceBlock; ++i) {
    const std::uint64_t a = random_bits(static_cast<std::uint64_t>(block), i);
    const std::uint64_t b = random_bits(static_cast<std::uint64_t>(block) + kPlaceBlocks, i);
    places.x_fx8.push_back(static_cast<int>(a));
    places.y_fx8.push_back(static_cast<int>(a >> 32));
    places.level.push_back(static_cast<int>(b % static_cast<unsigned>(levels)));
    places.x.push_back(static_cast<float>(static_cast<int>(a >> 8 & 0xffffff) - (1 << 23)) *
                       0x1p-8f);
    places.y.push_back(static_cast<float>(static_cast<int>(a >> 40) - (1 << 23)) * 0x1p-8f);
    places.t.push_back(static_cast<float>(b >> 40) / static_cast<float>((1 << 24) - 1));
  }
  return places;
}

void add_bits(float value, BitsHash& hash) { hash.add(value); }
void add_bits(const Sample2& s, BitsHash& hash) { hash.add(s.a), hash.add(s.b); }
void add_bits(const Sample3& s, BitsHash& hash) { hash.add(s.r), hash.add(s.g), hash.add(s.b); }
void add_bits(const Sample4& s, BitsHash& hash) {
  hash.add(s.r), hash.add(s.g), hash.add(s.b), hash.add(s.a);
}

template <class Sample>
std::uint64_t hash_of_samples(int levels, const Sample& sample) {
  BitsHash hash;
  for (int block = 0; block < kPlaceBlocks; ++block)
    for (const auto& value : sample(block_places(block, levels))) add_bits(value, hash);
  return hash.value();
}

TEST_P(TargetBitsOfSamples, OfPackedMaps) {
  const PackedMap2 map = random_map(kBitsSize, 1);
  EXPECT_EQ(
      hash_of_samples(map.levels, [&](const BlockPlaces& at) { return sample_level(map, at); }),
      0x2d31bc30cedc0a6bu);
  EXPECT_EQ(hash_of_samples(map.detail_levels,
                            [&](const BlockPlaces& at) {
                              std::vector<Sample2> sums(kPlaceBlock, {0.25f, -3.0f});
                              add_blended(map, at, at.t, 1.7f, sums);
                              return sums;
                            }),
            0x82227cfe6c9d1cbdu);
  PackedMap1 heights;
  pack_map1(kBitsSize, random_floats(kBitsSize * kBitsSize, -3.0, 3.0, 2), heights);
  EXPECT_EQ(hash_of_samples(heights.levels,
                            [&](const BlockPlaces& at) { return sample_level(heights, at); }),
            0x7096e6cdf0d7e9b6u);
  std::vector<glm::vec4> values;
  for (const float value : random_floats(kBitsSize * kBitsSize, 0.0, 1.0, 4))
    values.emplace_back(value, 1.0f - value, value * value, 0.5f * value);
  Workers workers(2);
  const CoverMap cover = pack_cover(kBitsSize, values, workers);
  EXPECT_EQ(
      hash_of_samples(cover.levels, [&](const BlockPlaces& at) { return sample_cover(cover, at); }),
      0x9431def9798e58d7u);
}

TEST_P(TargetBitsOfSamples, OfImages) {
  const RgbaImage image = random_image(kBitsSize, kBitsSize, 3);
  EXPECT_EQ(
      hash_of_samples(1, [&](const BlockPlaces& at) { return sample_rgba(image, at.x, at.y); }),
      0x3ef6ee6fb4489564u);
  const RgbMap map = pack_rgb(image);
  EXPECT_EQ(hash_of_samples(1, [&](const BlockPlaces& at) { return sample_rgb(map, at.x, at.y); }),
            0x62087afe6a3b5c5au);
}

}  // namespace
}  // namespace swell::texture
