// What rivers and lakes lie on, from above their water and from within.
#if defined(SWELL_RENDER_MATERIALS_RIVER_BED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_RIVER_BED_INL_H_
#undef SWELL_RENDER_MATERIALS_RIVER_BED_INL_H_
#else
#define SWELL_RENDER_MATERIALS_RIVER_BED_INL_H_
#endif

#include "render/materials/ground-inl.h"
#include "render/materials/river.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The level over the sea's up to which there is some of the sea floor's sand in a bed [m].
constexpr float kGravelBegin_m = 1.2f;

// The bed's reflectance: wet gravel further up, the sea's floor where a river comes down to it.
HWY_INLINE V3 FindBed(const River& river, V3 p, V height_m, V level_m) {
  const D d;
  V x = hn::Zero(d), y = hn::Zero(d), unused = hn::Zero(d);
  AddSlopes(river.stones, p, level_m, {x, y}, x, y, unused);
  const V sandy = SmoothBlend((kGravelBegin_m - height_m) * (1.0f / kGravelBegin_m));
  const V relief = NegMulAdd(sandy, 0.31f * 0.7f, 0.31f);
  const V stones = Clamp(MulAdd(x, relief, 1.0f), 0.45f, 1.6f);
  V3 bed = Constant(river.gravel);
  const auto some = sandy > 0.0f;
  if (river.ground.map.texels && !hn::AllFalse(d, some)) {
    const V3 floor = FindAlbedo(river.ground, OnMap(river.ground, p), p);
    const auto join = [&](V gravel, V sand)
                          HWY_ATTR { return IfThenElse(some, Lerp(gravel, sand, sandy), gravel); };
    bed = {join(bed.x, floor.x), join(bed.y, floor.y), join(bed.z, floor.z)};
  }
  return bed * stones;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
