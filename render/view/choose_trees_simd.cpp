#include <algorithm>
#include <cstdint>

#include "render/view/choose_trees.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/view/choose_trees_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr std::uint32_t kLanes = static_cast<std::uint32_t>(hn::MaxLanes(D()));
static_assert(kLanes <= kTreeLanes);

// Middles of trees, relative to the eye.
struct Middles {
  V x, y, z;
};

// Where the view shows any of the balls, where a round earth puts them.
HWY_INLINE Mask InView(const TreeSight& sight, const Middles& at, V radius_m) {
  const D d;
  V z = at.z;
  if (sight.is_mirrored) z = hn::Sub(hn::Set(d, 2.0f * sight.mirror_rel_m), z);
  const V far2 = hn::Add(hn::Mul(at.x, at.x), hn::Mul(at.y, at.y));
  z = hn::Sub(z, hn::Mul(far2, hn::Set(d, sight.drop_per_m2)));
  const V least = hn::Mul(radius_m, hn::Set(d, -1.02f));
  Mask inside = hn::Eq(z, z);
  for (const glm::vec4& plane : sight.planes) {
    const V along = hn::Add(hn::Mul(at.x, hn::Set(d, plane.x)), hn::Mul(at.y, hn::Set(d, plane.y)));
    const V above = hn::Add(hn::Mul(z, hn::Set(d, plane.z)), hn::Set(d, plane.w));
    inside = hn::And(inside, hn::Ge(hn::Add(along, above), least));
  }
  return inside;
}

HWY_INLINE Mask IsDrawn(const TreeColumns& trees, std::uint32_t i, const TreeSight& sight) {
  const D d;
  const V half = hn::Set(d, 0.5f);
  const V height_m = hn::LoadU(d, &trees.height_m[i]);
  const V half_m = hn::Mul(half, height_m);
  const V z_m = hn::Add(hn::LoadU(d, &trees.z_m[i]), half_m);
  const Middles at = {hn::Add(hn::LoadU(d, &trees.x_m[i]), hn::Set(d, sight.origin_rel.x)),
                      hn::Add(hn::LoadU(d, &trees.y_m[i]), hn::Set(d, sight.origin_rel.y)),
                      hn::Add(z_m, hn::Set(d, sight.origin_rel.z))};
  const V across = hn::Add(hn::Mul(at.x, at.x), hn::Mul(at.y, at.y));
  const V far_m = hn::Sqrt(hn::Add(across, hn::Mul(at.z, at.z)));
  const V height_px =
      hn::Div(hn::Mul(height_m, hn::Set(d, sight.px)), hn::Max(far_m, hn::Set(d, 0.1f)));
  const V part = hn::Min(hn::Div(height_px, hn::LoadU(d, &trees.thinned_px[i])), hn::Set(d, 1.0f));
  const Mask kept = hn::And(hn::Gt(height_px, hn::Set(d, kLastTree_px)),
                            hn::Lt(hn::LoadU(d, &trees.rank[i]), hn::Mul(part, part)));
  if (sight.shows_all || hn::AllFalse(d, kept)) return kept;
  return hn::And(kept, InView(sight, at, hn::Add(half_m, hn::LoadU(d, &trees.radius_m[i]))));
}

std::uint32_t ChooseTrees(const TreeColumns& trees, std::uint32_t first, std::uint32_t count,
                          const TreeSight& sight, std::uint32_t* chosen) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  std::uint32_t found = 0;
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const Mask drawn =
        hn::And(IsDrawn(trees, first + i, sight), hn::FirstN(d, std::min(count - i, kLanes)));
    found += static_cast<std::uint32_t>(hn::CompressBlendedStore(
        hn::Iota(du, first + i), hn::RebindMask(du, drawn), du, chosen + found));
  }
  return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(ChooseTrees);

std::uint32_t choose_trees(const TreeColumns& trees, std::uint32_t first, std::uint32_t count,
                           const TreeSight& sight, std::uint32_t* chosen) {
  return HWY_DYNAMIC_DISPATCH(ChooseTrees)(trees, first, count, sight, chosen);
}

}  // namespace swell::render
#endif  // HWY_ONCE
