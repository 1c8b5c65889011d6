// What water does to light on its way.
#if defined(SWELL_RENDER_TILE_THROUGH_WATER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_THROUGH_WATER_INL_H_
#undef SWELL_RENDER_TILE_THROUGH_WATER_INL_H_
#else
#define SWELL_RENDER_TILE_THROUGH_WATER_INL_H_
#endif

#include <algorithm>

#include "render/packets/packet-inl.h"
#include "render/sky/light.h"
#include "render/view/surfaces.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// paper_depth_ratio() of the angle whose cosine in air this is, at least 0.02; the angle is right
// to 7e-5. Source: Abramowitz, Stegun, Handbook of Mathematical Functions, 1964, 4.4.45.
HWY_INLINE V PaperDepthRatio(V cosine) {
  V acos = MulAdd(cosine, -0.0187293f, 0.0742610f);
  acos = MulAdd(cosine, acos, -0.2121144f);
  acos = MulAdd(cosine, acos, 1.5707288f);
  const V rest = Max(1.0f - cosine, 0.0f);
  const V angle = acos * Sqrt(rest);
  const V steep = NegMulAdd(angle, 0.16f, 0.75f);
  const V flat = NegMulAdd(angle, 0.8f, 1.26f);
  return IfThenElse(angle <= 0.8f, steep, flat);
}

// Light's way through water to something at a depth.
struct WaterPath {
  V depth;   // true, of a thing that is seen at the apparent one [m]
  V length;  // down from the sun and up to the surface [m]
};

HWY_INLINE WaterPath PathThroughWater(const Media& media, const Packet& packet, V apparent) {
  const V cos_eye = Max(packet.to_eye.z, 0.02f);
  const float inv_n = 1.0f / media.refraction_index;
  // cos of the refracted ray; apparent depth / true depth k = (1/n) cos / cos_t.
  const V sin_t = Sqrt(Max(NegMulAdd(cos_eye, cos_eye, 1.0f), 0.0f)) * inv_n;
  const V cos_t = Sqrt(NegMulAdd(sin_t, sin_t, 1.0f));
  const V depth = media.paper_refraction ? apparent / PaperDepthRatio(cos_eye)
                                         : apparent * (cos_t * media.refraction_index / cos_eye);
  const V path_up = Min(depth / cos_t, 200.0f);
  return {depth, MulAdd(depth, kDaylightSlant, path_up)};  // sunlight comes down at a slant
}

// Light is lost on its way, and that of the water's body takes its place (Beer-Lambert).
HWY_INLINE V3 AbsorbInWater(const Media& media, const WaterPath& path, const V3& body, V3 light) {
  const D d;
  const glm::vec3 absorption = media.absorption_per_m;
  const auto lost = [&](float per_m, V scattered, V seen) {
    const V through = Exp(d, path.length * -per_m);
    return Lerp(scattered, seen, through);
  };
  return {lost(absorption.x, body.x, light.x), lost(absorption.y, body.y, light.y),
          lost(absorption.z, body.z, light.z)};
}

// Whether what a view shows lies in water.
template <ViewKind kView>
HWY_INLINE bool ShowsWaterSide(const Media& media) {
  return (kView == ViewKind::kRefraction) != media.submerged;
}

// (1 - e^-x) / x, given e^-x.
HWY_INLINE V LossOver(V x, V e) {
  const V one = Constant(1.0f);
  const V exact = (one - e) / x;
  // Near 0 the difference has no digits left.
  V series = NegMulAdd(x, 1.0f / 24.0f, 1.0f / 6.0f);
  series = NegMulAdd(NegMulAdd(x, series, 0.5f), x, one);
  return IfThenElse(Abs(x) < 0.03f, series, exact);
}

// A straight way through water, from a depth at which the part `daylight` is left of the light that
// enters.
struct WaterWay {
  V length;  // [m], over 0
  V deeper;  // by how much it ends deeper than it begins [m]
};

// Light at the end of a way, where it is lit by what of `light` comes down so far, as it arrives at
// the way's beginning; in between water takes some away and scatters daylight to the eye. A light
// that depth has not dimmed (the surface's) is that of a way that ends at depth 0.
// With z the depth, s the length, c lost a metre and K of daylight: light e^(-c s - K z_end) +
// scattered c Int_0^s e^(-c t - K z(t)) dt.
// `shafts` is how much of that is scattered against the mean.
HWY_INLINE V3 ThroughWater(const Media& media, glm::vec3 daylight, const WaterWay& way, V3 light,
                           V shafts = Constant(1.0f)) {
  const D d;
  const auto along = [&](int channel, V seen) HWY_ATTR {
    const float c = media.absorption_per_m[channel];
    const V lost = way.length * c;
    const V x = MulAdd(way.deeper, media.daylight_lost_per_m[channel], lost);
    // Daylight makes up for e^60: from where it cannot, nothing is seen.
    const V passes = Exp(d, Clamp(-x, -80.0f, 60.0f));
    const V scattered = lost * LossOver(x, passes) * (shafts * media.scattered[channel]);
    return MulAdd(seen, passes, scattered) * daylight[channel];
  };
  return {along(0, light.x), along(1, light.y), along(2, light.z)};
}

// What a way without end shows, from a depth on, that goes down by w >= 0 a metre.
HWY_INLINE V3 EndlessWater(const Media& media, glm::vec3 daylight, V w) {
  const auto along = [&](int channel) HWY_ATTR {
    const float c = media.absorption_per_m[channel];
    const V lost = MulAdd(w, media.daylight_lost_per_m[channel], std::max(c, 1e-9f));
    return c * media.scattered[channel] * daylight[channel] / lost;
  };
  return {along(0), along(1), along(2)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
