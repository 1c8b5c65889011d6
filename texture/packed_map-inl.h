// Samplers of the packed maps on Highway vectors of float: one bilinear sample for every lane.
// Include after the std and own headers inside a *_simd.cpp file (included once per target).
//
// All sums are exact integers, so that every target gives the same bits. Taps come by one load of
// 64 or 128 bits a lane: hardware gathers of eight 64-bit words take two to five times as long. The
// one-packet functions expect full vectors (hn::ScalableTag<float>).
#if defined(SWELL_TEXTURE_PACKED_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TEXTURE_PACKED_MAP_INL_H_
#undef SWELL_TEXTURE_PACKED_MAP_INL_H_
#else
#define SWELL_TEXTURE_PACKED_MAP_INL_H_
#endif

#include <hwy/highway.h>
#if HWY_ARCH_X86
#include <immintrin.h>
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"
#include "texture/packed_map.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

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
#elif HWY_TARGET == HWY_NEON
  const hn::Repartition<std::uint64_t, D8> d64;
  return hn::BitCast(
      D8(), hn::Vec<decltype(d64)>{vcombine_u64(vcreate_u64(static_cast<std::uint64_t>(word(0))),
                                                vcreate_u64(static_cast<std::uint64_t>(word(1))))});
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
#elif HWY_TARGET == HWY_NEON
  return hn::BitCast(di, hn::Vec<decltype(df)>{vuzp1q_f32(lo.raw, hi.raw)});
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
#elif HWY_TARGET == HWY_NEON
  return hn::BitCast(di, hn::Vec<decltype(df)>{vuzp2q_f32(lo.raw, hi.raw)});
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
#elif HWY_TARGET == HWY_NEON
  const hn::DFromV<VB> d;
  const hn::Repartition<std::int16_t, decltype(d)> d16;
  const uint8x16_t weights =
      hn::BitCast(hn::Repartition<std::uint8_t, decltype(d)>(), weights_u8).raw;
  const int8x16_t taps = hn::BitCast(hn::Repartition<std::int8_t, decltype(d)>(), taps_s8).raw;
  const auto wide = [](uint8x8_t w) { return vreinterpretq_s16_u16(vmovl_u8(w)); };
  const int16x8_t low = vmulq_s16(wide(vget_low_u8(weights)), vmovl_s8(vget_low_s8(taps)));
  const int16x8_t high = vmulq_s16(wide(vget_high_u8(weights)), vmovl_s8(vget_high_s8(taps)));
  return hn::BitCast(d, hn::Vec<decltype(d16)>{vpaddq_s16(low, high)});
#else
  return VB{_mm512_maddubs_epi16(weights_u8.raw, taps_s8.raw)};
#endif
}

// Sums of neighbouring products of signed 16-bit numbers: 32 bits each.
template <class VI>
HWY_INLINE VI DotWords(VI weights_s16, VI sums_s16) {
#if HWY_TARGET == HWY_AVX2
  return VI{_mm256_madd_epi16(weights_s16.raw, sums_s16.raw)};
#elif HWY_TARGET == HWY_NEON
  const int16x8_t weights = vreinterpretq_s16_s32(weights_s16.raw);
  const int16x8_t sums = vreinterpretq_s16_s32(sums_s16.raw);
  return VI{vpaddq_s32(vmull_s16(vget_low_s16(weights), vget_low_s16(sums)),
                       vmull_s16(vget_high_s16(weights), vget_high_s16(sums)))};
#else
  return VI{_mm512_madd_epi16(weights_s16.raw, sums_s16.raw)};
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
  const auto signed_height = fy * pair(0x10000 - 255, 255);
  const auto height = signed_height + pair(255 * 256, 0);
  const auto rounded = signed_height + pair(255 * 256 + 127, 128);
  const auto rows = hn::ShiftRight<8>(rounded);
  // The low byte of `rounded` is 128 - 256 e_i; 64 + 127 - byte / 2 is 256 (1 + e_i) / 2.
  const auto half_error = hn::AndNot(hn::ShiftRight<1>(rounded), hn::Set(d16, 127));
  const auto bias = half_error + 64;
  const auto right = hn::ShiftRight<8>(hn::MulHigh(height, fx) + bias);
  // (rows - right) + 256 right.
  return hn::BitCast(di, rows + right * 255);
}

// Weights of the left and right taps of both rows, as bytes 255 - f, f, 255 - f, f for the fraction
// f in the coordinates' low bytes: f / 255 for f / 256, off by at most 1 / 256.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI WeightsAlongX(DI di, VI x_fx8) {
  const hn::Repartition<std::uint8_t, DI> d8;
  alignas(16) static constexpr std::uint8_t kRepeat[16] = {0, 0, 0, 0, 4,  4,  4,  4,
                                                           8, 8, 8, 8, 12, 12, 12, 12};
  const auto f = hn::TableLookupBytes(hn::BitCast(d8, x_fx8), hn::LoadDup128(d8, kRepeat));
  return hn::Xor(hn::BitCast(di, f), hn::Set(di, 0x00ff00ff));
}

// A byte that both 16-bit halves of a lane get: its low byte.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI LowByteTwice(DI di, VI v) {
  const hn::Repartition<std::uint8_t, DI> d8;
  alignas(16) static constexpr std::uint8_t kWiden[16] = {0, 128, 0, 128, 4,  128, 4,  128,
                                                          8, 128, 8, 128, 12, 128, 12, 128};
  return hn::BitCast(di, hn::TableLookupBytesOr0(hn::BitCast(d8, v), hn::LoadDup128(d8, kWiden)));
}

// Weights of the upper and lower row, 16 bits each: 256 - f and f for the fraction f in the
// coordinates' low bytes.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI WeightsAlongY(DI di, VI y_fx8) {
  return hn::Xor(LowByteTwice(di, y_fx8), hn::Set(di, 0x000000ff)) + 1;
}

// The numbers of the words of texels (x, y); coordinates in 1/256 texels of each lane's level,
// which is one of the map's. A level of size s begins at word s * s, so that its rows are rows s to
// 2 s - 1 of s words.
template <class DI, class Map, class VI = hn::Vec<DI>>
HWY_INLINE VI WordIndex(DI di, const Map& map, VI x_fx8, VI y_fx8, VI level) {
  const VI mask = hn::Shr(hn::Set(di, map.size - 1), level);
  const VI x = hn::ShiftRight<8>(x_fx8) & mask;
  const VI y = hn::ShiftRight<8>(y_fx8) & mask;
  const VI row = y | (mask + 1);
  return hn::Shl(row, (map.levels - 1) - level) | x;
}

// Where those words of `map` lie, in bytes.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI WordOffset(DI di, const PackedMap2& map, VI x_fx8, VI y_fx8, VI level) {
  static_assert(sizeof(PackedWord) == 16);
  return hn::ShiftLeft<4>(WordIndex(di, map, x_fx8, y_fx8, level));
}

// The 32 bits of the lane with lane % 4 == kPart, from `fine` in the low and from `coarse` in the
// high half of its block of 128 bits: as LoadBlocks puts the words of those lanes.
template <int kPart, class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI SpreadPart(DI di, VI fine, VI coarse) {
  const hn::RebindToFloat<DI> df;
  const auto lo = hn::BitCast(df, fine), hi = hn::BitCast(df, coarse);
#if HWY_TARGET == HWY_AVX2
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm256_shuffle_ps(lo.raw, hi.raw, kPart * 0x55)});
#elif HWY_TARGET == HWY_NEON
  return hn::BitCast(
      di, hn::Vec<decltype(df)>{vcombine_f32(vdup_n_f32(vgetq_lane_f32(lo.raw, kPart)),
                                             vdup_n_f32(vgetq_lane_f32(hi.raw, kPart)))});
#else
  return hn::BitCast(di, hn::Vec<decltype(df)>{_mm512_shuffle_ps(lo.raw, hi.raw, kPart * 0x55)});
#endif
}

// The 128-bit words of the lanes with lane % 4 == kPart, at these offsets [bytes].
template <int kPart, class D8>
HWY_INLINE hn::Vec<D8> LoadBlocks(D8, const void* words, const std::uint32_t* HWY_RESTRICT offset) {
#if HWY_TARGET == HWY_NEON
  const hn::Repartition<std::uint8_t, D8> d8;
  return hn::BitCast(D8(), hn::LoadU(d8, static_cast<const std::uint8_t*>(words) + offset[kPart]));
#else
  const auto word = [&](int block) HWY_ATTR {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(static_cast<const std::uint8_t*>(words) +
                                                           offset[4 * block + kPart]));
  };
  const __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(word(0)), word(1), 1);
#if HWY_TARGET == HWY_AVX2
  return hn::Vec<D8>{low};
#else
  const __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(word(2)), word(3), 1);
  return hn::Vec<D8>{_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1)};
#endif
#endif
}

// Where maps are blended: at (x_fx8, y_fx8) [1/256 texels of level 0; texel (i, j) lies at (i, j),
// and a map repeats], bilinearly on mip levels `base` and `base` + 1 and between them by t in
// [0, 1]. base in [0, detail_levels); the level after the last one of those is 0.
template <class D>
struct BlendedPlace {
  hn::Vec<hn::RebindToSigned<D>> x_fx8, y_fx8, base;
  hn::Vec<D> t;
};

// Adds `gain` times what `map` holds there to (a, b). The positive weights add up to 1 and are off
// by less than 1/127 together; with t 0 a texel's own position gives that texel.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void AddBlended(D d, const PackedMap2& map, BlendedPlace<D> place, float gain, V& a,
                           V& b) {
  const hn::RebindToSigned<D> di;
  using VI = hn::Vec<decltype(di)>;
  const VI x_fx8 = place.x_fx8, y_fx8 = place.y_fx8, base = place.base;
  const V t = place.t;
  const hn::Repartition<std::uint8_t, D> d8;
  const hn::Repartition<std::int16_t, D> d16;
  constexpr int kWhole = 127;  // of the blend: 256 * 127 fits 16 bits
  const VI x = hn::Shr(x_fx8, base), y = hn::Shr(y_fx8, base);
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(d)];
  StoreIndex(WordOffset(di, map, x, y, base), lane_index);

  const auto part_coarse =
      hn::BitCast(d16, LowByteTwice(di, swell::HWY_NAMESPACE::RoundToInt(t * kWhole)));
  const auto part_fine = kWhole - part_coarse;
  const auto weights_y = [&](VI coordinate, auto part) HWY_ATTR {
    return hn::BitCast(di, hn::BitCast(d16, WeightsAlongY(di, coordinate)) * part);
  };
  const VI fine_x = WeightsAlongX(di, x), coarse_x = WeightsAlongX(di, hn::ShiftRight<1>(x));
  const VI fine_y = weights_y(y, part_fine);
  const VI coarse_y = weights_y(hn::ShiftRight<1>(y), part_coarse);
  // Each lane has four sums: fine a, fine b, coarse a, coarse b.
  const auto sums = [&]<int kPart>() HWY_ATTR {
    const auto rows = DotPairs(hn::BitCast(d8, SpreadPart<kPart>(di, fine_x, coarse_x)),
                               LoadBlocks<kPart>(d8, map.words.data(), lane_index));
    return DotWords(SpreadPart<kPart>(di, fine_y, coarse_y), hn::BitCast(di, rows));
  };
  const VI s0 = sums.template operator()<0>(), s1 = sums.template operator()<1>();
  const VI s2 = sums.template operator()<2>(), s3 = sums.template operator()<3>();
  // a and b of lanes 0, 1 (2, 3) of each four.
  const hn::Repartition<std::int64_t, D> d64;
  const auto add_levels = [&](VI even, VI odd) HWY_ATTR {
    const auto e = hn::BitCast(d64, even), o = hn::BitCast(d64, odd);
    return hn::BitCast(di, hn::InterleaveLower(d64, e, o)) +
           hn::BitCast(di, hn::InterleaveUpper(d64, e, o));
  };
  const VI low = add_levels(s0, s1), high = add_levels(s2, s3);
  const V unit = hn::Set(d, gain * map.scale * (1.0f / (255.0f * 256.0f * kWhole)));
  a = MulAdd(hn::ConvertTo(d, EvenParts(di, low, high)), unit, a);
  b = MulAdd(hn::ConvertTo(d, OddParts(di, low, high)), unit, b);
}

// What `map` holds at (x_fx8, y_fx8), as AddBlended, bilinearly on one of its mip levels a lane.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE void SampleLevel(D d, const PackedMap2& map, VI x_fx8, VI y_fx8, VI level, V& a, V& b) {
  const hn::RebindToSigned<D> di;
  const hn::Repartition<std::uint8_t, D> d8;
  const VI x = hn::Shr(x_fx8, level), y = hn::Shr(y_fx8, level);
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(d)];
  StoreIndex(WordOffset(di, map, x, y, level), lane_index);
  const VI weights_x = WeightsAlongX(di, x), weights_y = WeightsAlongY(di, y);
  // Each lane's weights twice: for channel a and for channel b.
  const auto quads0 = LoadWords<1, 0>(d8, map.words.data(), lane_index);
  const auto quads1 = LoadWords<1, 1>(d8, map.words.data(), lane_index);
  const auto rows0 =
      DotPairs(hn::BitCast(d8, hn::InterleaveLower(di, weights_x, weights_x)), quads0);
  const auto rows1 =
      DotPairs(hn::BitCast(d8, hn::InterleaveUpper(di, weights_x, weights_x)), quads1);
  const VI sums0 = DotWords(hn::InterleaveLower(di, weights_y, weights_y), hn::BitCast(di, rows0));
  const VI sums1 = DotWords(hn::InterleaveUpper(di, weights_y, weights_y), hn::BitCast(di, rows1));
  const V unit = hn::Set(d, map.scale * (1.0f / (255.0f * 256.0f)));
  a = hn::ConvertTo(d, EvenParts(di, sums0, sums1)) * unit;
  b = hn::ConvertTo(d, OddParts(di, sums0, sums1)) * unit;
}

// Where a sample lies in the maps of one size: which words it takes, and how much of their taps.
template <class VI>
struct WordPlace {
  VI index, weights_x, weights_y;
};

// The place of (x_fx8, y_fx8), coordinates as AddBlended's, on one mip level a lane.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE WordPlace<VI> PlaceOnLevel(DI di, const PackedMap1& map, VI x_fx8, VI y_fx8, VI level) {
  const VI x = hn::Shr(x_fx8, level), y = hn::Shr(y_fx8, level);
  return {WordIndex(di, map, x, y, level), WeightsAlongX(di, x), WeightsAlongY(di, y)};
}

// What a map holds at a place of maps of its size, bilinearly; in [-1, 1].
template <class D, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE hn::Vec<D> SampleAt(D d, const PackedMap1& map, const WordPlace<VI>& at) {
  const hn::RebindToSigned<D> di;
  const hn::Repartition<std::uint8_t, D> d8;
  // Hardware gathers of 32 bits a lane are as fast as loads.
  const VI taps =
      hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(map.words.data()), at.index);
  const auto rows = DotPairs(hn::BitCast(d8, at.weights_x), hn::BitCast(d8, taps));
  const VI sum = DotWords(at.weights_y, hn::BitCast(di, rows));
  return hn::ConvertTo(d, sum) * (1.0f / (127.0f * 255.0f * 256.0f));
}

// What `map` holds at (x_fx8, y_fx8), on one of its mip levels a lane.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE V SampleLevel(D d, const PackedMap1& map, VI x_fx8, VI y_fx8, VI level) {
  return SampleAt(d, map, PlaceOnLevel(hn::RebindToSigned<D>(), map, x_fx8, y_fx8, level));
}

// Window coordinate to 1/256 texels from the first texel's centre, clamped to [0, last]; NaN counts
// as 0. At most 2^14 texels: 22 bits.
template <Vector V>
HWY_INLINE hn::Vec<hn::RebindToSigned<hn::DFromV<V>>> WindowCoordinateFx8(V x_px, V last) {
  const hn::RebindToSigned<hn::DFromV<V>> di;
  V x = x_px - 0.5f;
  x = IfThenElseZero(x > 0.0f, x);  // false for NaN
  x = IfThenElse(x < last, x, last);
  const V rounded = MulAdd(x, 256.0f, 12582912.0f);
  return hn::BitCast(di, rounded) & ((1 << 22) - 1);
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
  const auto sum =
      hn::BitCast(d16, DotPairs(weights0, taps0)) + hn::BitCast(d16, DotPairs(weights1, taps1));
  return hn::BitCast(d8, sum + 255 * 128);
}

// Four values a lane, of an image's or a map's channels.
template <class V>
struct FourChannels {
  V r, g, b, a;
};

// Which texels of an image are a level of it: from `begin` on, in rows of `stride`.
template <class VI>
struct TexelRows {
  VI begin, stride;
};

// A level's texels, blended at a place a lane.
template <class D, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE FourChannels<hn::Vec<D>> SampleTexels(D d, const RgbaImage& image,
                                                 const TexelRows<VI>& rows, VI x_fx8, VI y_fx8) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const hn::Repartition<std::uint8_t, D> d8;
  const auto weights = BilinearWeights(di, x_fx8, y_fx8);

  // Two texels of each of two rows.
  HWY_ALIGN std::uint32_t upper_index[hn::MaxLanes(d)], lower_index[hn::MaxLanes(d)];
  const VI row = rows.begin + hn::ShiftRight<8>(y_fx8) * rows.stride;
  const VI index = row + hn::ShiftRight<8>(x_fx8);
  StoreIndex(index, upper_index);
  StoreIndex(index + rows.stride, lower_index);
  const std::uint32_t* const texels = image.texels.data();

  // The weights of row 0 (low 16 bits) and row 1 (high 16 bits), each over a whole lane, then
  // widened to words: left, right for each of the four channels.
  const auto low = weights & 0xffff;
  const auto row0 = low | hn::ShiftLeft<16>(low);
  const auto high = hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, weights)));
  const auto row1 = high | hn::ShiftLeft<16>(high);
  const auto sums0 = BlendRows(d8, LoadWords<4, 0>(d8, texels, upper_index),
                               LoadWords<4, 0>(d8, texels, lower_index),
                               hn::BitCast(d8, hn::InterleaveLower(di, row0, row0)),
                               hn::BitCast(d8, hn::InterleaveLower(di, row1, row1)));
  const auto sums1 = BlendRows(d8, LoadWords<4, 1>(d8, texels, upper_index),
                               LoadWords<4, 1>(d8, texels, lower_index),
                               hn::BitCast(d8, hn::InterleaveUpper(di, row0, row0)),
                               hn::BitCast(d8, hn::InterleaveUpper(di, row1, row1)));

  const auto rg = EvenParts(di, sums0, sums1);
  const auto ba = OddParts(di, sums0, sums1);
  const V unit = hn::Set(d, 1.0f / (255.0f * 255.0f));
  const auto low_channel = [&](auto pair)
                               HWY_ATTR { return hn::ConvertTo(d, pair & 0xffff) * unit; };
  const auto high_channel = [&](auto pair) HWY_ATTR {
    const auto shifted = hn::ShiftRight<16>(hn::BitCast(du, pair));
    return hn::ConvertTo(d, hn::BitCast(di, shifted)) * unit;
  };
  return {low_channel(rg), high_channel(rg), low_channel(ba), high_channel(ba)};
}

// Samples `image` bilinearly at the window position (x_px, y_px) [texels of that image; texel
// (x, y)'s centre is (x + 0.5, y + 0.5)], clamped to the image; NaN counts as the first texel's
// centre. Results in [0, 1]. fill_padding() must have been called.
template <class D, class V = hn::Vec<D>>
HWY_INLINE FourChannels<V> SampleRgba(D d, const RgbaImage& image, V x_px, V y_px) {
  const hn::RebindToSigned<D> di;
  using VI = hn::Vec<decltype(di)>;
  const V last_x = hn::Set(d, static_cast<float>(image.width - 1));
  const V last_y = hn::Set(d, static_cast<float>(image.height - 1));
  return SampleTexels(d, image, TexelRows<VI>{hn::Zero(di), hn::Set(di, image.stride)},
                      WindowCoordinateFx8(x_px, last_x), WindowCoordinateFx8(y_px, last_y));
}

// Samples as SampleRgba(), on one of the image's softer levels a lane; positions are of texels of
// level 0.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE FourChannels<V> SampleRgbaLevel(D d, const RgbaImage& image, V x_px, V y_px, VI level) {
  const hn::RebindToSigned<D> di;
  using swell::HWY_NAMESPACE::EntriesOfEight;
  const auto number = [&](const std::array<float, 16>& of_level)
                          HWY_ATTR { return EntriesOfEight(d, of_level.data(), level); };
  const auto integer = [&](const std::array<std::int32_t, 16>& of_level)
                           HWY_ATTR { return EntriesOfEight(di, of_level.data(), level); };
  const V x = x_px * number(image.scale_x), y = y_px * number(image.scale_y);
  const TexelRows<VI> rows{integer(image.level_begin), integer(image.level_stride)};
  return SampleTexels(d, image, rows, WindowCoordinateFx8(x, number(image.last_x)),
                      WindowCoordinateFx8(y, number(image.last_y)));
}

// Samples `map` bilinearly at (x_fx8, y_fx8) [1/256 texels from the first texel's centre], clamped
// to the map; NaN counts as 0. Results in [0, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SampleRgb(D d, const RgbMap& map, V x_fx8, V y_fx8, V& r, V& g, V& b) {
  const hn::RebindToSigned<D> di;
  using VI = hn::Vec<decltype(di)>;
  const hn::Repartition<std::uint8_t, D> d8;
  const V last = hn::Set(d, static_cast<float>(256 * (map.size - 1)));
  const auto whole = [&](V v) HWY_ATTR {
    return swell::HWY_NAMESPACE::RoundToInt(Min(Max(v, 0.0f), last));
  };
  const VI x = whole(x_fx8), y = whole(y_fx8);
  HWY_ALIGN std::uint32_t lane_offset[hn::MaxLanes(d)];
  const VI row =
      hn::ShiftLeftSame(hn::ShiftRight<8>(y), std::countr_zero(static_cast<unsigned>(map.size)));
  StoreIndex(hn::ShiftLeft<4>(row | hn::ShiftRight<8>(x)), lane_offset);

  const VI weights_x = WeightsAlongX(di, x), weights_y = WeightsAlongY(di, y);
  // Each lane has four sums: red, green, blue, 0.
  const auto sums = [&]<int kPart>() HWY_ATTR {
    const auto rows = DotPairs(hn::BitCast(d8, SpreadPart<kPart>(di, weights_x, weights_x)),
                               LoadBlocks<kPart>(d8, map.words.data(), lane_offset));
    return DotWords(SpreadPart<kPart>(di, weights_y, weights_y), hn::BitCast(di, rows));
  };
  const VI s0 = sums.template operator()<0>(), s1 = sums.template operator()<1>();
  const VI s2 = sums.template operator()<2>(), s3 = sums.template operator()<3>();
  const hn::Repartition<std::int64_t, D> d64;
  const auto rg01 = hn::BitCast(d64, hn::InterleaveLower(di, s0, s1));
  const auto rg23 = hn::BitCast(d64, hn::InterleaveLower(di, s2, s3));
  const auto b01 = hn::BitCast(d64, hn::InterleaveUpper(di, s0, s1));
  const auto b23 = hn::BitCast(d64, hn::InterleaveUpper(di, s2, s3));
  const auto channel = [&](auto sum) HWY_ATTR {
    return MulAdd(hn::ConvertTo(d, hn::BitCast(di, sum)), 1.0f / (255.0f * 255.0f * 256.0f),
                  128.0f / 255.0f);
  };
  r = channel(hn::InterleaveLower(d64, rg01, rg23));
  g = channel(hn::InterleaveUpper(d64, rg01, rg23));
  b = channel(hn::InterleaveLower(d64, b01, b23));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
