// The four-channel maps of texture/cover_map.h: their levels, and samples against arithmetic in
// double.
#include "texture/cover_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/parallel.h"
#include "texture/on_every_target.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

class CoverSamples : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, CoverSamples, every_target(), target_name);

std::vector<glm::vec4> random_values(int size) {
  const auto count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const std::vector<float> numbers = random_floats(4 * count, 0.0, 1.0, 5);
  std::vector<glm::vec4> values;
  for (std::size_t k = 0; k < count; ++k)
    values.emplace_back(numbers[4 * k], numbers[4 * k + 1], numbers[4 * k + 2], numbers[4 * k + 3]);
  return values;
}

// Channel of texel (i, j) of a level.
double texel(const CoverMap& map, int level, int i, int j, std::size_t channel) {
  const int side = map.size >> level;
  const auto at =
      static_cast<std::size_t>(side * side + (j & (side - 1)) * side + (i & (side - 1)));
  return (map.words[at].bytes[4 * channel] + 127.0) / 254.0;
}

double mean(const CoverMap& map, int level, std::size_t channel) {
  const int side = map.size >> level;
  double sum = 0.0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) sum += texel(map, level, i, j, channel);
  return sum / (side * side);
}

CoverMap packed(int size, std::vector<glm::vec4> values) {
  Workers workers(2);
  return pack_cover(size, std::move(values), workers);
}

TEST(CoverMap, HasTheSameMeanOnEveryLevel) {
  const CoverMap map = packed(64, random_values(64));
  EXPECT_EQ(map.levels, 7);
  for (std::size_t channel = 0; channel < 4; ++channel)
    for (int level = 1; level < map.levels; ++level)
      EXPECT_NEAR(mean(map, level, channel), mean(map, 0, channel), 0.5 / 254.0);
}

TEST(CoverMap, KeepsNothingAndAllExact) {
  const CoverMap map = packed(8, std::vector<glm::vec4>(64, {0.0f, 1.0f, -3.0f, 4.0f}));
  for (std::size_t channel = 0; channel < 4; ++channel)
    EXPECT_EQ(texel(map, 0, 3, 5, channel), channel % 2 == 0 ? 0.0 : 1.0);
}

TEST_P(CoverSamples, AreBilinear) {
  for (const int size : {1, 2, 8, 64}) {
    const CoverMap map = packed(size, random_values(size));
    std::vector<int> x_fx8, y_fx8, level;
    for (std::uint64_t n = 0; n < 999; ++n) {
      x_fx8.push_back(static_cast<int>(random_uniform(1, n) * 3.0 * 256 * size) - 256 * size);
      y_fx8.push_back(static_cast<int>(random_uniform(2, n) * 3.0 * 256 * size) - 256 * size);
      level.push_back(static_cast<int>(random_uniform(3, n) * map.levels));
    }
    const std::vector<Sample4> got = sample_cover(map, {x_fx8, y_fx8, level});
    for (std::size_t n = 0; n < got.size(); ++n) {
      const int x = x_fx8[n] >> level[n], y = y_fx8[n] >> level[n];
      const int i = x >> 8, j = y >> 8;
      const double u = (x & 255) / 256.0, v = (y & 255) / 256.0;
      const float channels[4] = {got[n].r, got[n].g, got[n].b, got[n].a};
      for (std::size_t c = 0; c < 4; ++c) {
        const double low =
            texel(map, level[n], i, j, c) * (1 - u) + texel(map, level[n], i + 1, j, c) * u;
        const double high =
            texel(map, level[n], i, j + 1, c) * (1 - u) + texel(map, level[n], i + 1, j + 1, c) * u;
        EXPECT_NEAR(channels[c], low * (1 - v) + high * v, 1.0 / 256.0 + 1e-6) << size << " " << n;
      }
    }
  }
}

}  // namespace
}  // namespace swell::texture
