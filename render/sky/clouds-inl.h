// Clouds in the sky.
#if defined(SWELL_RENDER_SKY_CLOUDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUDS_INL_H_
#undef SWELL_RENDER_SKY_CLOUDS_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUDS_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/clouds.h"
#include "sky/air.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The direction's ray meets the layer after `slant` metres, at the sine `rise`: a shell about the
// round earth, so that it comes down to the horizon.
struct CloudPlace {
  V x, y, slant, rise;
};

HWY_INLINE CloudPlace PlaceOnClouds(const Clouds& clouds, V3 direction) {
  constexpr auto kRadius_m = static_cast<float>(sky::kEarthRadius_m);
  const float drop = 2.0f * clouds.height_m / kRadius_m;
  const V z = direction.z;
  const V rise = Sqrt(MulAdd(z, z, drop));
  const V slant = 2.0f * clouds.height_m / (z + rise);
  return {direction.x * slant, direction.y * slant, slant, rise};
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
    AddSlopes(layer, {x, y, zero}, level, {zero, zero}, found.noise, found.side, found.lost);
  return found;
}

HWY_INLINE V OpticalDepth(const Clouds& clouds, const CloudNoise& at) {
  const V scale = Constant(clouds.inv_deviation);
  const V over = MulSub(at.noise, scale, clouds.light.threshold);
  // The mean over what a pixel cannot resolve of max(over, 0)^2, about.
  const V spread = at.lost * scale * scale;
  const V root = Sqrt(MulAdd(over, over, spread + spread));
  const V mean = (over + root) * 0.5f;
  return mean * mean * kCloudDepth;
}

// Henyey and Greenstein's phase function for water droplets.
HWY_INLINE V CloudPhase(V cos_theta) {
  constexpr float g = 0.8f;
  const V base = NegMulAdd(cos_theta, 2.0f * g, 1.0f + g * g);
  return (1.0f - g * g) * 0.0795774715f / (base * Sqrt(base));
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
  const V far = Exp(d, at.slant * (-1.0f / 70000.0f));
  // The zenith of an overcast sky is three times as bright as its horizon.
  // Source: Moon, Spencer, Illumination from a non-uniform sky, 1942.
  const V zenith = MulAdd(Max(direction.z, 0.0f), 0.86f, 0.43f);
  return {at.x,
          at.y,
          FootprintLevel(Log2Coarse(d, at.slant) + pixel_angle_log2, at.rise),
          Lerp(far, one, Constant(clouds.light.overcast)) * clouds.shown,
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
  passes = Exp(d, -depth);
  const V opacity = (one - passes) * view.shown;

  // Light that comes through, less of it where clouds are thick; and at their bright sides.
  const V through = one / MulAdd(depth, clouds.light.loss, one);
  const V bright = Clamp(MulAdd(at.side, 0.5f * clouds.inv_deviation, one), 0.6f, 1.5f);
  const V3 base = Constant(clouds.light.base) * (through * bright * view.overcast);
  const V forward = view.forward * Exp(d, depth * -0.6f);
  const V3 own = MulAdd(Constant(clouds.light.forward), forward, base);
  return Lerp(light, own, opacity);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
