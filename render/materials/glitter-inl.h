// The sun's glitter, looked up in the picture that the mirrored sun throws on the water.
#if defined(SWELL_RENDER_MATERIALS_GLITTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_GLITTER_INL_H_
#undef SWELL_RENDER_MATERIALS_GLITTER_INL_H_
#else
#define SWELL_RENDER_MATERIALS_GLITTER_INL_H_
#endif

#include "render/materials/glitter.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Radiance per irradiance of water that mirrors all light. T, where the eye's ray meets the slide,
// is moved by the normal, T' = T + Cp N (N: right and away from the eye), and slopes that a pixel
// does not show, whose variance of both axes is given, widen the slide's spot and dim it.
// Source: Ma, Zhu, Gong, 2006; the widening is ours.
HWY_NOINLINE static V ThrownGlitter(const Glitter& glitter, V3 to_eye, V3 normal, V variance) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V ahead = hn::Neg(Dot(to_eye, Constant(glitter.ahead)));
  const V inv_ahead = hn::Div(one, hn::Max(ahead, Constant(0.05f)));
  const glm::vec2 axis(-glitter.right.y, glitter.right.x);  // away from the eye
  const V n_right =
      hn::MulAdd(normal.x, Constant(glitter.right.x), hn::Mul(normal.y, Constant(glitter.right.y)));
  const V n_ahead = hn::MulAdd(normal.x, Constant(axis.x), hn::Mul(normal.y, Constant(axis.y)));
  const V cp = Constant(glitter.per_slope);
  const V x = hn::NegMulAdd(Dot(to_eye, Constant(glitter.right)), inv_ahead, hn::Mul(cp, n_right));
  const V y = hn::NegMulAdd(Dot(to_eye, Constant(glitter.up)), inv_ahead, hn::Mul(cp, n_ahead));

  const float spread = 0.5f * glitter.per_slope * glitter.per_slope;
  const V radius2 = hn::MulAdd(variance, Constant(spread), Constant(glitter.disc_variance));
  const V inv_radius = InverseSqrt(radius2);
  // Most packets look past the slide.
  const V away = hn::Mul(hn::Max(hn::Abs(x), hn::Abs(y)), inv_radius);
  const auto shown = hn::And(hn::Gt(ahead, zero), hn::Lt(away, Constant(SunSlide::kReach)));
  if (hn::AllFalse(D(), shown)) return zero;
  const V per_radius = Constant(0.5f * static_cast<float>(SunSlide::kSize) / SunSlide::kReach);
  const V middle = Constant(0.5f * static_cast<float>(SunSlide::kSize));
  const V scale = hn::Mul(inv_radius, per_radius);
  V root, unused_g, unused_b, unused_a;
  texture::HWY_NAMESPACE::SampleRgba(D(), *glitter.slide, hn::MulAdd(x, scale, middle),
                                     hn::MulAdd(y, scale, middle), root, unused_g, unused_b,
                                     unused_a);
  const V light = hn::Mul(hn::Mul(root, root), Constant(glitter.brightness));
  const V dimmed = hn::Mul(light, hn::Mul(inv_radius, inv_radius));
  return hn::IfThenElseZero(shown, dimmed);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
