#include <algorithm>
#include <cstdint>

#include "render/view/choose_trees.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/view/choose_trees_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

static_assert(kLanes <= kTreeLanes);

// Middles of trees, relative to the eye.
struct Middles {
  V x, y, z;
};

// Where the view shows any of the balls, where a round earth puts them.
HWY_INLINE M InView(const TreeSight& sight, const Middles& at, V radius_m) {
  V z = at.z;
  if (sight.is_mirrored) z = 2.0f * sight.mirror_rel_m - z;
  const V far2 = at.x * at.x + at.y * at.y;
  z = z - far2 * sight.drop_per_m2;
  const V least = radius_m * -1.02f;
  M inside = z == z;
  for (const glm::vec4& plane : sight.planes) {
    const V along = at.x * plane.x + at.y * plane.y;
    const V above = z * plane.z + plane.w;
    inside = inside & (along + above >= least);
  }
  return inside;
}

HWY_INLINE M IsDrawn(const TreeColumns& trees, std::uint32_t i, const TreeSight& sight) {
  const D d;
  const V half = hn::Set(d, 0.5f);
  const V height_m = hn::LoadU(d, &trees.height_m[i]);
  const V half_m = half * height_m;
  const V z_m = hn::LoadU(d, &trees.z_m[i]) + half_m;
  const Middles at = {hn::LoadU(d, &trees.x_m[i]) + sight.origin_rel.x,
                      hn::LoadU(d, &trees.y_m[i]) + sight.origin_rel.y, z_m + sight.origin_rel.z};
  const V across = at.x * at.x + at.y * at.y;
  const V far_m = Sqrt(across + at.z * at.z);
  const V height_px = height_m * sight.px / Max(far_m, 0.1f);
  const V part = Min(height_px / hn::LoadU(d, &trees.thinned_px[i]), 1.0f);
  const M kept = (height_px > kLastTree_px) & (hn::LoadU(d, &trees.rank[i]) < part * part);
  if (sight.shows_all || hn::AllFalse(d, kept)) return kept;
  return kept & InView(sight, at, half_m + hn::LoadU(d, &trees.radius_m[i]));
}

std::uint32_t ChooseTrees(const TreeColumns& trees, std::uint32_t first, std::uint32_t count,
                          const TreeSight& sight, std::uint32_t* chosen) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  std::uint32_t found = 0;
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const M drawn = IsDrawn(trees, first + i, sight) &
                    hn::FirstN(d, std::min(count - i, std::uint32_t{kLanes}));
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
