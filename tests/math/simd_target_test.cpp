#include "math/simd_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <ranges>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

namespace swell {
namespace {

#if defined(__x86_64__)
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

#endif

TEST(SimdTarget, TheBestTargetIsTheDefault) {
  const auto best =
      std::ranges::find_if(simd_targets() | std::views::reverse, simd_target_available);
  EXPECT_EQ(current_simd_target(), *best);
}

TEST(SimdTarget, OfAnotherFamilyIsNotAvailable) {
  EXPECT_NE(simd_target_available(SimdTarget::kNeon), simd_target_available(SimdTarget::kAvx2));
}

TEST(SimdTarget, SelectingATargetMakesItCurrentAndCanBeUndone) {
  const SimdTarget before = current_simd_target();
  for (int round = 0; round < 2; ++round)
    for (const SimdTarget target : simd_targets()) {
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
  EXPECT_EQ(simd_target_name(SimdTarget::kNeon), "neon");
}

}  // namespace
}  // namespace swell
