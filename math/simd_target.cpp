#include "math/simd_target.h"

#include <hwy/highway.h>

#include <array>

#include "math/check.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace swell {
namespace {

#if defined(__x86_64__)
constexpr std::array kTargets = {SimdTarget::kAvx2, SimdTarget::kAvx512};

// Clang 14's __builtin_cpu_supports does not know this one.
bool cpu_has_f16c() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_F16C) != 0;
}
#elif defined(__aarch64__)
constexpr std::array kTargets = {SimdTarget::kNeon};
#else
#error "Swell's kernels are for x86-64 and 64-bit Arm"
#endif

constexpr int64_t highway_bit(SimdTarget target) {
  switch (target) {
    case SimdTarget::kAvx2:
      return HWY_AVX2;
    case SimdTarget::kAvx512:
      return HWY_AVX3;
    case SimdTarget::kNeon:
      return HWY_NEON;
  }
  return 0;
}

}  // namespace

std::span<const SimdTarget> simd_targets() { return kTargets; }

#if defined(__x86_64__)
bool cpu_is_supported() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2") && cpu_has_f16c();
}

std::string_view cpu_requirement() { return "AVX2, FMA, BMI2 and F16C"; }

bool simd_target_available(SimdTarget target) {
  if (!cpu_is_supported()) return false;
  return target == SimdTarget::kAvx2 ||
         (target == SimdTarget::kAvx512 && (HWY_TARGETS & HWY_AVX3) != 0 &&
          __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"));
}

SimdTarget current_simd_target() {
  const bool avx512 = (hwy::SupportedTargets() & HWY_TARGETS & HWY_AVX3) != 0;
  return avx512 ? SimdTarget::kAvx512 : SimdTarget::kAvx2;
}
#else
// NEON is part of the family.
bool cpu_is_supported() { return true; }
std::string_view cpu_requirement() { return "NEON"; }
bool simd_target_available(SimdTarget target) { return target == SimdTarget::kNeon; }
SimdTarget current_simd_target() { return SimdTarget::kNeon; }
#endif

void select_simd_target(SimdTarget target) {
  SWELL_CHECK(simd_target_available(target), "target={}", simd_target_name(target));
  hwy::SetSupportedTargetsForTest(highway_bit(target));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::string_view simd_target_name(SimdTarget target) {
  switch (target) {
    case SimdTarget::kAvx2:
      return "avx2";
    case SimdTarget::kAvx512:
      return "avx512";
    case SimdTarget::kNeon:
      return "neon";
  }
  return "";
}

}  // namespace swell
