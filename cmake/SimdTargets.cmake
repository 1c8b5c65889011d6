# The SIMD targets that the kernels are built for.
#   swell_simd_targets    their names: avx2 and avx512, or neon
#   swell_simd_baseline   Highway's name of the first
#   swell_simd_disabled   those of Highway's that are left out, joined by |
set(SWELL_SIMD "all" CACHE STRING "SIMD targets: all, or on x86-64 avx2 alone, which builds in half the time")
if(NOT SWELL_SIMD MATCHES "^(all|avx2)$")
  message(FATAL_ERROR "SWELL_SIMD is '${SWELL_SIMD}'; allowed: all, avx2")
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(swell_simd_targets neon)
  set(swell_simd_baseline HWY_NEON)
  # Highway's NEON includes AES, which nothing here uses: functions that the compiler adds to our vectors' structs are
  # inlined into the kernels only if both may. char is signed, as on x86-64.
  add_compile_options(-march=armv8-a+crypto -fsigned-char)
  set(swell_simd_disabled HWY_EMU128 HWY_SCALAR HWY_SVE HWY_SVE2 HWY_SVE_256 HWY_SVE2_128)
else()
  set(swell_simd_targets avx2)
  set(swell_simd_baseline HWY_AVX2)
  # 0x50: Highway 1.2's AVX-512 for Zen 4 and Sapphire Rapids, for which 1.0.3 has no names.
  set(swell_simd_disabled HWY_SSSE3 HWY_SSE4 HWY_EMU128 HWY_SCALAR 0x50)
  if(SWELL_SIMD STREQUAL "all")
    list(APPEND swell_simd_targets avx512)
  else()
    list(APPEND swell_simd_disabled HWY_AVX3 HWY_AVX3_DL)
  endif()
endif()
list(JOIN swell_simd_disabled "|" swell_simd_disabled)
