// Which slopes of rough water an eye near the surface sees: those turned to it, as much as they
// are.
#if defined(SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#undef SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#else
#define SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#endif

#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The cosine to the eye of facets that are seen where slopes of this variance (both axes together)
// add to facets of cosine c: facets count by the area that they turn to the eye, so that the mean
// of normal slopes of deviation sigma on level water, E[x^2; x > 0] / E[x; x > 0], is
// c + sigma^2 / c from above and 1.25 sigma seen edge-on. Rises with c and is never negative; for
// c = 0 to 0.5 and sigma to 0.2 within 0.045.
HWY_INLINE V SeenCosine(V c, V variance) {
  const V root = hn::Sqrt(hn::MulAdd(variance, Constant(2.4f), hn::Mul(c, c)));
  return hn::Mul(hn::Add(c, root), Constant(0.5f));
}

// The same of slopes that are drawn but hide nothing, as they are finer than triangles: each is
// drawn as the slope that takes its place among those seen. Their back sides, which would mirror
// the sea between their brighter edges, so become faces seen at a low angle. Without such slopes
// nothing changes.
HWY_INLINE V UnhiddenCosine(V c, V drawn_variance) {
  const V variance = hn::Max(drawn_variance, hn::Zero(D()));
  const V part = hn::Min(hn::Mul(variance, Constant(5000.0f)), Constant(1.0f));
  return Lerp(c, SeenCosine(c, variance), part);
}

// The cosine whose mirrored ray is as high as the mean one of slopes too fine for a pixel. Higher
// facets are tilted less: SeenCosine() less what their normals' length takes.
HWY_INLINE V MirroringCosine(V c, V variance) {
  const V raised = hn::Sub(SeenCosine(c, variance), c);
  return hn::MulAdd(raised, hn::Sub(Constant(1.0f), c), c);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
