// Where the shader of a tile leaves what labels want of its shading results.
#if defined(SWELL_RENDER_SHADE_KEEP_LABELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_KEEP_LABELS_INL_H_
#undef SWELL_RENDER_SHADE_KEEP_LABELS_INL_H_
#else
#define SWELL_RENDER_SHADE_KEEP_LABELS_INL_H_
#endif

#include "render/labels/shaded_labels.h"
#include "render/tile/shading_result-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// `at`: where in the tile each lane is. Without labels the compiler leaves their values out.
struct KeepNothing {
  HWY_INLINE void operator()(const std::uint16_t*, const ShadingResult&) const {}
};

struct KeepLabels {
  ShadedLabels& labels;

  HWY_INLINE void operator()(const std::uint16_t* at, const ShadingResult& result) const {
    const D d;
    const hn::Rebind<std::uint16_t, D> d16;
    const auto store = [&](const auto& put) HWY_ATTR {
      put(result.normal.x, labels.normal_x.data());
      put(result.normal.y, labels.normal_y.data());
      put(result.normal.z, labels.normal_z.data());
      put(result.foam_cover, labels.foam_cover.data());
      put(result.flags, labels.flags.data());
    };
    const auto index = hn::LoadU(d16, at);
    if (hn::AllTrue(d16, index == hn::Iota(d16, at[0]))) {
      store([&](V v, float* to) HWY_ATTR { hn::StoreU(v, d, to + at[0]); });
      return;
    }
    const VI lane_at = hn::PromoteTo(DI(), index);
    store([&](V v, float* to) HWY_ATTR { hn::ScatterIndex(v, d, to, lane_at); });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
