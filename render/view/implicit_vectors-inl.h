// Vectors of rays and of squares for implicit surfaces' kernels.
#if defined(SWELL_RENDER_VIEW_IMPLICIT_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_VIEW_IMPLICIT_VECTORS_INL_H_
#undef SWELL_RENDER_VIEW_IMPLICIT_VECTORS_INL_H_
#else
#define SWELL_RENDER_VIEW_IMPLICIT_VECTORS_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/view/implicit_rays.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A p.
HWY_INLINE V3 Times(const RayQuadric& f, V3 p) {
  const V xy = Constant(f.xy), xz = Constant(f.xz), yz = Constant(f.yz);
  return {MulAdd(f.xx, p.x, MulAdd(xy, p.y, xz * p.z)),
          MulAdd(xy, p.x, MulAdd(f.yy, p.y, yz * p.z)),
          MulAdd(xz, p.x, MulAdd(yz, p.y, f.zz * p.z))};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
