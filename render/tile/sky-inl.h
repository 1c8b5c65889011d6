// The sky as the eye sees it.
#if defined(SWELL_RENDER_TILE_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SKY_INL_H_
#undef SWELL_RENDER_TILE_SKY_INL_H_
#else
#define SWELL_RENDER_TILE_SKY_INL_H_
#endif

#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE V3 ShadeSky(const Shading& s, V x_px, V y_px) {
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const V length = hn::Sqrt(Dot(ray, ray));
  // Below the horizon (beyond the sea's last triangle) the horizon's colour goes on.
  const V3 clamped = {ray.x, ray.y, hn::Max(ray.z, hn::Zero(D()))};
  const V clamped_length = hn::Sqrt(hn::Max(Dot(clamped, clamped), Constant(1e-12f)));
  const V3 light = SkyRadiance(*s.light.sky_sharp, clamped, clamped_length);
  // The sun's disc: half a degree across, with a soft rim.
  const V cos_sun = hn::Div(Dot(ray, Constant(s.light.sun_direction)), length);
  const V rim = Clamp(
      hn::Mul(hn::Sub(cos_sun, Constant(kCosSunRim)), Constant(1.0f / (kCosSunCore - kCosSunRim))),
      0.0f, 1.0f);
  const V disc = hn::IfThenElseZero(hn::Gt(ray.z, hn::Zero(D())), hn::Mul(rim, Constant(8.0f)));
  return ScaleAdd(Constant(s.light.sun_irradiance), disc, light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
