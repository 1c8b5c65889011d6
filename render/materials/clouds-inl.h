// Clouds in the sky.
#if defined(SWELL_RENDER_MATERIALS_CLOUDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CLOUDS_INL_H_
#undef SWELL_RENDER_MATERIALS_CLOUDS_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CLOUDS_INL_H_
#endif

#include "render/materials/clouds.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The direction's ray meets the layer after `slant` metres, at the sine `rise`: a shell about the
// round earth, so that it comes down to the horizon.
struct CloudPlace {
  V x, y, slant, rise;
};

HWY_INLINE CloudPlace PlaceOnClouds(const Clouds& clouds, V3 direction) {
  constexpr float kEarthRadius_m = 6.36e6f;
  const float drop = 2.0f * clouds.height_m / kEarthRadius_m;
  const V z = direction.z;
  const V rise = hn::Sqrt(hn::MulAdd(z, z, Constant(drop)));
  const V slant = hn::Div(Constant(2.0f * clouds.height_m), hn::Add(z, rise));
  return {hn::Mul(direction.x, slant), hn::Mul(direction.y, slant), slant, rise};
}

// Optical depth, and how far the noise falls off towards the light: that side is bright.
struct CloudDepth {
  V depth, bright;
};

HWY_INLINE V CloudLevel(const CloudPlace& at, V pixel_angle_log2) {
  return FootprintLevel(hn::Add(Log2Coarse(D(), at.slant), pixel_angle_log2), at.rise);
}

// threshold: what of the noise over its deviation is cloud.
HWY_INLINE CloudDepth SampleClouds(const Clouds& clouds, const CloudPlace& at, V level,
                                   V threshold) {
  const D d;
  const V zero = hn::Zero(d);
  V noise = zero, side = zero, lost = zero;
  for (const SlopeLayer& layer : clouds.layers)
    AddSlopes(layer, {at.x, at.y, zero}, level, zero, zero, noise, side, lost);
  const V scale = Constant(clouds.inv_deviation);
  const V over = hn::MulSub(noise, scale, threshold);
  // The mean over what a pixel cannot resolve of max(over, 0)^2, about.
  const V spread = hn::Mul(hn::Mul(lost, scale), scale);
  const V root = hn::Sqrt(hn::MulAdd(over, over, hn::Add(spread, spread)));
  const V mean = hn::Mul(hn::Add(over, root), Constant(0.5f));
  return {hn::Mul(hn::Mul(mean, mean), Constant(kCloudDepth)), hn::Mul(side, scale)};
}

// Henyey and Greenstein's phase function for water droplets.
HWY_INLINE V CloudPhase(V cos_theta) {
  constexpr float g = 0.8f;
  const V base = hn::NegMulAdd(cos_theta, Constant(2.0f * g), Constant(1.0f + g * g));
  return hn::Div(Constant((1.0f - g * g) * 0.0795774715f), hn::Mul(base, hn::Sqrt(base)));
}

// Lays the clouds in front of `light`, the clear sky in a direction of length 1. `passes` becomes
// the part of it that they let through.
HWY_INLINE V3 AddClouds(const Clouds& clouds, V3 direction, V pixel_angle_log2, V3 light,
                        V& passes) {
  const D d;
  const V one = Constant(1.0f);
  const CloudPlace at = PlaceOnClouds(clouds, direction);
  const CloudDepth cloud = SampleClouds(clouds, at, CloudLevel(at, pixel_angle_log2),
                                        Constant(clouds.light.threshold));
  passes = Exp(d, hn::Neg(cloud.depth));
  // Far clouds are lost in haze, but for an overcast sky, which is of one piece.
  const V far = Exp(d, hn::Mul(at.slant, Constant(-1.0f / 70000.0f)));
  const V shown = Lerp(far, one, Constant(clouds.light.overcast));
  const V opacity = hn::Mul(hn::Mul(hn::Sub(one, passes), shown), Constant(clouds.shown));

  // Light that comes through, less of it where clouds are thick; and at their bright sides.
  const V through = hn::Div(one, hn::MulAdd(cloud.depth, Constant(clouds.light.loss), one));
  const V bright = Clamp(hn::MulAdd(cloud.bright, Constant(0.5f), one), 0.6f, 1.5f);
  // The zenith of an overcast sky is three times as bright as its horizon.
  // Source: Moon, Spencer, Illumination from a non-uniform sky, 1942.
  const V zenith = hn::MulAdd(hn::Max(direction.z, hn::Zero(d)), Constant(0.86f), Constant(0.43f));
  const V overcast = Lerp(one, zenith, Constant(clouds.light.overcast));
  const V3 base = Scale(Constant(clouds.light.base), hn::Mul(hn::Mul(through, bright), overcast));
  const V forward = hn::Mul(CloudPhase(Dot(direction, Constant(clouds.light.to_light))),
                            Exp(d, hn::Mul(cloud.depth, Constant(-0.6f))));
  const V3 own = ScaleAdd(Constant(clouds.light.forward), forward, base);
  return Lerp(light, own, opacity);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
