#include "math/simd_target.h"

#include <cpuid.h>
#include <hwy/highway.h>

#include "math/check.h"

namespace swell {
namespace {

constexpr int64_t highway_bit(SimdTarget target) {
  return target == SimdTarget::kAvx2 ? int64_t{HWY_AVX2} : int64_t{HWY_AVX3};
}

// Clang 14's __builtin_cpu_supports does not know this one.
bool cpu_has_f16c() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_F16C) != 0;
}

}  // namespace

bool cpu_is_supported() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2") && cpu_has_f16c();
}

bool simd_target_available(SimdTarget target) {
  if (!cpu_is_supported()) return false;
  return target == SimdTarget::kAvx2 ||
         ((HWY_TARGETS & HWY_AVX3) != 0 && __builtin_cpu_supports("avx512f") &&
          __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512bw"));
}

SimdTarget current_simd_target() {
  const bool avx512 = (hwy::SupportedTargets() & HWY_TARGETS & HWY_AVX3) != 0;
  return avx512 ? SimdTarget::kAvx512 : SimdTarget::kAvx2;
}

void select_simd_target(SimdTarget target) {
  SWELL_CHECK(simd_target_available(target), "target={}", simd_target_name(target));
  hwy::SetSupportedTargetsForTest(highway_bit(target));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::string_view simd_target_name(SimdTarget target) {
  return target == SimdTarget::kAvx2 ? "avx2" : "avx512";
}

}  // namespace swell
