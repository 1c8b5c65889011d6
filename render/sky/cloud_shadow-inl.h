// What clouds leave of the sun, for the materials.
#if defined(SWELL_RENDER_SKY_CLOUD_SHADOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUD_SHADOW_INL_H_
#undef SWELL_RENDER_SKY_CLOUD_SHADOW_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUD_SHADOW_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/cloud_shadow.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The shadow at (u, v) in texels of a level, as bytes.
HWY_INLINE V CloudShadowTexel(const std::vector<std::uint32_t>& words, V u, V v) {
  const D d;
  const DI di;
  constexpr float kLast = CloudShadow::kSide - 1;
  const V x = Clamp(u, 0.0f, kLast), y = Clamp(v, 0.0f, kLast);
  const VI i = TruncateToInt(x), j = TruncateToInt(y);
  const V s = x - hn::ConvertTo(d, i), t = y - hn::ConvertTo(d, j);
  static_assert(CloudShadow::kSide == 128);
  const VI word = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(words.data()),
                                  hn::ShiftLeft<7>(j) + i);
  const VI byte = hn::Set(di, 0xff);
  const auto value = [&](VI bits) HWY_ATTR { return hn::ConvertTo(d, bits & byte); };
  return Lerp(Lerp(value(word), value(hn::ShiftRight<8>(word)), s),
              Lerp(value(hn::ShiftRight<16>(word)), value(hn::ShiftRight<24>(word)), s), t);
}

// SunUnderClouds(). share(level, part): what of a level's part may be used.
template <class Share>
HWY_INLINE V SampleCloudShadow(const CloudShadow& shadow, const V3& p, float eye_z,
                               const Share& share) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  constexpr float kMiddle = 0.5f * CloudShadow::kSide, kWhole = 0.42f * CloudShadow::kSide;
  const V z = p.z + eye_z;
  const V x = NegMulAdd(z, shadow.slant.x, p.x);
  const V y = NegMulAdd(z, shadow.slant.y, p.y);
  V sum = zero, left = one;
  for (std::size_t level = 0; level < CloudShadow::kLevels; ++level) {
    const V per_m = Constant(1.0f / CloudShadow::kTexels_m[level]);
    const V u = MulAdd(x, per_m, shadow.eye[level].x);
    const V v = MulAdd(y, per_m, shadow.eye[level].y);
    // Towards its edge a level gives way to the next.
    const V aside = Max(Abs(u - kMiddle), Abs(v - kMiddle));
    const V inside =
        Clamp((kMiddle - 1.0f - aside) * (1.0f / (kMiddle - 1.0f - kWhole)), 0.0f, 1.0f);
    const V part = share(level, inside * left);
    if (!hn::AllFalse(d, part > zero))
      sum = MulAdd(part, CloudShadowTexel(shadow.words[level], u, v), sum);
    left = left - part;
    if (hn::AllFalse(d, left > zero)) break;
  }
  const V visible = MulAdd(sum, shadow.most / 255.0f, left * shadow.mean);
  const V above = z - shadow.lit_from_m;
  if (hn::AllFalse(d, above > zero)) return visible;
  const V over = Clamp(above * (1.0f / (shadow.lit_all_m - shadow.lit_from_m)), 0.0f, 1.0f);
  return Lerp(visible, one, over);
}

// The sun that clouds leave at p, relative to the eye, over what they leave of it on average. A
// function of its own: what it takes would cost the shaders registers.
inline HWY_NOINLINE V SunUnderClouds(const CloudShadow& shadow, const V3& p, float eye_z) {
  return SampleCloudShadow(shadow, p, eye_z, [](std::size_t, V part) HWY_ATTR { return part; });
}

// The sun that clouds leave about a place over the sea's level, over what they leave of it on
// average. It is blurred as widely as places are apart that stand for all between them.
inline HWY_NOINLINE V SunUnderCloudsAbout(const CloudShadow& shadow, const V3& place, V apart_m) {
  return SampleCloudShadow(shadow, place, 0.0f, [&](std::size_t level, V part) HWY_ATTR {
    if (level + 1 == CloudShadow::kLevels) return part;
    constexpr float kNone = 4.0f;  // texels apart: as far as those of the next level
    const V texels = apart_m * (1.0f / CloudShadow::kTexels_m[level]);
    return part * Clamp((kNone - texels) * (1.0f / (kNone - 1.0f)), 0.0f, 1.0f);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
