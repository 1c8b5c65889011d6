// The processor's word of control for floating-point arithmetic.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace swell {

#if defined(__x86_64__)
constexpr std::uint64_t kFloatDefaults = 0x1f80, kRoundUp = 0x4000;
constexpr std::uint64_t kFlushToZero = 0x8040;  // what is computed and what is read
constexpr std::uint64_t kControlBits = 0xffc0;  // of MXCSR: all but the sticky exception flags

inline std::uint64_t float_control() { return _mm_getcsr(); }
inline void set_float_control(std::uint64_t word) { _mm_setcsr(static_cast<unsigned>(word)); }
#else
constexpr std::uint64_t kFloatDefaults = 0, kRoundUp = 1u << 22, kFlushToZero = 1u << 24;
constexpr std::uint64_t kControlBits = ~std::uint64_t{0};  // of FPCR

inline std::uint64_t float_control() {
  std::uint64_t word;
  __asm__ volatile("mrs %0, fpcr" : "=r"(word));
  return word;
}
inline void set_float_control(std::uint64_t word) {
  __asm__ volatile("msr fpcr, %0" : : "r"(word));
}
#endif

}  // namespace swell
