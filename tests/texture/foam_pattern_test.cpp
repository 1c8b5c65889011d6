// The thresholds of foam.
#include "texture/foam_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swell::texture {
namespace {

constexpr int kSize = 64;

TEST(FoamPattern, AThresholdCoversExactlyItsPart) {
  std::vector<float> pattern = make_foam_pattern(kSize, 3);
  ASSERT_EQ(pattern.size(), static_cast<std::size_t>(kSize * kSize));
  std::ranges::sort(pattern);
  for (std::size_t k = 0; k < pattern.size(); ++k)
    ASSERT_FLOAT_EQ(pattern[k], (static_cast<float>(k) + 0.5f) / (kSize * kSize));
}

// No seam: neighbours across the edge differ as neighbours inside do.
TEST(FoamPattern, IsPeriodic) {
  const std::vector<float> pattern = make_foam_pattern(kSize, 3);
  const auto mean_step = [&](int column) {
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y)
      sum += std::abs(pattern[y * kSize + column] - pattern[y * kSize + (column + 1) % kSize]);
    return sum / kSize;
  };
  double inside = 0.0;
  for (int x = 0; x < kSize - 1; ++x) inside += mean_step(x) / (kSize - 1);
  EXPECT_NEAR(mean_step(kSize - 1), inside, 0.3 * inside);
}

TEST(FoamPattern, SeedsDiffer) {
  EXPECT_EQ(make_foam_pattern(kSize, 3), make_foam_pattern(kSize, 3));
  EXPECT_NE(make_foam_pattern(kSize, 3), make_foam_pattern(kSize, 4));
}

}  // namespace
}  // namespace swell::texture
