// Vectors of rays and of squares for forms' kernels.
#if defined(SWELL_RENDER_VIEW_FORM_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_VIEW_FORM_VECTORS_INL_H_
#undef SWELL_RENDER_VIEW_FORM_VECTORS_INL_H_
#else
#define SWELL_RENDER_VIEW_FORM_VECTORS_INL_H_
#endif

#include "render/tile/packet-inl.h"
#include "render/view/form_rays.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using DU = hn::RebindToUnsigned<D>;
using M = hn::Mask<D>;

// A p.
HWY_INLINE V3 Times(const RayQuadric& f, V3 p) {
  const V xy = Constant(f.xy), xz = Constant(f.xz), yz = Constant(f.yz);
  return {hn::MulAdd(Constant(f.xx), p.x, hn::MulAdd(xy, p.y, hn::Mul(xz, p.z))),
          hn::MulAdd(xy, p.x, hn::MulAdd(Constant(f.yy), p.y, hn::Mul(yz, p.z))),
          hn::MulAdd(xz, p.x, hn::MulAdd(yz, p.y, hn::Mul(Constant(f.zz), p.z)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
