// The sun's glitter, looked up in the picture that the mirrored sun throws on the water.
#if defined(SWELL_RENDER_WATER_GLITTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_GLITTER_INL_H_
#undef SWELL_RENDER_WATER_GLITTER_INL_H_
#else
#define SWELL_RENDER_WATER_GLITTER_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/water/glitter.h"
#include "render/world/sun_texture.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Radiance per irradiance of water that mirrors all light. T, where the eye's ray meets the
// texture, is moved by the normal, T' = T + Cp N (N: right and away from the eye), and slopes that
// a pixel does not show, whose variance of both axes is given, widen the texture's spot and dim it.
// Source: Ma, Zhu, Gong, 2006; the widening is ours.
HWY_NOINLINE static V ProjectedGlitter(const Glitter& glitter, V3 to_eye, V3 normal, V variance) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V ahead = -Dot(to_eye, Constant(glitter.ahead));
  const V inv_ahead = one / Max(ahead, 0.05f);
  const glm::vec2 axis(-glitter.right.y, glitter.right.x);  // away from the eye
  const V n_right = MulAdd(normal.x, glitter.right.x, normal.y * glitter.right.y);
  const V n_ahead = MulAdd(normal.x, axis.x, normal.y * axis.y);
  const V cp = Constant(glitter.per_slope);
  const V x = NegMulAdd(Dot(to_eye, Constant(glitter.right)), inv_ahead, cp * n_right);
  const V y = NegMulAdd(Dot(to_eye, Constant(glitter.up)), inv_ahead, cp * n_ahead);

  const float spread = 0.5f * glitter.per_slope * glitter.per_slope;
  const V radius2 = MulAdd(variance, spread, glitter.disc_variance);
  const V inv_radius = InverseSqrt(radius2);
  // Most packets look past the texture.
  const V away = Max(Abs(x), Abs(y)) * inv_radius;
  const auto shown = (ahead > zero) & (away < SunTexture::kReach);
  if (hn::AllFalse(D(), shown)) return zero;
  const V per_radius = Constant(0.5f * static_cast<float>(SunTexture::kSize) / SunTexture::kReach);
  const V middle = Constant(0.5f * static_cast<float>(SunTexture::kSize));
  const V scale = inv_radius * per_radius;
  const V root = texture::HWY_NAMESPACE::SampleRgba(
                     D(), *glitter.sun_texture, MulAdd(x, scale, middle), MulAdd(y, scale, middle))
                     .r;
  const V light = root * root * glitter.brightness;
  const V dimmed = light * (inv_radius * inv_radius);
  return IfThenElseZero(shown, dimmed);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
