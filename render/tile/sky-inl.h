// The sky as the eye sees it.
#if defined(SWELL_RENDER_TILE_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SKY_INL_H_
#undef SWELL_RENDER_TILE_SKY_INL_H_
#else
#define SWELL_RENDER_TILE_SKY_INL_H_
#endif

#include "render/materials/clouds-inl.h"
#include "render/tile/packet-inl.h"
#include "texture/smooth_image-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The clear sky's radiance in a direction of length 1 that does not point down.
HWY_INLINE V3 ClearSky(const texture::SmoothImage& map, V3 direction) {
  const V one = Constant(1.0f);
  const V across =
      hn::Sqrt(hn::MulAdd(direction.x, direction.x, hn::Mul(direction.y, direction.y)));
  const V r = hn::Min(hn::Div(across, hn::Add(one, direction.z)), one);
  const V warped = hn::Sub(one, hn::Sqrt(hn::Sub(one, r)));
  const float half = 0.5f * static_cast<float>(map.size);
  const V scale = hn::Div(hn::Mul(warped, Constant(half)), hn::Max(across, Constant(1e-6f)));
  const V middle = Constant(half - 0.5f);
  V3 light;
  texture::HWY_NAMESPACE::SampleSmooth(D(), map, hn::MulAdd(direction.x, scale, middle),
                                       hn::MulAdd(direction.y, scale, middle), light.x, light.y,
                                       light.z);
  return light;
}

// The part of a pixel that the disc of the sun or the moon fills, by the direction's distance from
// its middle; half a degree across.
HWY_INLINE V DiscPart(const Light& light, V3 direction, float pixel_angle) {
  constexpr float kRadius = 0.004654f;
  const V3 to_light = Constant(light.sun_direction);
  const V3 apart = {hn::Sub(direction.x, to_light.x), hn::Sub(direction.y, to_light.y),
                    hn::Sub(direction.z, to_light.z)};
  const float rim = std::max(pixel_angle, 0.02f * kRadius);
  const V inside = hn::Sub(Constant(kRadius), hn::Sqrt(Dot(apart, apart)));
  return Clamp(hn::MulAdd(inside, Constant(1.0f / rim), Constant(0.5f)), 0.0f, 1.0f);
}

HWY_INLINE V3 ShadeSky(const Shading& s, V x_px, V y_px) {
  const D d;
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const V3 direction = Scale(ray, InverseSqrt(Dot(ray, ray)));
  // Below the horizon (beyond the sea's last triangle) the horizon's colour goes on.
  const V3 level = {ray.x, ray.y, hn::Max(ray.z, hn::Zero(d))};
  const V3 above = Scale(level, InverseSqrt(hn::Max(Dot(level, level), Constant(1e-12f))));
  V3 light = ClearSky(*s.light.sky_clear, above);
  V passes = Constant(1.0f);
  if (s.light.clouds.any) {
    const V pixel_angle_log2 = Log2Coarse(d, Constant(s.rays.pixel_angle));
    light = AddClouds(s.light.clouds, above, pixel_angle_log2, light, passes);
  }
  const V disc = DiscPart(s.light, direction, s.rays.pixel_angle);
  const V shown = hn::IfThenElseZero(hn::Gt(ray.z, hn::Zero(d)), hn::Mul(disc, passes));
  return ScaleAdd(Constant(s.light.disc_radiance), shown, light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
