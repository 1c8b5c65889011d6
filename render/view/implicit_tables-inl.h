// Tables of heights in the kernels of implicit surfaces.
#if defined(SWELL_RENDER_VIEW_IMPLICIT_TABLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_VIEW_IMPLICIT_TABLES_INL_H_
#undef SWELL_RENDER_VIEW_IMPLICIT_TABLES_INL_H_
#else
#define SWELL_RENDER_VIEW_IMPLICIT_TABLES_INL_H_
#endif

#include "math/lanes-inl.h"
#include "render/view/implicit_rays.h"
#include "terrain/height_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;
namespace heights = terrain::HWY_NAMESPACE;

HWY_INLINE V3 Turned(const glm::mat3& m, V3 v) {
  return {MulAdd(m[0].x, v.x, MulAdd(m[1].x, v.y, m[2].x * v.z)),
          MulAdd(m[0].y, v.x, MulAdd(m[1].y, v.y, m[2].y * v.z)),
          MulAdd(m[0].z, v.x, MulAdd(m[1].z, v.y, m[2].z * v.z))};
}

// A point from the part's middle, as (u, v, z) of the table.
HWY_INLINE V3 InTable(const RayTable& table, V3 p) {
  return Turned(table.linear, p) + Constant(table.at);
}

// Calls use(heights) with those of the table at its time.
template <class Use>
HWY_INLINE auto WithHeights(const RayTable& table, const Use& use) {
  const heights::OneTable now{*table.now};
  if (table.share == 0.0f) return use(now);
  return use(heights::TwoTables{now, {*table.next}, table.share});
}

// Bilinear: the height, and what it grows by for a post along u and along v.
struct HeightAndSlope {
  V height, along_u, along_v;
};

template <class Heights>
HWY_INLINE HeightAndSlope HeightsAt(const Heights& of, V u, V v) {
  const terrain::Grid& grid = of.Grid().grid;
  const auto last = static_cast<float>(grid.samples_x - 1);
  const V x = Clamp(u, 0.0f, last), y = Clamp(v, 0.0f, last);
  const V i = Min(Floor(x), last - 1.0f), j = Min(Floor(y), last - 1.0f);
  const DI di;
  const VI first = hn::ConvertTo(di, j) * hn::Set(di, grid.samples_x) + hn::ConvertTo(di, i);
  const heights::PostPair low = of.PostsAt(first), high = of.PostsAt(first + grid.samples_x);
  const V s = x - i, t = y - j;
  const V along_low = low.second - low.first, along_high = high.second - high.first;
  const V at_low = MulAdd(s, along_low, low.first), at_high = MulAdd(s, along_high, high.first);
  return {Lerp(at_low, at_high, t), Lerp(along_low, along_high, t), at_high - at_low};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
