// What the tests of the packed maps' samplers share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "math/random.h"
#include "math/simd_target.h"

namespace swell::texture {

// Bound of the sum of positive errors of the four weights: what the blend of taps that differ by
// one may be off.
inline constexpr double kWeightError = 1.0 / 255.0;

class OnEveryTarget : public testing::TestWithParam<SimdTarget> {
 protected:
  void SetUp() override {
    if (!simd_target_available(GetParam())) GTEST_SKIP() << "this CPU lacks the target";
    select_simd_target(GetParam());
  }
};

inline auto every_target() { return testing::ValuesIn(simd_targets()); }

inline std::string target_name(const testing::TestParamInfo<SimdTarget>& info) {
  return std::string(simd_target_name(info.param));
}

inline std::vector<float> random_floats(std::size_t count, double lo, double hi,
                                        std::uint64_t seed) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(lo + (hi - lo) * random_uniform(seed, i));
  }
  return values;
}

}  // namespace swell::texture
