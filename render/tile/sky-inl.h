// The sky as the eye sees it.
#if defined(SWELL_RENDER_TILE_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SKY_INL_H_
#undef SWELL_RENDER_TILE_SKY_INL_H_
#else
#define SWELL_RENDER_TILE_SKY_INL_H_
#endif

#include "render/materials/clouds-inl.h"
#include "render/tile/cloud_deck-inl.h"
#include "render/tile/packet-inl.h"
#include "render/tile/sky_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The part of a pixel that the disc of the sun or the moon fills, by the direction's distance from
// its middle; half a degree across.
HWY_INLINE V DiscPart(const Light& light, V3 direction, float pixel_angle) {
  constexpr float kRadius = 0.004654f;
  const V3 to_disc = Constant(light.to_disc);
  const V3 apart = Difference(direction, to_disc);
  const float rim = std::max(pixel_angle, 0.02f * kRadius);
  const V inside = hn::Sub(Constant(kRadius), hn::Sqrt(Dot(apart, apart)));
  return Clamp(hn::MulAdd(inside, Constant(1.0f / rim), Constant(0.5f)), 0.0f, 1.0f);
}

HWY_INLINE V3 ShadeSky(const Shading& s, V x_px, V y_px) {
  const D d;
  const V horizon = Constant(s.light.horizon_sine);
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const V3 direction = Scale(ray, InverseSqrt(Dot(ray, ray)));
  V3 light = ClearSky(s.light, direction);
  V passes = Constant(1.0f);
  if (s.light.clouds.any && !s.light.clouds.is_below) {
    const V pixel_angle_log2 = Log2Coarse(d, Constant(s.rays.pixel_angle));
    // Below the horizon (beyond the sea's last triangle) the horizon's clouds go on.
    const V3 above = {direction.x, direction.y, hn::Max(direction.z, horizon)};
    light = AddClouds(s.light.clouds, above, pixel_angle_log2, light, passes);
  }
  const V disc = DiscPart(s.light, direction, s.rays.pixel_angle);
  const V shown = hn::IfThenElseZero(hn::Gt(direction.z, horizon), hn::Mul(disc, passes));
  light = ScaleAdd(Constant(s.light.disc_radiance), shown, light);
  if (!s.light.clouds.is_below) return light;
  return AddCloudDeck(s, direction, Constant(kNothingNear_m), light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
