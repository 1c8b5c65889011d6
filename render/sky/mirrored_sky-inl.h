// The sky in calm water.
#if defined(SWELL_RENDER_SKY_MIRRORED_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_MIRRORED_SKY_INL_H_
#undef SWELL_RENDER_SKY_MIRRORED_SKY_INL_H_
#else
#define SWELL_RENDER_SKY_MIRRORED_SKY_INL_H_
#endif

#include "render/sky/clouds-inl.h"
#include "render/sky/light.h"
#include "render/sky/sky_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Lays clouds in their shapes before `light`, as wide as slopes of a variance [both axes] spread a
// packet's rays. direction: of length 1, not down.
HWY_INLINE V3 AddMirroredClouds(const CalmMirror& calm, const Packet& packet, V3 direction,
                                V variance, V3 light) {
  const D d;
  // A pixel has grown on its way to the water, too.
  const Clouds& clouds = *calm.clouds;
  const V way = MulAdd(packet.distance * direction.z, 1.0f / clouds.height_m, 1.0f);
  const V pixel = way * calm.pixel_angle;
  // Slopes turn rays to the sides by the sine of their elevation less than up and down;
  // ViewClouds() takes a footprint across the view, and lengthens it by nearly as much.
  const V sine = Max(direction.z, 0.05f);
  const V spread2 = MulAdd(variance * 8.0f, sine * sine, pixel * pixel);
  const CloudView view = ViewClouds(clouds, direction, Log2Coarse(d, spread2) * 0.5f);
  const CloudNoise noise =
      SampleClouds(clouds, view.x + packet.p.x, view.y + packet.p.y, view.level);
  V passes;
  return AddClouds(clouds, view, noise, light, passes);
}

// What a packet mirrors in direction r, of a length: the sky of the sea's level as it is, and more
// and more of `blurred` the more its slopes, of a variance [both axes], spread its rays.
static HWY_NOINLINE V3 MirrorSky(const CalmMirror& calm, const Packet& packet, V3 r, V length,
                                 V variance, V3 blurred) {
  const D d;
  const V sharp = SmoothBlend(NegMulAdd(variance, 1.25f / kCalmVariance, 1.25f));
  if (hn::AllFalse(d, sharp > 0.0f)) return blurred;
  V3 direction = r * (1.0f / length);
  direction.z = Max(direction.z, 0.0f);
  V3 light = ClearSky({calm.sky, calm.azimuth, 0.0f}, direction);
  if (calm.clouds) light = AddMirroredClouds(calm, packet, direction, variance, light);
  return Lerp(blurred, light, sharp);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
