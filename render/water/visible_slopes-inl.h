// Which slopes of rough water an eye near the surface sees: those turned to it, as much as they
// are.
#if defined(SWELL_RENDER_WATER_VISIBLE_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_VISIBLE_SLOPES_INL_H_
#undef SWELL_RENDER_WATER_VISIBLE_SLOPES_INL_H_
#else
#define SWELL_RENDER_WATER_VISIBLE_SLOPES_INL_H_
#endif

#include <cmath>

#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The cosine to the eye of facets that are seen where slopes of this variance (both axes together)
// add to facets of cosine c: facets count by the area that they turn to the eye, so that the mean
// of normal slopes of deviation sigma on level water, E[x^2; x > 0] / E[x; x > 0], is
// c + sigma^2 / c from above and 1.25 sigma seen edge-on. Rises with c and is never negative; for
// c = 0 to 0.5 and sigma to 0.2 within 0.045.
HWY_INLINE V SeenCosine(V c, V variance) {
  const V root = Sqrt(MulAdd(variance, 2.4f, c * c));
  return (c + root) * 0.5f;
}

// The area that such facets turn to the eye, over the level's: the mean of the positive part of a
// normal distribution. Within 0.01 sigma.
HWY_INLINE V SeenArea(V c, V variance) {
  const V inv_root = InverseSqrt(variance);
  const V far = Abs(c) * inv_root * (1.41421356f / 2.4f);
  const V near = Max(1.0f - far, 0.0f);
  const V edge_on = variance * inv_root * 0.282094792f;
  return MulAdd(near * near * near, edge_on, Max(c, 0.0f));
}

// The cosine of a slope that is drawn but hides nothing, as it is finer than triangles: it is drawn
// as the slope that takes its place among those seen. Back sides, which would mirror the sea
// between their brighter edges, so become faces seen at a low angle. Slopes of variance_all add to
// level_cosine, of which the part `drawn` is drawn here: in the mean these rise by their part of
// what all those seen do, and they deviate from it the less the more of them are hidden: where all
// are drawn and seen edge-on, by 0.655 of what they are. Nothing changes where none is drawn.
HWY_INLINE V UnhiddenCosine(V c, V level_cosine, V variance_all, V drawn) {
  const V raised = drawn * (SeenCosine(level_cosine, variance_all) - level_cosine);
  const V inv_deviation = InverseSqrt(variance_all) * 1.41421356f;
  const V lost = raised * inv_deviation * 0.276f;
  return c + NegMulAdd(c - level_cosine, Min(lost, 1.0f), raised);
}

// The cosine whose mirrored ray is as high as the mean one of slopes too fine for a pixel. Higher
// facets are tilted less: SeenCosine() less what their normals' length takes.
HWY_INLINE V MirroringCosine(V c, V variance) {
  const V raised = SeenCosine(c, variance) - c;
  return MulAdd(raised, 1.0f - c, c);
}

// The cosine that is reflected as much as what such facets reflect in the mean: by Fresnel's
// formula for water within 0.05.
HWY_INLINE V ReflectingCosine(V c, V variance) {
  const V raised = SeenCosine(c, variance) - c;
  const V away = 1.0f - c;
  return MulAdd(raised * away, away, c);
}

// Tilts a unit normal n whose cosine to the eye v is below e' to n + (e' - n.v) v, scaled to
// length 1, and returns its cosine. e' = e / sqrt(1 - e^2) makes the cosine e at least; normals
// over e' stay as they are. 0 < e < 1. Source: Gabdrakhmanov, Modelling Interactive Water
// Surfaces (back sides of waves).
HWY_INLINE V TiltToEye(const V3& to_eye, float least_cos, V3& normal) {
  const V least = Constant(least_cos / std::sqrt(1.0f - least_cos * least_cos));
  const V cosine = Dot(normal, to_eye);
  const V raise = Max(least - cosine, 0.0f);
  const V3 tilted = MulAdd(to_eye, raise, normal);
  const V length = Sqrt(Dot(tilted, tilted));
  const V inv_length = 1.0f / length;
  const auto is_tilted = raise > 0.0f;
  normal = {IfThenElse(is_tilted, tilted.x * inv_length, normal.x),
            IfThenElse(is_tilted, tilted.y * inv_length, normal.y),
            IfThenElse(is_tilted, tilted.z * inv_length, normal.z)};
  return IfThenElse(is_tilted, (cosine + raise) * inv_length, cosine);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
