// Foam of one patch's waves.
#if defined(SWELL_RENDER_WATER_FOAM_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_FOAM_MAP_INL_H_
#undef SWELL_RENDER_WATER_FOAM_MAP_INL_H_
#else
#define SWELL_RENDER_WATER_FOAM_MAP_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sea/foam_blocks.h"
#include "render/water/whitecaps.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Levels of the map at which foam begins to be its mean, and is.
constexpr float kFirstFoamLost = 3.0f, kAllFoamLost = 5.0f;

// How much of the foam's place in the map is lost in pixels of that size, in [0, 1].
template <class Layer>
HWY_INLINE V FoamLost(const Layer& foam, V level_m) {
  const V past_first = level_m + (foam.log2_texels_per_m - kFirstFoamLost);
  return Clamp(past_first * (1.0f / (kAllFoamLost - kFirstFoamLost)), 0.0f, 1.0f);
}

HWY_INLINE VI NearestFoamLevel(const FoamMap& foam, V level_m) {
  return TruncateToInt(Clamp(level_m + (foam.log2_texels_per_m + 0.5f), 0.0f, kAllFoamLost));
}

// Whether the blocks around places on these levels have foam, in any lane.
HWY_INLINE bool AnyFoamNear(const FoamBlocks& blocks, VI x_fx8, VI y_fx8, VI level) {
  const DI di;
  const VI row = hn::ShiftRight<12>(y_fx8) & (FoamBlocks::kRows - 1);
  const auto* const rows = reinterpret_cast<const std::int32_t*>(blocks.row.data());
  VI bits;
  if constexpr (kLanes < 8) {
    bits = hn::GatherIndex(di, rows, row);
  } else {
    constexpr int kAtOnce = static_cast<int>(kLanes);  // rows of a table in a vector
    const auto in_table = hn::IndicesFromVec(di, row & (kAtOnce - 1));
    const auto bits_of = [&](int first) HWY_ATTR {
      return hn::TableLookupLanes(hn::LoadU(di, rows + first), in_table);
    };
    bits = bits_of(0);
    if constexpr (kAtOnce < FoamBlocks::kRows)
      bits = IfThenElse(row > kAtOnce - 1, bits_of(kAtOnce), bits);
  }
  const VI column = hn::ShiftRight<11>(x_fx8) & (FoamBlocks::kColumns - 1);
  const VI bit = hn::Shr(bits, column) & 1;
  const VI coarse = Max(level - FoamBlocks::kFinest, hn::Zero(di));
  return !hn::AllTrue(di, (bit | coarse) == hn::Zero(di));
}

HWY_INLINE V FoamAt(const FoamMap& foam, VI x_fx8, VI y_fx8, VI level) {
  const V half = Constant(0.5f);
  // What a sample finds where there is none.
  V code = Constant(-127.0f * 255.0f * 256.0f) * Constant(1.0f / (127.0f * 255.0f * 256.0f));
  if (!foam.blocks || AnyFoamNear(*foam.blocks, x_fx8, y_fx8, level))
    code = texture::HWY_NAMESPACE::SampleLevel(D(), *foam.map, x_fx8, y_fx8, level);
  return MulAdd(code, half, half);
}

// The mean to the bit where all is lost, whatever the lanes beside show.
HWY_INLINE V BlendFoam(const FoamMap& foam, V found, V lost) {
  const V mean = Constant(foam.mean);
  return IfThenElse(lost >= 1.0f, mean, Lerp(found, mean, lost));
}

// The foam of a map that repeats.
HWY_INLINE V FoamOfMap(const FoamMap& foam, V3 p, V level_m) {
  const V lost = FoamLost(foam, level_m);
  if (hn::AllTrue(D(), lost >= 1.0f)) return Constant(foam.mean);
  const LayerPlace place = PlaceIn(foam, p.x, p.y);
  const V found = FoamAt(foam, RoundToInt(place.x_fx8), RoundToInt(place.y_fx8),
                         NearestFoamLevel(foam, level_m));
  return BlendFoam(foam, found, lost);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
