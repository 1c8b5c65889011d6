// Sampler of CoverMap on Highway vectors, as packed_map-inl.h's.
#if defined(SWELL_TEXTURE_COVER_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TEXTURE_COVER_MAP_INL_H_
#undef SWELL_TEXTURE_COVER_MAP_INL_H_
#else
#define SWELL_TEXTURE_COVER_MAP_INL_H_
#endif

#include "texture/cover_map.h"
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {

// The four channels of `map` at (x_fx8, y_fx8) [1/256 texels of level 0; the map repeats],
// bilinearly on one of its mip levels a lane. Results in [0, 1].
template <class D, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE FourChannels<hn::Vec<D>> SampleCover(D d, const CoverMap& map, VI x_fx8, VI y_fx8,
                                                VI level) {
  const hn::RebindToSigned<D> di;
  const hn::Repartition<std::uint8_t, D> d8;
  const hn::Repartition<std::int64_t, D> d64;
  const VI x = hn::Shr(x_fx8, level), y = hn::Shr(y_fx8, level);
  HWY_ALIGN std::uint32_t lane_offset[hn::MaxLanes(d)];
  StoreIndex(hn::ShiftLeft<4>(WordIndex(di, map, x, y, level)), lane_offset);
  const VI weights_x = WeightsAlongX(di, x), weights_y = WeightsAlongY(di, y);
  // Each lane has four sums, one a channel.
  const auto sums = [&]<int kPart>() HWY_ATTR {
    const auto rows = DotPairs(hn::BitCast(d8, SpreadPart<kPart>(di, weights_x, weights_x)),
                               LoadBlocks<kPart>(d8, map.words.data(), lane_offset));
    return hn::BitCast(
        d64, DotWords(SpreadPart<kPart>(di, weights_y, weights_y), hn::BitCast(di, rows)));
  };
  const auto s0 = sums.template operator()<0>(), s1 = sums.template operator()<1>();
  const auto s2 = sums.template operator()<2>(), s3 = sums.template operator()<3>();
  const VI rg01 = hn::BitCast(di, hn::InterleaveLower(d64, s0, s1));
  const VI ba01 = hn::BitCast(di, hn::InterleaveUpper(d64, s0, s1));
  const VI rg23 = hn::BitCast(di, hn::InterleaveLower(d64, s2, s3));
  const VI ba23 = hn::BitCast(di, hn::InterleaveUpper(d64, s2, s3));
  const auto channel = [&](VI sum) HWY_ATTR {
    return MulAdd(hn::ConvertTo(d, sum), 1.0f / (254.0f * 255.0f * 256.0f), 0.5f);
  };
  return {channel(EvenParts(di, rg01, rg23)), channel(OddParts(di, rg01, rg23)),
          channel(EvenParts(di, ba01, ba23)), channel(OddParts(di, ba01, ba23))};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
