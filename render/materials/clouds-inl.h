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

// The clouds' noise, how far it falls off towards the light, and the variance that pixels cannot
// resolve.
struct CloudNoise {
  V noise, side, lost;
};

HWY_INLINE CloudNoise SampleClouds(const Clouds& clouds, V x, V y, V level) {
  const V zero = hn::Zero(D());
  CloudNoise found = {zero, zero, zero};
  for (const SlopeLayer& layer : clouds.layers)
    AddSlopes(layer, {x, y, zero}, level, zero, zero, found.noise, found.side, found.lost);
  return found;
}

HWY_INLINE V OpticalDepth(const Clouds& clouds, const CloudNoise& at) {
  const V scale = Constant(clouds.inv_deviation);
  const V over = hn::MulSub(at.noise, scale, Constant(clouds.light.threshold));
  // The mean over what a pixel cannot resolve of max(over, 0)^2, about.
  const V spread = hn::Mul(hn::Mul(at.lost, scale), scale);
  const V root = hn::Sqrt(hn::MulAdd(over, over, hn::Add(spread, spread)));
  const V mean = hn::Mul(hn::Add(over, root), Constant(0.5f));
  return hn::Mul(hn::Mul(mean, mean), Constant(kCloudDepth));
}

// Henyey and Greenstein's phase function for water droplets.
HWY_INLINE V CloudPhase(V cos_theta) {
  constexpr float g = 0.8f;
  const V base = hn::NegMulAdd(cos_theta, Constant(2.0f * g), Constant(1.0f + g * g));
  return hn::Div(Constant((1.0f - g * g) * 0.0795774715f), hn::Mul(base, hn::Sqrt(base)));
}

// What of the clouds' view changes slowly with the direction, which has length 1.
struct CloudView {
  V x, y, level;  // the place on the layer, and the footprint there
  V shown;        // not lost in haze
  V forward;      // scattered on, of the light
  V overcast;     // brightness of a closed layer against its mean
};

HWY_INLINE CloudView ViewClouds(const Clouds& clouds, V3 direction, V pixel_angle_log2) {
  const D d;
  const V one = Constant(1.0f);
  const CloudPlace at = PlaceOnClouds(clouds, direction);
  // Far clouds are lost in haze, but for an overcast sky, which is of one piece.
  const V far = Exp(d, hn::Mul(at.slant, Constant(-1.0f / 70000.0f)));
  // The zenith of an overcast sky is three times as bright as its horizon.
  // Source: Moon, Spencer, Illumination from a non-uniform sky, 1942.
  const V zenith = hn::MulAdd(hn::Max(direction.z, hn::Zero(d)), Constant(0.86f), Constant(0.43f));
  return {at.x,
          at.y,
          FootprintLevel(hn::Add(Log2Coarse(d, at.slant), pixel_angle_log2), at.rise),
          hn::Mul(Lerp(far, one, Constant(clouds.light.overcast)), Constant(clouds.shown)),
          CloudPhase(Dot(direction, Constant(clouds.light.to_light))),
          Lerp(one, zenith, Constant(clouds.light.overcast))};
}

// Lays the clouds in front of `light`, the clear sky there. `passes` becomes the part of it that
// they let through.
HWY_INLINE V3 AddClouds(const Clouds& clouds, const CloudView& view, const CloudNoise& at, V3 light,
                        V& passes) {
  const D d;
  const V one = Constant(1.0f);
  const V depth = OpticalDepth(clouds, at);
  passes = Exp(d, hn::Neg(depth));
  const V opacity = hn::Mul(hn::Sub(one, passes), view.shown);

  // Light that comes through, less of it where clouds are thick; and at their bright sides.
  const V through = hn::Div(one, hn::MulAdd(depth, Constant(clouds.light.loss), one));
  const V bright =
      Clamp(hn::MulAdd(at.side, Constant(0.5f * clouds.inv_deviation), one), 0.6f, 1.5f);
  const V3 base =
      Scale(Constant(clouds.light.base), hn::Mul(hn::Mul(through, bright), view.overcast));
  const V forward = hn::Mul(view.forward, Exp(d, hn::Mul(depth, Constant(-0.6f))));
  const V3 own = ScaleAdd(Constant(clouds.light.forward), forward, base);
  return Lerp(light, own, opacity);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
