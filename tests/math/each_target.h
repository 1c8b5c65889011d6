// Tests of vector functions, on each SIMD target that the CPU has.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "math/simd_target.h"

namespace swell {

// Runs each test on one target and puts the best one back afterwards.
class EachTarget : public testing::TestWithParam<SimdTarget> {
 protected:
  void SetUp() override {
    if (!simd_target_available(GetParam())) GTEST_SKIP() << "this CPU lacks the target";
    before_ = current_simd_target();
    select_simd_target(GetParam());
  }
  void TearDown() override {
    if (!IsSkipped()) select_simd_target(before_);
  }

 private:
  SimdTarget before_ = simd_targets().front();
};

inline auto each_target() { return testing::ValuesIn(simd_targets()); }

inline std::string target_name(const testing::TestParamInfo<SimdTarget>& target) {
  return std::string(simd_target_name(target.param));
}

}  // namespace swell
