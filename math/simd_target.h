// Which SIMD target the kernels run on. Every kernel is built for the targets of the processor's
// family, AVX2 (with FMA) and AVX-512, or NEON, and gives the same bits on all; the choice is about
// speed, and for tests.
#pragma once

#include <span>
#include <string_view>

namespace swell {

enum class SimdTarget { kAvx2, kAvx512, kNeon };

// Those that this family of processors has, the best one last.
std::span<const SimdTarget> simd_targets();

// True if this CPU can run the library at all. Programs call this first and stop with one clear
// line if it is false; everything else assumes it.
bool cpu_is_supported();

// What a CPU of this family needs for that: "AVX2, FMA, BMI2 and F16C", or "NEON".
std::string_view cpu_requirement();

// True if this CPU can run the target.
bool simd_target_available(SimdTarget target);

// The target the kernels run on now: the best available one unless select_simd_target was called.
SimdTarget current_simd_target();

// Makes all kernels of this process run on `target`, which must be available. Call it between
// frames only. Not thread-safe.
void select_simd_target(SimdTarget target);

std::string_view simd_target_name(SimdTarget target);  // "avx2", "avx512", "neon"

}  // namespace swell
