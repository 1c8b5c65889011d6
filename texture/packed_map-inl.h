// Samplers of the packed maps on Highway vectors of float: one bilinear sample for every lane.
// Include after the std and own headers inside a *_simd.cpp file (included once per target).
//
// All sums are exact integers, so that every target gives the same bits. Taps come by scalar
// 64-bit loads: hardware gathers of eight words take two to five times as long.
// The one-packet functions expect full vectors (hn::ScalableTag<float>).
#if defined(SWELL_TEXTURE_PACKED_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TEXTURE_PACKED_MAP_INL_H_
#undef SWELL_TEXTURE_PACKED_MAP_INL_H_
#else
#define SWELL_TEXTURE_PACKED_MAP_INL_H_
#endif

#include <hwy/highway.h>
#include <immintrin.h>

#include <cstdint>
#include <cstring>

#include "texture/packed_map.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Every 64-bit word belongs to one lane. Half 0 of a packet's words are those of the lanes with
// lane % 4 < 2, half 1 the others: the order in which InterleaveLower and InterleaveUpper widen
// 32-bit lanes and in which EvenParts and OddParts put them together again.

HWY_INLINE std::uint64_t LoadWord(const void* bytes) {
  std::uint64_t word;
  std::memcpy(&word, bytes, sizeof(word));
  return word;
}

// Stores the lanes' word numbers for LoadWords, for good: left to itself, GCC takes each lane out
// of the vector again by shuffles, on the one port that also puts the words together.
template <class VI, std::size_t kLanes>
HWY_INLINE void StoreIndex(VI index, std::uint32_t (&lane_index)[kLanes]) {
  const hn::ScalableTag<std::uint32_t> du;
  static_assert(hn::MaxLanes(du) == kLanes);
  hn::Store(hn::BitCast(du, index), du, lane_index);
  asm volatile("" : "+m"(lane_index));
}

// The words at base + kBytes * index of one half of the packet's lanes.
template <int kBytes, int kHalf, class D8>
HWY_INLINE hn::Vec<D8> LoadWords(D8, const void* base, const std::uint32_t* HWY_RESTRICT index) {
  const auto word = [&](int i) HWY_ATTR {
    const std::size_t lane = 4 * (static_cast<unsigned>(i) / 2) + 2 * kHalf + i % 2;
    return static_cast<long long>(LoadWord(static_cast<const std::uint8_t*>(base) +
                                           kBytes * static_cast<std::size_t>(index[lane])));
  };
#if HWY_TARGET == HWY_AVX2
  return hn::Vec<D8>{_mm256_set_epi64x(word(3), word(2), word(1), word(0))};
#else
  return hn::Vec<D8>{_mm512_set_epi64(word(7), word(6), word(5), word(4),  //
                                      word(3), word(2), word(1), word(0))};
#endif
}

// The low 32 bits of every word of both halves, in lane order; OddParts the high 32 bits.
template <class DI, class VB>
HWY_INLINE hn::Vec<DI> EvenParts(DI di, VB half0, VB half1) {
  const hn::RebindToFloat<DI> df;
  const auto lo = hn::BitCast(df, half0), hi = hn::BitCast(df, half1);
#if HWY_TARGET == HWY_AVX2
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm256_shuffle_ps(lo.raw, hi.raw, 0x88)});
#else
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm512_shuffle_ps(lo.raw, hi.raw, 0x88)});
#endif
}

template <class DI, class VB>
HWY_INLINE hn::Vec<DI> OddParts(DI di, VB half0, VB half1) {
  const hn::RebindToFloat<DI> df;
  const auto lo = hn::BitCast(df, half0), hi = hn::BitCast(df, half1);
#if HWY_TARGET == HWY_AVX2
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm256_shuffle_ps(lo.raw, hi.raw, 0xdd)});
#else
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm512_shuffle_ps(lo.raw, hi.raw, 0xdd)});
#endif
}

// Sums of neighbouring products of unsigned weights and signed taps: 16 bits each. No sum leaves
// 16 bits while the weights of a pair add up to at most 255.
template <class VB>
HWY_INLINE VB DotPairs(VB weights_u8, VB taps_s8) {
#if HWY_TARGET == HWY_AVX2
  return VB{_mm256_maddubs_epi16(weights_u8.raw, taps_s8.raw)};
#else
  return VB{_mm512_maddubs_epi16(weights_u8.raw, taps_s8.raw)};
#endif
}

// Sums of four neighbouring products: 32 bits each.
template <class VB>
HWY_INLINE VB DotQuads(VB weights_u8, VB taps_s8) {
#if HWY_TARGET == HWY_AVX2
  return VB{
      _mm256_madd_epi16(_mm256_maddubs_epi16(weights_u8.raw, taps_s8.raw), _mm256_set1_epi16(1))};
#else
  return VB{
      _mm512_madd_epi16(_mm512_maddubs_epi16(weights_u8.raw, taps_s8.raw), _mm512_set1_epi16(1))};
#endif
}

// Bilinear weights of the four taps as bytes (x,y), (x+1,y), (x,y+1), (x+1,y+1) from the low byte
// of each lane up, for the fractions x, y [the coordinates' low bytes / 256]. They add up to
// exactly 255, and their positive errors to less than 1 (1/255 of the taps' range):
//   row y+1 gets r1 = round(255 y), row y gets r0 = 255 - r1, off by e1 = r1 - 255 y = -e0;
//   in each row, the right tap gets round(255 x y_i + e_i / 2), y1 = y, y0 = 1 - y, the left one
//   the rest.
// Why not round(r_i x), which is off by e_i x more than its rounding: where the two rows' roundings
// then oppose, the errors add up to 1.49. Half the row's error, for all x, leaves 1 in every case.
// Rows, and in them both taps along x, are monotonic; along y, single taps step back by one in
// 169 places (the rows' ramp does not).
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI BilinearWeights(DI di, VI x_fx8, VI y_fx8) {
  const hn::Repartition<std::uint8_t, DI> d8;
  const hn::Repartition<std::uint16_t, DI> d16;
  // 16-bit lanes: row 0 low, row 1 high.
  alignas(16) static constexpr std::uint8_t kLow[16] = {0, 128, 0, 128, 4,  128, 4,  128,
                                                        8, 128, 8, 128, 12, 128, 12, 128};
  alignas(16) static constexpr std::uint8_t kHigh[16] = {128, 0, 128, 0, 128, 4,  128, 4,
                                                         128, 8, 128, 8, 128, 12, 128, 12};
  const auto bytes = [&](VI v, const std::uint8_t* order) HWY_ATTR {
    return hn::BitCast(d16, hn::TableLookupBytesOr0(hn::BitCast(d8, v), hn::LoadDup128(d8, order)));
  };
  const auto pair = [&](std::uint32_t row0, std::uint32_t row1) HWY_ATTR {
    return hn::BitCast(d16, hn::Set(di, static_cast<std::int32_t>(row1 << 16 | row0)));
  };
  const auto fx = bytes(x_fx8, kHigh);  // 256 (256 x)
  const auto fy = bytes(y_fx8, kLow);   // 256 y
  // 255 y_i in 1/256, then rounded; the tie at y = 1/2 goes up in row 1 and down in row 0.
  const auto signed_height = hn::Mul(fy, pair(0x10000 - 255, 255));
  const auto height = hn::Add(signed_height, pair(255 * 256, 0));
  const auto rounded = hn::Add(signed_height, pair(255 * 256 + 127, 128));
  const auto rows = hn::ShiftRight<8>(rounded);
  // The low byte of `rounded` is 128 - 256 e_i; 64 + 127 - byte / 2 is 256 (1 + e_i) / 2.
  const auto half_error = hn::AndNot(hn::ShiftRight<1>(rounded), hn::Set(d16, 127));
  const auto bias = hn::Add(half_error, hn::Set(d16, 64));
  const auto right = hn::ShiftRight<8>(hn::Add(hn::MulHigh(height, fx), bias));
  // (rows - right) + 256 right.
  return hn::BitCast(di, hn::Add(rows, hn::Mul(right, hn::Set(d16, 255))));
}

// Coordinate u in turns of the map to 1/256 texels, in the low bits of the result: those above
// log2(256 * size) mean nothing. Any float gives some number; |u| < 2^20 gives the right one.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> TexelCoordinateFx8(D d, V u, V size_fx8) {
  const V fraction = hn::Sub(u, hn::Floor(u));
  // Adding 1.5 * 2^23 rounds to an integer, to nearest even; fraction * size_fx8 <= 2^20 is exact.
  return hn::BitCast(hn::RebindToSigned<D>(),
                     hn::MulAdd(fraction, size_fx8, hn::Set(d, 12582912.0f)));
}

// The dot products of the words at `index` with the weights, times scale / 255.
template <class D, class V = hn::Vec<D>, class VI>
HWY_INLINE void BlendPacked2(D d, const PackedMap2& map, VI index, VI weights, V& a, V& b) {
  const hn::RebindToSigned<D> di;
  const hn::Repartition<std::uint8_t, D> d8;
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(d)];
  StoreIndex(index, lane_index);
  const auto words0 = LoadWords<8, 0>(d8, map.words.data(), lane_index);
  const auto words1 = LoadWords<8, 1>(d8, map.words.data(), lane_index);
  // Each lane's weights twice: for channel a and for channel b.
  const auto weights0 = hn::BitCast(d8, hn::InterleaveLower(di, weights, weights));
  const auto weights1 = hn::BitCast(d8, hn::InterleaveUpper(di, weights, weights));
  const auto sums0 = DotQuads(weights0, words0);
  const auto sums1 = DotQuads(weights1, words1);
  const V unit = hn::Set(d, map.scale / 255.0f);
  a = hn::Mul(hn::ConvertTo(d, EvenParts(di, sums0, sums1)), unit);
  b = hn::Mul(hn::ConvertTo(d, OddParts(di, sums0, sums1)), unit);
}

// Samples `map` bilinearly at (u, v) [turns of the map: 1 is one period; texel (i, j) lies at
// (i, j) / size; |u|, |v| < 2^20] on a mip level per lane [clamped to the map's]. Positions are
// snapped to 1/256 texel. The result lies within the taps' minimum and maximum; a texel's own
// position gives that texel. A NaN or infinite coordinate gives some texel's value.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE void SamplePacked2(D d, const PackedMap2& map, V u, V v, VI level, V& a, V& b) {
  const hn::RebindToSigned<D> di;
  // Level l is 2^k texels wide.
  const VI finest = hn::Set(di, map.levels - 1);
  const VI k = hn::Sub(finest, hn::Min(hn::Max(level, hn::Zero(di)), finest));
  const VI size = hn::Shl(hn::Set(di, 1), k);
  const VI mask = hn::Sub(size, hn::Set(di, 1));
  const V size_fx8 = hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(k, hn::Set(di, 127 + 8))));

  const VI x_fx8 = TexelCoordinateFx8(d, u, size_fx8);
  const VI y_fx8 = TexelCoordinateFx8(d, v, size_fx8);
  const VI x = hn::And(hn::ShiftRight<8>(x_fx8), mask);
  const VI y = hn::And(hn::ShiftRight<8>(y_fx8), mask);
  const VI weights = BilinearWeights(di, x_fx8, y_fx8);
  // A level of size s begins at word s * s, so that its rows are rows s to 2 s - 1 of s words.
  const VI index = hn::Or(hn::Shl(hn::Or(y, size), k), x);
  BlendPacked2(d, map, index, weights, a, b);
}

// As SamplePacked2 with one level for all lanes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SamplePacked2Level(D d, const PackedMap2& map, V u, V v, int level, V& a, V& b) {
  const hn::RebindToSigned<D> di;
  using VI = hn::Vec<hn::RebindToSigned<D>>;
  const int finest = map.levels - 1;
  const int k = finest - (level < 0 ? 0 : level > finest ? finest : level);
  const int size = 1 << k;
  const VI mask = hn::Set(di, size - 1);
  const V size_fx8 = hn::Set(d, static_cast<float>(size * 256));

  const VI x_fx8 = TexelCoordinateFx8(d, u, size_fx8);
  const VI y_fx8 = TexelCoordinateFx8(d, v, size_fx8);
  const VI x = hn::And(hn::ShiftRight<8>(x_fx8), mask);
  const VI y = hn::And(hn::ShiftRight<8>(y_fx8), mask);
  const VI weights = BilinearWeights(di, x_fx8, y_fx8);
  const VI index = hn::Or(hn::ShiftLeftSame(hn::Or(y, hn::Set(di, size)), k), x);
  BlendPacked2(d, map, index, weights, a, b);
}

// Window coordinate to 1/256 texels from the first texel's centre, clamped to [0, texels - 1];
// NaN counts as 0. At most 2^14 texels: 22 bits.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> WindowCoordinateFx8(D d, V x_px, int texels) {
  const hn::RebindToSigned<D> di;
  const V last = hn::Set(d, static_cast<float>(texels - 1));
  V x = hn::Sub(x_px, hn::Set(d, 0.5f));
  x = hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), x);  // false for NaN
  x = hn::IfThenElse(hn::Lt(x, last), x, last);
  const V rounded = hn::MulAdd(x, hn::Set(d, 256.0f), hn::Set(d, 12582912.0f));
  return hn::And(hn::BitCast(di, rounded), hn::Set(di, (1 << 22) - 1));
}

// One half of a packet: the four channels of each lane, 16 bits each, in [0, 255 * 255].
template <class D8, class VB = hn::Vec<D8>>
HWY_INLINE VB BlendRows(D8 d8, VB row0, VB row1, VB weights0, VB weights1) {
  const hn::Repartition<std::uint16_t, D8> d16;
  // R0 G0 B0 A0 R1 G1 B1 A1 -> R0 R1 G0 G1 B0 B1 A0 A1, and signed: tap - 128.
  alignas(16) static constexpr std::uint8_t kOrder[16] = {0, 4,  1, 5,  2,  6,  3,  7,
                                                          8, 12, 9, 13, 10, 14, 11, 15};
  const VB order = hn::LoadDup128(d8, kOrder);
  const VB sign = hn::Set(d8, 0x80);
  const VB taps0 = hn::Xor(hn::TableLookupBytes(row0, order), sign);
  const VB taps1 = hn::Xor(hn::TableLookupBytes(row1, order), sign);
  // The four weights add up to 255, so the sum of (tap - 128) is 255 * 128 too small.
  const auto sum = hn::Add(hn::BitCast(d16, DotPairs(weights0, taps0)),
                           hn::BitCast(d16, DotPairs(weights1, taps1)));
  return hn::BitCast(d8, hn::Add(sum, hn::Set(d16, 255 * 128)));
}

// Samples `image` bilinearly at the window position (x_px, y_px) [texels of that image; texel
// (x, y)'s centre is (x + 0.5, y + 0.5)], clamped to the image; NaN counts as the first texel's
// centre. Results in [0, 1]. fill_padding() must have been called.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SampleRgba(D d, const RgbaImage& image, V x_px, V y_px, V& r, V& g, V& b, V& a) {
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const hn::Repartition<std::uint8_t, D> d8;
  const auto x_fx8 = WindowCoordinateFx8(d, x_px, image.width);
  const auto y_fx8 = WindowCoordinateFx8(d, y_px, image.height);
  const auto weights = BilinearWeights(di, x_fx8, y_fx8);

  // Two texels of each of two rows.
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(d)];
  const auto row = hn::Mul(hn::ShiftRight<8>(y_fx8), hn::Set(di, image.stride));
  const auto index = hn::Add(row, hn::ShiftRight<8>(x_fx8));
  StoreIndex(index, lane_index);
  const std::uint32_t* const upper = image.texels.data();
  const std::uint32_t* const lower = upper + image.stride;

  // The weights of row 0 (low 16 bits) and row 1 (high 16 bits), each over a whole lane, then
  // widened to words: left, right for each of the four channels.
  const auto low = hn::And(weights, hn::Set(di, 0xffff));
  const auto row0 = hn::Or(low, hn::ShiftLeft<16>(low));
  const auto high = hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, weights)));
  const auto row1 = hn::Or(high, hn::ShiftLeft<16>(high));
  const auto sums0 =
      BlendRows(d8, LoadWords<4, 0>(d8, upper, lane_index), LoadWords<4, 0>(d8, lower, lane_index),
                hn::BitCast(d8, hn::InterleaveLower(di, row0, row0)),
                hn::BitCast(d8, hn::InterleaveLower(di, row1, row1)));
  const auto sums1 =
      BlendRows(d8, LoadWords<4, 1>(d8, upper, lane_index), LoadWords<4, 1>(d8, lower, lane_index),
                hn::BitCast(d8, hn::InterleaveUpper(di, row0, row0)),
                hn::BitCast(d8, hn::InterleaveUpper(di, row1, row1)));

  const auto rg = EvenParts(di, sums0, sums1);
  const auto ba = OddParts(di, sums0, sums1);
  const V unit = hn::Set(d, 1.0f / (255.0f * 255.0f));
  const auto low_channel = [&](auto pair) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(d, hn::And(pair, hn::Set(di, 0xffff))), unit);
  };
  const auto high_channel = [&](auto pair) HWY_ATTR {
    const auto shifted = hn::ShiftRight<16>(hn::BitCast(du, pair));
    return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, shifted)), unit);
  };
  r = low_channel(rg);
  g = high_channel(rg);
  b = low_channel(ba);
  a = high_channel(ba);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
