// The map of the clear sky and of the air below the eye (SkyAtHeight).
#if defined(SWELL_RENDER_SKY_SKY_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_SKY_MAP_INL_H_
#undef SWELL_RENDER_SKY_SKY_MAP_INL_H_
#else
#define SWELL_RENDER_SKY_SKY_MAP_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/light.h"
#include "render/sky/sky_maps.h"
#include "texture/smooth_image-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A map as an eye sees it whose horizon has a sine.
struct SkyOfHeight {
  const texture::SmoothImage* map;
  glm::vec2 azimuth;
  float horizon_sine;
};
HWY_INLINE SkyOfHeight SkyOfEye(const Light& light) {
  return {light.sky_map, light.sky_azimuth, light.horizon_sine};
}

// The column of a direction of length 1.
HWY_INLINE V SkyColumn(const SkyOfHeight& sky, V3 direction) {
  const V across2 = MulAdd(direction.x, direction.x, direction.y * direction.y);
  const V along = MulAdd(direction.x, sky.azimuth.x, direction.y * sky.azimuth.y);
  const V cosine = along / Sqrt(Max(across2, 1e-12f));
  const V half_sine2 = NegMulAdd(cosine, 0.5f, 0.5f);
  const V half_sine = Sqrt(Clamp(half_sine2, 0.0f, 1.0f));
  return Sqrt(half_sine) * (kSkyColumns - 1.0f);
}

// The root of 1 - r, where r = tan(zenith angle / 2) for the cosine `part` in [0, 1]: 0 at the
// horizon, 1 at the end.
HWY_INLINE V FromHorizon(V part) {
  const V one = Constant(1.0f), zero = hn::Zero(D());
  const V r = Sqrt((one - part) / (one + part));
  return Sqrt(Max(one - r, zero));
}

HWY_INLINE V3 SampleSky(const SkyOfHeight& sky, V column, V row) {
  V3 radiance;
  texture::HWY_NAMESPACE::SampleSmooth(D(), *sky.map, column, row, radiance.x, radiance.y,
                                       radiance.z);
  return radiance;
}

// The clear sky's radiance in a direction of length 1; below the horizon, that of the horizon.
HWY_INLINE V3 ClearSky(const SkyOfHeight& sky, V3 direction) {
  const float scale = 1.0f / (1.0f - sky.horizon_sine);
  const V part = Clamp((direction.z - sky.horizon_sine) * scale, 0.0f, 1.0f);
  const V row = NegMulAdd(FromHorizon(part), kSkyRows - 1.0f, kSkyRows - 1.0f);
  return SampleSky(sky, SkyColumn(sky, direction), row);
}

// `part` of the way from the horizon to straight down, of a direction of length 1.
HWY_INLINE V PartDown(const Light& light, V z) {
  const float scale = 1.0f / (1.0f + light.horizon_sine);
  return Clamp((light.horizon_sine - z) * scale, 0.0f, 1.0f);
}

// What air below the eye shows where nothing is seen through it.
HWY_INLINE V3 AirBelow(const Light& light, V3 direction, V part_down) {
  const V row = MulAdd(FromHorizon(part_down), kAirRows - 1.0f, 1.0f * kSkyRows);
  const SkyOfHeight sky = SkyOfEye(light);
  return SampleSky(sky, SkyColumn(sky, direction), row);
}

// The blurred sky's radiance in direction (x, y, z), z > -0.5, any length of (x, y, z) equal to
// `length`.
HWY_INLINE V3 SoftSkyRadiance(const texture::RgbMap& map, V3 direction, V length) {
  const D d;
  const float half_fx8 = 128.0f * static_cast<float>(map.size);
  const V scale = half_fx8 / (length + direction.z);
  const V middle = Constant(half_fx8 - 128.0f);
  V r, g, b;
  texture::HWY_NAMESPACE::SampleRgb(d, map, MulAdd(direction.x, scale, middle),
                                    MulAdd(direction.y, scale, middle), r, g, b);
  const V range = Constant(kSoftSkyRange);
  return {r * r * range, g * g * range, b * b * range};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
