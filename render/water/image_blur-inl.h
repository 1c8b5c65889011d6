// How soft water shows its planar maps: slopes finer than a pixel spread what it looks up.
#if defined(SWELL_RENDER_WATER_IMAGE_BLUR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_IMAGE_BLUR_INL_H_
#undef SWELL_RENDER_WATER_IMAGE_BLUR_INL_H_
#else
#define SWELL_RENDER_WATER_IMAGE_BLUR_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/water/water.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Between which levels of an image lookups lie.
struct BlurLevel {
  VI base;
  V t;            // from level `base` to the next
  bool is_sharp;  // level 0 in every lane
};

HWY_INLINE BlurLevel Sharp() { return {hn::Zero(DI()), hn::Zero(D()), true}; }

// For lookups that slopes of this variance (of both axes together) spread: each moves them up or
// down by the root of px2_per_slope2 [px of the window] times itself. A sample of level l is spread
// by 2^l / 2 texels (its block, and the blend between blocks).
HWY_INLINE BlurLevel FindBlur(const PlanarMap& map, V variance, V px2_per_slope2) {
  const int last = map.image->levels - 1;
  if (last == 0) return Sharp();
  const V unseen = variance - kGlassVariance;
  const V spread2 = unseen * px2_per_slope2 * (2.0f * map.scale_y * map.scale_y);
  // No less than on level 0, which is 1 here.
  const auto blurred = spread2 > 1.0f;
  if (hn::AllFalse(D(), blurred)) return Sharp();
  const V level = Min(Log2Coarse(D(), Max(spread2, 1.0f)) * 0.5f, static_cast<float>(last));
  const VI base = TruncateToInt(Max(level, 0.0f));
  return {base, level - hn::ConvertTo(D(), base), false};
}

// An image's codes and alpha at a place in its texels.
HWY_INLINE texture::HWY_NAMESPACE::FourChannels<V> SampleBlurred(const texture::RgbaImage& image,
                                                                 V x, V y, const BlurLevel& level) {
  using texture::HWY_NAMESPACE::SampleRgba;
  using texture::HWY_NAMESPACE::SampleRgbaLevel;
  const D d;
  if (level.is_sharp) return SampleRgba(d, image, x, y);
  const auto code = SampleRgbaLevel(d, image, x, y, level.base);
  // On the softest level, as a rule.
  if (hn::AllTrue(d, level.t == hn::Zero(d))) return code;
  const VI next = Min(level.base + 1, hn::Set(DI(), image.levels - 1));
  const auto softer = SampleRgbaLevel(d, image, x, y, next);
  return {Lerp(code.r, softer.r, level.t), Lerp(code.g, softer.g, level.t),
          Lerp(code.b, softer.b, level.t), Lerp(code.a, softer.a, level.t)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
