// Where the shader of a tile leaves what labels want of its surfels.
#if defined(SWELL_RENDER_LABELS_KEEP_LABELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_LABELS_KEEP_LABELS_INL_H_
#undef SWELL_RENDER_LABELS_KEEP_LABELS_INL_H_
#else
#define SWELL_RENDER_LABELS_KEEP_LABELS_INL_H_
#endif

#include "render/labels/shaded_labels.h"
#include "render/tile/surfel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// `at`: where in the tile each lane is. Without labels the compiler leaves their values out.
struct KeepNothing {
  HWY_INLINE void operator()(const std::uint16_t*, const Surfel&) const {}
};

struct KeepLabels {
  ShadedLabels& labels;

  HWY_INLINE void operator()(const std::uint16_t* at, const Surfel& surfel) const {
    const D d;
    const hn::Rebind<std::uint16_t, D> d16;
    const auto store = [&](const auto& put) HWY_ATTR {
      put(surfel.normal.x, labels.normal_x.data());
      put(surfel.normal.y, labels.normal_y.data());
      put(surfel.normal.z, labels.normal_z.data());
      put(surfel.foam_cover, labels.foam_cover.data());
      put(surfel.flags, labels.flags.data());
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
