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

// The maximum of a block, and whether the surface in it is smooth (HeightPyramid).
struct Maximum {
  V height;
  M is_smooth;
};

// Heights of a post and of the next one.
struct PostPair {
  V first, second;
};

// The heights of a pyramid.
struct OneTable {
  const HeightPyramid& pyramid;

  const HeightPyramid& Grid() const { return pyramid; }
  HWY_INLINE V HeightOf(V code) const { return MulAdd(code, pyramid.step_m, pyramid.base_m); }
  HWY_INLINE Maximum MaximumAt(VI number) const {
    const VI code = GatherTwoCodes(pyramid.maxima.data(), number) & Whole(0xffff);
    return {HeightOf(ToFloat(code)), hn::RebindMask(D(), (code & Whole(1)) == Whole(0))};
  }
  HWY_INLINE PostPair PostsAt(VI number) const {
    const VI both = GatherTwoCodes(pyramid.posts.data(), number);
    return {HeightOf(LowCode(both)), HeightOf(HighCode(both))};
  }
};

// Heights between those of two pyramids of one size: share 0 is the first, to the bit. The same
// mean of their maxima lies over it.
struct TwoTables {
  OneTable a, b;
  float share;

  const HeightPyramid& Grid() const { return a.pyramid; }
  HWY_INLINE V Between(V from, V to) const { return MulAdd(to - from, share, from); }
  HWY_INLINE Maximum MaximumAt(VI number) const {
    const Maximum from = a.MaximumAt(number), to = b.MaximumAt(number);
    return {Between(from.height, to.height), from.is_smooth & to.is_smooth};
  }
  HWY_INLINE PostPair PostsAt(VI number) const {
    const PostPair from = a.PostsAt(number), to = b.PostsAt(number);
    return {Between(from.first, to.first), Between(from.second, to.second)};
  }
};

// The highest of the blocks that hold [x_low, x_high] x [y_low, y_high], in cells, of the finest
// level that has four such at most.
template <class Heights>
HWY_INLINE V HighestOver(const Heights& heights, V x_low, V x_high, V y_low, V y_high) {
  const HeightPyramid& p = heights.Grid();
  const VI level = LevelOf(Max(x_high - x_low, y_high - y_low), 1, p.levels);
  const VI blocks_log2 = Whole(p.levels) - level;
  const VI blocks = hn::Shl(Whole(1), blocks_log2);
  const auto block = [&](V at) HWY_ATTR {
    const VI cell = hn::ConvertTo(DI(), Clamp(at, 0.0f, static_cast<float>(p.side - 1)));
    return hn::Shr(cell, level);
  };
  const VI i0 = block(x_low), i1 = block(x_high), j0 = block(y_low), j1 = block(y_high);
  const auto at = [&](VI i, VI j) HWY_ATTR {
    return heights.MaximumAt(hn::Shl(blocks + j, blocks_log2) + i).height;
  };
  return Max(Max(at(i0, j0), at(i1, j0)), Max(at(i0, j1), at(i1, j1)));
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
