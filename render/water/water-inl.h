// The water material: its surface from above or from below, as the eye is.
#if defined(SWELL_RENDER_WATER_WATER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_WATER_INL_H_
#undef SWELL_RENDER_WATER_WATER_INL_H_
#else
#define SWELL_RENDER_WATER_WATER_INL_H_
#endif

#include "render/water/topside-inl.h"
#include "render/water/underside-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Water far from any coast is spared the coast's code.
template <ViewKind kView, class Use>
HWY_INLINE void WithShader(const Water& water, const Use& use) {
  if constexpr (shows(kView, Water::kSurface)) {
    if (water.submerged)
      use(UndersideShader{water});
    else if (water.knows_land())
      use(WaterShader<true>{water});
    else
      use(WaterShader<false>{water});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
