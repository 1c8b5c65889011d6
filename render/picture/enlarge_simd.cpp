#include <algorithm>
#include <cstdint>

#include "render/picture/enlarge.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/enlarge_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes
namespace packed = texture::HWY_NAMESPACE;

using D8 = hn::ScalableTag<std::uint8_t>;
using D32 = hn::ScalableTag<std::uint32_t>;
using D64 = hn::ScalableTag<std::uint64_t>;
using V32 = hn::Vec<D32>;
using V64 = hn::Vec<D64>;
constexpr std::size_t kPixels = hn::MaxLanes(D32()), kHalf = hn::MaxLanes(D64());

// A pixel's bytes in the low bytes of four 16-bit fields: R and B, then G and A.
HWY_INLINE V64 LoadFields(const std::uint32_t* pixels) {
  const D64 d;
  const V64 p = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint32_t, D64>(), pixels));
  return (p & 0x00ff00ffu) | hn::ShiftLeft<24>(p & 0xff00ff00u);
}

// The pixels of both halves of a packet, in order.
HWY_INLINE V32 GatherBytes(V64 half0, V64 half1) {
  return packed::EvenParts(D32(), half0 | hn::ShiftRight<24>(half0),
                           half1 | hn::ShiftRight<24>(half1));
}

// From a to b, rounded; the weight, in [0, 256], in every field. Sums are below 2^16.
HWY_INLINE V64 Blend(V64 a, V64 b, V64 weight_fx8) {
  const hn::Repartition<std::uint16_t, D64> d16;
  const auto weight = hn::BitCast(d16, weight_fx8);
  const auto part_a = hn::BitCast(d16, a) * (256 - weight);
  const auto part_b = hn::BitCast(d16, b) * weight;
  const auto sum = part_a + part_b + 128;
  return hn::BitCast(D64(), hn::ShiftRight<8>(sum));
}

void BlendRows(const std::uint32_t* a, const std::uint32_t* b, int weight_fx8, std::size_t columns,
               std::uint64_t* row) {
  const D64 d;
  const V64 weight = hn::Set(d, 0x0001000100010001u * static_cast<std::uint64_t>(weight_fx8));
  std::size_t x = 0;
  for (; x + kHalf <= columns; x += kHalf)
    hn::StoreU(Blend(LoadFields(a + x), LoadFields(b + x), weight), d, row + x);
  std::uint32_t end_a[kHalf] = {}, end_b[kHalf] = {};
  std::copy(a + x, a + columns, end_a);
  std::copy(b + x, b + columns, end_b);
  hn::StoreU(Blend(LoadFields(end_a), LoadFields(end_b), weight), d, row + x);
}

// One half of a packet's pixels, as of packed::LoadWords.
template <int kWhich>
HWY_INLINE V64 StretchHalf(const std::uint64_t* row, const std::uint32_t* first, V64 weight_fx8) {
  const D8 d8;
  const V64 left = hn::BitCast(D64(), packed::LoadWords<8, kWhich>(d8, row, first));
  const V64 right = hn::BitCast(D64(), packed::LoadWords<8, kWhich>(d8, row + 1, first));
  return Blend(left, right, weight_fx8);
}

void StretchRow(const EnlargeTables& tables, const std::uint64_t* row, std::uint32_t* result) {
  const D32 d;
  const D64 d64;
  const auto width = static_cast<std::size_t>(tables.to.width_px);
  for (std::size_t x = 0; x < width; x += kPixels) {
    const std::uint32_t* first = tables.first.data() + x;
    const V32 weight = hn::LoadU(d, tables.weight_fx8_twice.data() + x);
    const V64 half0 =
        StretchHalf<0>(row, first, hn::BitCast(d64, hn::InterleaveLower(d, weight, weight)));
    const V64 half1 =
        StretchHalf<1>(row, first, hn::BitCast(d64, hn::InterleaveUpper(d, weight, weight)));
    const V32 pixels = GatherBytes(half0, half1);
    if (x + kPixels <= width) {
      hn::StoreU(pixels, d, result + x);
    } else {
      std::uint32_t end[kPixels];
      hn::StoreU(pixels, d, end);
      std::copy_n(end, width - x, result + x);
    }
  }
}

void EnlargeRow(const EnlargeTables& tables, const std::uint32_t* a, const std::uint32_t* b,
                int weight_fx8, std::uint64_t* row, std::uint32_t* result) {
  BlendRows(a, b, weight_fx8, static_cast<std::size_t>(tables.from.width_px), row);
  StretchRow(tables, row, result);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(EnlargeRow);

void enlarge_row(const EnlargeTables& tables, const std::uint32_t* a, const std::uint32_t* b,
                 int weight_fx8, std::uint64_t* row, std::uint32_t* result) {
  HWY_DYNAMIC_DISPATCH(EnlargeRow)(tables, a, b, weight_fx8, row, result);
}

}  // namespace swell::render
#endif
