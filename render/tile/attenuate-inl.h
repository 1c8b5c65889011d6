// What the media between a surface and the eye do to light: once for all materials.
#if defined(SWELL_RENDER_TILE_ATTENUATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#undef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#else
#define SWELL_RENDER_TILE_ATTENUATE_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/tile/media-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/through_water-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Light as it arrives at an eye under water from what a packet of the window shows: the surface
// itself, or what lies in the water.
template <SurfaceKind kSurface>
HWY_INLINE V3 SeenInWater(const Media& media, V level, const Packet& shown, V3 light, V shafts) {
  const V zero = hn::Zero(D());
  V depth = zero;
  constexpr bool kIsWater = kSurface == SurfaceKind::kWater || kSurface == SurfaceKind::kRivers;
  if constexpr (!kIsWater) depth = Max(level - shown.p.z, zero);
  const V deeper = depth - media.eye_depth_m;
  return ThroughWater(media, media.daylight_at_eye, {shown.distance, deeper}, light, shafts);
}

// A packet as a view shows it, and what it shows: the true places in the world.
struct Seen {
  Packet packet;   // where a mirrored or moved point really is
  WaterPath path;  // through water, of an eye in air; of the refraction image only
  WaterWay way;    // of an eye under water: from the surface; of the reflection image only
};

// Undoes what map_point() does for an eye under water. The way through air to what it sees through
// the surface has its own direction and length.
template <ViewKind kView>
HWY_INLINE Seen FindSeenFromBelow(const Media& media, const Packet& shown, V level) {
  const V zero = hn::Zero(D()), one = Constant(1.0f), n = Constant(media.refraction_index);
  const V beyond = shown.p.z - level, image = Max(beyond, zero);
  Seen seen;
  seen.packet = shown;
  if constexpr (kView == ViewKind::kReflection) {
    seen.packet.p.z = level - beyond;
    seen.packet.to_eye.z = -shown.to_eye.z;
    const V part = Clamp(image / Max(shown.p.z, 1e-3f), 0.0f, 1.0f);
    seen.way = {shown.distance * part, image};
  } else {
    const V cos_water = Max(-shown.to_eye.z, 0.02f);
    const V sin_water = Sqrt(Max(NegMulAdd(cos_water, cos_water, one), zero));
    const V sin_air = Min(sin_water * n, one);
    const V cos_air = Sqrt(NegMulAdd(sin_air, sin_air, one));
    const V height = image * cos_air / (n * cos_water);
    const V across = image * sin_water / cos_water;
    seen.packet.p.z = level + (height + Min(beyond, zero));
    seen.packet.distance = Sqrt(MulAdd(height, height, across * across));
    const V3 to_eye = {shown.to_eye.x * n, shown.to_eye.y * n, -cos_air};
    seen.packet.to_eye = to_eye * InverseSqrt(Dot(to_eye, to_eye));
  }
  return seen;
}

// Undoes what map_point() does; `level` is the height of the water's level over the eye.
template <ViewKind kView>
HWY_INLINE Seen FindSeen(const Shading& s, const Packet& shown, V level) {
  if (s.media.submerged) return FindSeenFromBelow<kView>(s.media, shown, level);
  Seen seen;
  seen.packet = shown;
  if constexpr (kView == ViewKind::kReflection) {
    seen.packet.p.z = level + level - shown.p.z;
    seen.packet.to_eye.z = -shown.to_eye.z;
  }
  if constexpr (kView == ViewKind::kRefraction) {
    const V zero = hn::Zero(D());
    const V below = level - shown.p.z;
    seen.path = PathThroughWater(s.media, shown, Abs(below));
    seen.packet.p.z = level - hn::CopySign(seen.path.depth, below);
    seen.path.length = IfThenElseZero(below > zero, seen.path.length);
  }
  return seen;
}

// Deep water where the eye looks into it, towards what the refraction image shows.
HWY_INLINE V3 DeepWaterBefore(const Shading& s, const Packet& shown, const Seen& seen) {
  const V level = seen.packet.p.z + seen.path.depth;
  const V3 entered = shown.p * (level / Min(shown.p.z, -1e-3f));
  return DeepWater(s, entered, SunOverLandAndClouds(s, entered));
}

// What a surface shows, as it arrives: through air, or through water up to the surface. To an eye
// under water it arrives at the surface. What ends softly ends in the medium.
template <ViewKind kView, class Result>
HWY_INLINE V3 Attenuate(const Shading& s, const Packet& shown, const Seen& seen,
                        const Result& result) {
  const auto or_medium = [&](const V3& medium, const V3& light) HWY_ATTR {
    if constexpr (requires { result.cover; })
      return Lerp(medium, light, result.cover);
    else
      return light;
  };
  if constexpr (kView == ViewKind::kRefraction) {
    if (!s.media.submerged) {
      const V3 body = DeepWaterBefore(s, shown, seen);
      return or_medium(body, AbsorbInWater(s.media, seen.path, body, result.light));
    }
    const V height = seen.packet.p.z - s.media.eye_depth_m;
    const AirWay way = WayFromSea(-seen.packet.to_eye, seen.packet.distance, height, seen.packet.p);
    return ThroughMediaBeyond(s, way, Haze(s, seen.packet, result.light));
  } else if (s.media.submerged) {
    return ThroughWater(s.media, glm::vec3(1.0f), seen.way, result.light);
  } else {
    // Beyond the water, before which are media of its own.
    const V height = (seen.packet.p.z - shown.p.z) * 0.5f;
    const V part = Clamp(height / Max(-shown.p.z, 1e-3f), 0.0f, 1.0f);
    const AirWay way = WayFromSea(-shown.to_eye, shown.distance * part, height, seen.packet.p);
    return or_medium(Constant(s.media.body),
                     ThroughMediaBeyond(s, way, Haze(s, shown, result.light)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
