// What draw_samples() draws into.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_RASTER_SAMPLE_TARGET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RASTER_SAMPLE_TARGET_INL_H_
#undef SWELL_RASTER_SAMPLE_TARGET_INL_H_
#else
#define SWELL_RASTER_SAMPLE_TARGET_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "math/lanes-inl.h"
#include "raster/pass.h"
#include "raster/samples.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// The marked pixels of a tile and their samples. Lanes are the samples of one or more pixels that
// follow each other in their row, or some of one pixel.
struct SampleTarget {
  const PixelMask& mask;
  PixelBox box;
  SampleExtent extent;
  std::uint32_t samples;                                     // of all marked pixels, >= kLanes
  std::uint64_t rows, columns;                               // that hold a marked pixel
  std::array<std::uint32_t, PixelMask::kMaxRows> row_begin;  // marked pixels in the rows above
  // Of one pixel's samples, repeated.
  alignas(64) std::array<std::int32_t, std::max<std::size_t>(kLanes, kMaxSamples)> x_fx8, y_fx8;
  const std::uint8_t* HWY_RESTRICT column;  // of each sample's pixel
  float* HWY_RESTRICT depth;
  std::uint32_t* HWY_RESTRICT primitive;

  HWY_INLINE VI x_of(std::uint32_t part) const { return hn::Load(DI(), &x_fx8[part * kLanes]); }
  HWY_INLINE VI y_of(std::uint32_t part) const { return hn::Load(DI(), &y_fx8[part * kLanes]); }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
