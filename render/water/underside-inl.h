// The water's surface from below: Snell's window with the world above bent into it, and the mirror
// of total reflection around it.
#if defined(SWELL_RENDER_WATER_UNDERSIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_UNDERSIDE_INL_H_
#undef SWELL_RENDER_WATER_UNDERSIDE_INL_H_
#else
#define SWELL_RENDER_WATER_UNDERSIDE_INL_H_
#endif

#include "render/sky/fog-inl.h"
#include "render/tile/sky-inl.h"
#include "render/tile/through_water-inl.h"
#include "render/water/topside-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The surface's slopes. It is sampled as from above, along the same lines: with the way to the eye
// turned round.
HWY_NOINLINE static void SampleUnderside(const Water& water, const ViewRays& rays,
                                         std::span<const Packet> shown, WaterSlopes* found) {
  PerPacket<Packet> turned;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    turned[k] = shown[k];
    turned[k].to_eye = -shown[k].to_eye;
  }
  const std::span<const Packet> packets(turned.data(), shown.size());
  if (water.knows_land())
    SampleWater<true>(water, rays, packets, found);
  else
    SampleWater<false>(water, rays, packets, found);
}

// How a ray in water, which goes up along -to_eye, leaves the surface.
struct FromBelow {
  V3 normal;    // up
  V cos_water;  // of the ray to the normal
  V cos_air;    // of the bent ray, and of its spread; 0 where all of it is mirrored
  V3 bent;      // direction in air, of length 1
  V3 mirrored;  // direction in water
  V reflectance;
  V spread;  // of the bent ray, by the slopes that a pixel does not show: as a sine
};

// Slopes that a pixel does not show spread the square of cos_air: its mean, as if it were spread
// evenly and nothing below 0 counted.
HWY_INLINE V MeanOverZero(V middle, V half_width) {
  const V zero = hn::Zero(D());
  const V inside = Max(Min(middle, half_width) + half_width, zero);
  return MulAdd(inside * inside, 0.25f / half_width, Max(middle - half_width, zero));
}

HWY_INLINE FromBelow LeaveWater(const Media& media, V3 ray, const WaterSlopes& s) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const float n = media.refraction_index;
  FromBelow f;
  f.normal = NormalOf(s.slope_x, s.slope_y);
  f.cos_water = Min(Max(Dot(f.normal, ray), kMinCos), one);
  const V sin2_water = NegMulAdd(f.cos_water, f.cos_water, one);
  const V cos2_air = NegMulAdd(sin2_water, n * n, one);
  // The slopes' standard deviation along the ray turns cos_water by sigma sin_water.
  const V sigma = Sqrt(s.variance * 0.5f);
  const V turn = sigma * Sqrt(sin2_water);
  const V width = MulAdd(f.cos_water * turn, 2.0f * 1.732f * n * n, 1e-6f);
  const V mean = MeanOverZero(cos2_air, width);
  f.cos_air = Sqrt(mean);
  f.reflectance = IfThenElse(mean > zero, FresnelReflectance(D(), f.cos_air, n), one);
  const V along = NegMulAdd(f.cos_water, n, f.cos_air);
  const V3 bent = MulAdd(f.normal, along, ray * n);
  f.bent = bent * InverseSqrt(Dot(bent, bent));
  f.mirrored = MulAdd(f.normal, f.cos_water * -2.0f, ray);
  f.spread = sigma * (n - 1.0f);
  return f;
}

// Where the window shows a direction, in pixels.
struct WindowPlace {
  V x_px, y_px;
};

HWY_INLINE WindowPlace PlaceInWindow(const ViewRays& rays, V3 direction) {
  const glm::vec3 right = rays.ray_dx / glm::dot(rays.ray_dx, rays.ray_dx);
  const glm::vec3 down = rays.ray_dy / glm::dot(rays.ray_dy, rays.ray_dy);
  const float x = glm::dot(rays.ray, right), y = glm::dot(rays.ray, down);
  const glm::vec3 ahead = rays.ray - x * rays.ray_dx - y * rays.ray_dy;
  const V inverse = 1.0f / Max(Dot(direction, Constant(ahead)), 0.05f);
  return {MulSub(Dot(direction, Constant(right)), inverse, x),
          MulSub(Dot(direction, Constant(down)), inverse, y)};
}

// Where a face of a wide picture shows a ray that is turned by a share of the way to a direction,
// both of length 1: by the same angle on both sides of a seam, where pixels lie another way. The
// bound is as wide as so many pixels where the face's axis is, and as the square of the cosine to
// the axis elsewhere, as pixels are; less a twentieth, as tangents grow.
HWY_INLINE WindowPlace PlaceOfTurned(const ViewRays& rays, float max_turn, V3 ray, V3 direction,
                                     float share) {
  const glm::vec3 axis = glm::normalize(glm::cross(rays.ray_dx, rays.ray_dy));
  const V cosine = Dot(ray, Constant(axis));
  const V bound = cosine * cosine * (0.95f * max_turn);
  const V3 turn = (direction - ray) * share;
  const V part = bound * InverseSqrt(Max(Dot(turn, turn), 1e-12f));
  return PlaceInWindow(rays, MulAdd(turn, Min(part, 1.0f), ray));
}

// Looks a planar map up in a direction of the eye: where a flat surface would bend or mirror the
// ray as the waves do, for things far beyond it. Nearer ones move by less. Slopes of this variance,
// which turn the direction by `turn` times as much, spread what is seen.
HWY_INLINE Looked LookUpTowards(const Shading& s, const Water& water, const PlanarMap& map,
                                const Packet& packet, V3 direction, V variance, float turn) {
  constexpr float kShare = 0.6f;
  const float px = kShare * turn / s.rays.pixel_angle;
  const BlurLevel level = FindBlur(map, variance, Constant(px * px));
  if (water.images.max_turn > 0.0f) {
    const WindowPlace at =
        PlaceOfTurned(s.rays, water.images.max_turn, -packet.to_eye, direction, kShare);
    return LookUpAt(map, at.x_px + 0.5f, at.y_px + 0.5f, level);
  }
  const float bound = water.images.max_distortion_px;
  const WindowPlace at = PlaceInWindow(s.rays, direction);
  const auto moved = [&](V from, V to) HWY_ATTR {
    const V by = Clamp((to - from) * kShare, -bound, bound);
    return from + (by + 0.5f);
  };
  return LookUpAt(map, moved(packet.x_px, at.x_px), moved(packet.y_px, at.y_px), level);
}

// The sky in a bent ray's direction, the sea where waves turn the ray down, and in front of both
// what the refraction image shows.
HWY_INLINE V3 LightFromAir(const Shading& s, const Water& water, const Packet& packet,
                           const FromBelow& f, V variance, bool use_image, V& image_alpha) {
  const D d;
  const V zero = hn::Zero(d);
  const V3 level = {f.bent.x, f.bent.y, Max(f.bent.z, zero)};
  const V3 up = level * InverseSqrt(Max(Dot(level, level), 1e-12f));
  V3 light = ClearSky(SkyOfEye(s.light), up);
  if (s.light.clouds.any) {
    const V angle = Max(f.spread, s.rays.pixel_angle);
    const CloudView clouds = ViewClouds(s.light.clouds, up, Log2Coarse(d, angle));
    const CloudNoise noise = SampleClouds(s.light.clouds, clouds.x, clouds.y, clouds.level);
    V passes;
    light = AddClouds(s.light.clouds, clouds, noise, light, passes);
  }
  if (s.media.fog.on) light = SkyThroughFog(s.media.fog, s.media.fog.at_sea, up, light);
  const V softness = MulAdd(f.spread, 2.0f, 0.02f);
  const V sea = SmoothBlend(-f.bent.z / softness);
  light = Lerp(light, Constant(water.optics.mirrored_sea), sea);
  image_alpha = zero;
  if (!use_image) return light;
  const float inv_n = 1.0f / s.media.refraction_index;
  const V x = f.bent.x * inv_n, y = f.bent.y * inv_n;
  const V z = Sqrt(Max(NegMulAdd(x, x, NegMulAdd(y, y, 1.0f)), 1e-6f));
  const Looked image =
      LookUpTowards(s, water, water.images.refraction, packet, {x, y, z}, variance, 1.0f - inv_n);
  image_alpha = image.alpha;
  return Lerp(light, image.light, image_alpha);
}

// Light that the surface mirrors down: the water's, and in front of it what the reflection image
// shows.
HWY_INLINE V3 LightFromWater(const Shading& s, const Water& water, const Packet& packet,
                             const FromBelow& f, V variance, bool use_image, V& image_alpha) {
  const V down = -f.mirrored.z;
  const V3 deep = EndlessWater(s.media, glm::vec3(1.0f), Max(down, 0.0f));
  image_alpha = hn::Zero(D());
  if (!use_image) return deep;
  const V3 image_of = {f.mirrored.x, f.mirrored.y, down};
  const Looked image =
      LookUpTowards(s, water, water.images.reflection, packet, image_of, variance, 2.0f);
  image_alpha = image.alpha;
  return Lerp(deep, image.light, image_alpha);
}

// The sun through the slopes that a pixel does not show, as radiance per irradiance, in basic
// radiance (over n^2): both the sun's disc and a Gaussian distribution of slopes spread it. 0 where
// that leaves less than any picture shows.
// Source: Walter, Marschner, Li, Torrance, Microfacet Models for Refraction through Rough Surfaces,
// 2007, equation 21, without its shadowing term.
HWY_INLINE V SunThrough(glm::vec3 sun_direction, float n, V3 ray, const WaterSlopes& s,
                        const FromBelow& f) {
  // The disc covers as much as slopes of this variance, both axes together: the bent ray turns by
  // about n - 1 of a slope.
  const float disc = kDiscRadius / std::max(n - 1.0f, 1e-3f), disc_variance = 0.5f * disc * disc;
  const V3 sun = Constant(sun_direction);
  const V3 half = ray * n - sun;  // along the normal that bends so
  const V length2 = Max(Dot(half, half), 1e-6f);
  const V inv_length = InverseSqrt(length2);
  const V3 h = half * inv_length;
  const V z = Max(h.z, 0.05f);
  const V inv_z = 1.0f / z;
  const V dx = MulAdd(h.x, inv_z, s.slope_x), dy = MulAdd(h.y, inv_z, s.slope_y);
  const V inv_variance = 1.0f / (s.variance + disc_variance);  // 1 / (2 sigma^2)
  const V exponent = MulAdd(dx, dx, dy * dy) * -inv_variance;
  const auto some = exponent > -40.0f;
  if (hn::AllFalse(D(), some)) return hn::Zero(D());
  const V density =
      IfThenElseZero(some, Exp(D(), Max(exponent, -40.0f))) * (inv_variance * 0.318309886f);
  const V cos_air = Max(Dot(sun, h), 1e-4f), cos_water = Dot(ray, h);
  const V passes = 1.0f - FresnelReflectance(D(), cos_air, n);
  const V inv_z2 = inv_z * inv_z;
  const V bends = cos_air * cos_water * (inv_z2 * inv_z2);
  const V spread = Max(f.cos_water, 0.08f) * length2;
  return passes * density * (bends / spread);
}

// Foam lets light through from all sides: a dim white.
HWY_INLINE V3 AddFoamFromBelow(const Shading& s, V cover, V sun_visible, V3 light) {
  if (hn::AllFalse(D(), cover > 0.0f)) return light;
  constexpr float kPasses = 0.35f;
  const float cos_sun = std::max(s.light.sun_direction.z, 0.0f);
  const V3 white = MulAdd(Constant(s.light.sun_irradiance * (kPasses * cos_sun * 0.318309886f)),
                          sun_visible, Constant(s.light.ambient * kPasses));
  return Lerp(light, white, cover * 0.85f);
}

// Behind so much water the surface is not seen: what is left of its light is less than a step of
// the picture.
HWY_INLINE hn::Mask<D> LostInWater(const Media& media, const Packet& packet) {
  const glm::vec3 c = media.absorption_per_m;
  const float least = std::min({c.x, c.y, c.z});
  return packet.distance * least > 9.0f;
}

struct UndersideShader {
  using Found = WaterSlopes;
  const Water& water;

  HWY_INLINE void LookUp(const Shading& s, std::span<const Packet> packets,
                         WaterSlopes* found) const {
    bool lost = true;
    for (const Packet& packet : packets)
      lost = lost && hn::AllTrue(D(), LostInWater(s.media, packet));
    if (!lost) return SampleUnderside(water, s.rays, packets, found);
    const V zero = hn::Zero(D());
    for (std::size_t k = 0; k < packets.size(); ++k) found[k] = NoSlopes(zero, zero, zero);
  }

  HWY_INLINE ShadingResult operator()(const Shading& s, const TilePixels& tile, const Lanes&,
                                      const Packet& packet, const WaterSlopes& slopes) const {
    const D d;
    const V zero = hn::Zero(d), one = Constant(1.0f);
    const auto lost = LostInWater(s.media, packet);
    const ShadingResult nothing = {{zero, zero, zero}, {zero, zero, one}};
    if (hn::AllTrue(d, lost)) return nothing;
    const V3 ray = -packet.to_eye;
    const FromBelow f = LeaveWater(s.media, ray, slopes);

    // Most of the surface mirrors all light: the air is looked for where some comes through.
    const auto mirrors = f.reflectance >= one;
    V mirrored_alpha, bent_alpha = zero;
    const V3 mirrored = LightFromWater(s, water, packet, f, slopes.variance,
                                       tile.planar_maps.reflection, mirrored_alpha);
    V3 seen = mirrored;
    if (!hn::AllTrue(d, mirrors)) {
      const V3 bent = LightFromAir(s, water, packet, f, slopes.variance,
                                   tile.planar_maps.refraction, bent_alpha);
      seen = IfThenElse(mirrors, mirrored, Lerp(bent, mirrored, f.reflectance));
      bent_alpha = hn::IfThenZeroElse(mirrors, bent_alpha);
    }
    // Shadows are looked for where there is sun to hide.
    const V sun = SunThrough(s.light.sun_direction, s.media.refraction_index, ray, slopes, f);
    if (!hn::AllFalse(d, Max(sun, slopes.foam.cover) > zero)) {
      const V sun_visible = SunOnSea(s, tile, packet);
      seen = MulAdd(Constant(s.light.sun_irradiance), sun * sun_visible, seen);
      seen = AddFoamFromBelow(s, slopes.foam.cover, sun_visible, seen);
    }
    return {IfThenElse(lost, nothing.light, seen), IfThenElse(lost, nothing.normal, f.normal),
            hn::IfThenZeroElse(lost, slopes.foam.cover),
            hn::IfThenZeroElse(lost, FlagsOf(mirrored_alpha, bent_alpha, slopes.wake))};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
