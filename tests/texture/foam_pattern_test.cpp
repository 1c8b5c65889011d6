// The thresholds of foam.
#include "texture/foam_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swell::texture {
namespace {

constexpr int kPatternSize = 64;

TEST(FoamPattern, AThresholdCoversExactlyItsPart) {
  std::vector<float> pattern = make_foam_pattern(kPatternSize, 3);
  ASSERT_EQ(pattern.size(), static_cast<std::size_t>(kPatternSize * kPatternSize));
  std::ranges::sort(pattern);
  for (std::size_t k = 0; k < pattern.size(); ++k)
    ASSERT_FLOAT_EQ(pattern[k], (static_cast<float>(k) + 0.5f) / (kPatternSize * kPatternSize));
}

// No seam: neighbours across the edge differ as neighbours inside do.
TEST(FoamPattern, IsPeriodic) {
  const std::vector<float> pattern = make_foam_pattern(kPatternSize, 3);
  const auto mean_step = [&](int column) {
    double sum = 0.0;
    for (int y = 0; y < kPatternSize; ++y)
      sum += std::abs(pattern[y * kPatternSize + column] -
                      pattern[y * kPatternSize + (column + 1) % kPatternSize]);
    return sum / kPatternSize;
  };
  double inside = 0.0;
  for (int x = 0; x < kPatternSize - 1; ++x) inside += mean_step(x) / (kPatternSize - 1);
  EXPECT_NEAR(mean_step(kPatternSize - 1), inside, 0.3 * inside);
}

TEST(FoamPattern, SeedsDiffer) {
  EXPECT_EQ(make_foam_pattern(kPatternSize, 3), make_foam_pattern(kPatternSize, 3));
  EXPECT_NE(make_foam_pattern(kPatternSize, 3), make_foam_pattern(kPatternSize, 4));
}

}  // namespace
}  // namespace swell::texture
