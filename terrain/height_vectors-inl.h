// Vectors of rays and beams over heights, for their kernels.
#if defined(SWELL_TERRAIN_HEIGHT_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TERRAIN_HEIGHT_VECTORS_INL_H_
#undef SWELL_TERRAIN_HEIGHT_VECTORS_INL_H_
#else
#define SWELL_TERRAIN_HEIGHT_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "math/lanes-inl.h"
#include "terrain/height_pyramid.h"

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

HWY_INLINE VI Whole(int value) { return hn::Set(DI(), value); }
HWY_INLINE V ToFloat(VI value) { return hn::ConvertTo(D(), value); }
HWY_INLINE VI IfI(M mask, VI yes, VI no) { return IfThenElse(hn::RebindMask(DI(), mask), yes, no); }
HWY_INLINE VI MaskedI(M mask, VI value) {
  return IfThenElseZero(hn::RebindMask(DI(), mask), value);
}

// As many values from the first on as there are, at most a packet; 0 in lanes beyond.
HWY_INLINE V LoadSome(std::span<const float> values, std::size_t first) {
  if (values.size() - first >= kLanes) return hn::LoadU(D(), values.data() + first);
  HWY_ALIGN float lane[kLanes] = {};
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(first), values.end(), lane);
  return hn::Load(D(), lane);
}

// The other way round.
HWY_INLINE void StoreSome(V values, std::size_t first, std::span<float> to) {
  if (to.size() - first >= kLanes) return hn::StoreU(values, D(), to.data() + first);
  HWY_ALIGN float lane[kLanes];
  hn::Store(values, D(), lane);
  std::copy_n(lane, to.size() - first, to.data() + first);
}

// The place that rays come from, in cells: a whole one and what is left, which floats hold exactly
// enough.
struct Axis {
  int whole;
  float part, cells;  // of the place; of the grid

  Axis(double from_m, double spacing_m, int samples)
      : whole(static_cast<int>(std::floor(std::clamp(from_m / spacing_m, -1e9, 1e9)))),
        part(static_cast<float>(std::clamp(from_m / spacing_m, -1e9, 1e9) - whole)),
        cells(static_cast<float>(samples - 1)) {}
};

// Returns the level of blocks 2^(more - 1) to 2^more times as wide as this many cells, and 2^more
// cells at least; `levels` at most.
HWY_INLINE VI LevelOf(V cells, int more, int levels) {
  const V some = Min(Max(cells, 1.0f), 32768.0f);
  // A float's exponent is its logarithm.
  const VI log2 = hn::ShiftRight<23>(hn::BitCast(DI(), some)) - Whole(127);
  return Min(log2 + Whole(more), Whole(levels));
}

// The codes at these numbers of an array that has one more, with the next ones in the high halves.
HWY_INLINE VI GatherTwoCodes(const std::uint16_t* codes, VI number) {
  return hn::GatherOffset(DI(), reinterpret_cast<const std::int32_t*>(codes),
                          hn::ShiftLeft<1>(number));
}
HWY_INLINE V LowCode(VI both) { return ToFloat(both & Whole(0xffff)); }
HWY_INLINE V HighCode(VI both) {
  const hn::RebindToUnsigned<D> du;
  return ToFloat(hn::BitCast(DI(), hn::ShiftRight<16>(hn::BitCast(du, both))));
}
HWY_INLINE V GatherCodes(const std::uint16_t* codes, VI number) {
  return LowCode(GatherTwoCodes(codes, number));
}

// A ray's height over t.
struct RayHeights {
  V z, z_t, z_tt;

  HWY_INLINE V At(V t) const { return MulAdd(MulAdd(z_tt, t, z_t), t, z); }
  // No higher than the ray between t and end.
  HWY_INLINE V LowestIn(V t, V end) const {
    const V way = end - t;
    const V sag = Max(z_tt, 0.0f) * 0.25f * (way * way);
    return Min(At(t), At(end)) - sag;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
