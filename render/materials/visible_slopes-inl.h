// Which slopes of rough water an eye near the surface sees: those turned to it, as much as they
// are.
#if defined(SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#undef SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#else
#define SWELL_RENDER_MATERIALS_VISIBLE_SLOPES_INL_H_
#endif

#include <cmath>

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

// The area that such facets turn to the eye, over the level's: the mean of the positive part of a
// normal distribution. Within 0.01 sigma.
HWY_INLINE V SeenArea(V c, V variance) {
  const V inv_root = InverseSqrt(variance);
  const V far = hn::Mul(hn::Mul(hn::Abs(c), inv_root), Constant(1.41421356f / 2.4f));
  const V near = hn::Max(hn::Sub(Constant(1.0f), far), hn::Zero(D()));
  const V edge_on = hn::Mul(hn::Mul(variance, inv_root), Constant(0.282094792f));
  return hn::MulAdd(hn::Mul(hn::Mul(near, near), near), edge_on, hn::Max(c, hn::Zero(D())));
}

// The cosine of a slope that is drawn but hides nothing, as it is finer than triangles: it is drawn
// as the slope that takes its place among those seen. Back sides, which would mirror the sea
// between their brighter edges, so become faces seen at a low angle. Slopes of variance_all add to
// level_cosine, of which the part `drawn` is drawn here: in the mean these rise by their part of
// what all those seen do, and they deviate from it the less the more of them are hidden: where all
// are drawn and seen edge-on, by 0.655 of what they are. Nothing changes where none is drawn.
HWY_INLINE V UnhiddenCosine(V c, V level_cosine, V variance_all, V drawn) {
  const V raised = hn::Mul(drawn, hn::Sub(SeenCosine(level_cosine, variance_all), level_cosine));
  const V inv_deviation = hn::Mul(InverseSqrt(variance_all), Constant(1.41421356f));
  const V lost = hn::Mul(hn::Mul(raised, inv_deviation), Constant(0.276f));
  return hn::Add(c, hn::NegMulAdd(hn::Sub(c, level_cosine), hn::Min(lost, Constant(1.0f)), raised));
}

// The cosine whose mirrored ray is as high as the mean one of slopes too fine for a pixel. Higher
// facets are tilted less: SeenCosine() less what their normals' length takes.
HWY_INLINE V MirroringCosine(V c, V variance) {
  const V raised = hn::Sub(SeenCosine(c, variance), c);
  return hn::MulAdd(raised, hn::Sub(Constant(1.0f), c), c);
}

// The cosine that is reflected as much as what such facets reflect in the mean: by Fresnel's
// formula for water within 0.05.
HWY_INLINE V ReflectingCosine(V c, V variance) {
  const V raised = hn::Sub(SeenCosine(c, variance), c);
  const V away = hn::Sub(Constant(1.0f), c);
  return hn::MulAdd(hn::Mul(raised, away), away, c);
}

// Tilts a unit normal n whose cosine to the eye v is below e' to n + (e' - n.v) v, scaled to
// length 1, and returns its cosine. e' = e / sqrt(1 - e^2) makes the cosine e at least; normals
// over e' stay as they are. 0 < e < 1. Source: Gabdrakhmanov, Modelling of Interactive Water
// Surfaces (back sides of waves).
HWY_INLINE V TiltToEye(const V3& to_eye, float least_cos, V3& normal) {
  const V least = Constant(least_cos / std::sqrt(1.0f - least_cos * least_cos));
  const V cosine = Dot(normal, to_eye);
  const V raise = hn::Max(hn::Sub(least, cosine), hn::Zero(D()));
  const V3 tilted = ScaleAdd(to_eye, raise, normal);
  const V length = hn::Sqrt(Dot(tilted, tilted));
  const V inv_length = hn::Div(Constant(1.0f), length);
  const auto is_tilted = hn::Gt(raise, hn::Zero(D()));
  normal = {hn::IfThenElse(is_tilted, hn::Mul(tilted.x, inv_length), normal.x),
            hn::IfThenElse(is_tilted, hn::Mul(tilted.y, inv_length), normal.y),
            hn::IfThenElse(is_tilted, hn::Mul(tilted.z, inv_length), normal.z)};
  return hn::IfThenElse(is_tilted, hn::Mul(hn::Add(cosine, raise), inv_length), cosine);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
