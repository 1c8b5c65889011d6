#include "math/simd_target.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

namespace swell {
namespace {

// The CPU flags as the kernel of the operating system reports them.
std::set<std::string> cpu_flags() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("flags")) continue;
    std::istringstream words(line.substr(line.find(':') + 1));
    std::set<std::string> flags;
    for (std::string word; words >> word;) flags.insert(word);
    return flags;
  }
  return {};
}

TEST(SimdTarget, AgreesWithTheOperatingSystemAboutTheCpu) {
  const std::set<std::string> flags = cpu_flags();
  ASSERT_FALSE(flags.empty());
  const auto has = [&](const char* flag) { return flags.contains(flag); };
  const bool avx2 = has("avx2") && has("fma") && has("bmi2") && has("f16c");
  const bool avx512 = std::string_view(SWELL_SIMD) == "all" && avx2 && has("avx512f") &&
                      has("avx512vl") && has("avx512dq") && has("avx512bw");
  EXPECT_EQ(cpu_is_supported(), avx2);
  EXPECT_EQ(simd_target_available(SimdTarget::kAvx2), avx2);
  EXPECT_EQ(simd_target_available(SimdTarget::kAvx512), avx512);
}

// Tests that compare the targets have only one to run on elsewhere, and say nothing of it.
TEST(SimdTarget, BothCanBeTestedHere) {
  if (!simd_target_available(SimdTarget::kAvx512))
    GTEST_SKIP() << "this CPU or this build has no AVX-512: all SIMD tests run on AVX2 alone";
}

TEST(SimdTarget, TheBestTargetIsTheDefault) {
  EXPECT_EQ(current_simd_target(),
            simd_target_available(SimdTarget::kAvx512) ? SimdTarget::kAvx512 : SimdTarget::kAvx2);
}

TEST(SimdTarget, SelectingATargetMakesItCurrentAndCanBeUndone) {
  const SimdTarget before = current_simd_target();
  for (const SimdTarget target : {SimdTarget::kAvx2, SimdTarget::kAvx512, SimdTarget::kAvx2}) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    EXPECT_EQ(current_simd_target(), target);
  }
  select_simd_target(before);
  EXPECT_EQ(current_simd_target(), before);
}

TEST(SimdTarget, HasTheNamesOfTheOptions) {
  EXPECT_EQ(simd_target_name(SimdTarget::kAvx2), "avx2");
  EXPECT_EQ(simd_target_name(SimdTarget::kAvx512), "avx512");
}

}  // namespace
}  // namespace swell
