// What air does to light on its way: haze, molecules and fog, which know of each other.
#if defined(SWELL_RENDER_TILE_AIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_AIR_INL_H_
#undef SWELL_RENDER_TILE_AIR_INL_H_
#else
#define SWELL_RENDER_TILE_AIR_INL_H_
#endif

#include <algorithm>

#include "render/packets/packet-inl.h"
#include "render/sky/fog-inl.h"
#include "render/sky/sky_map-inl.h"
#include "render/tile/shading.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The mean density of haze on the way to what a packet shows, against that at sea level, for one
// over the height H. At the height h over the sea it is 1 / (1 + h / H)^2, much like exp(-h / H)
// and of the same amount in all, because between places of heights a H and b H on a straight line
// the mean of that is 1 / ((1 + a) (1 + b)): no exponential, and no difference of almost equal
// ones. The way is taken as two such lines, which meet where its middle lies over a round earth.
HWY_INLINE V MeanHaze(const Shading& s, const Packet& shown, float per_m) {
  const float eye_z = s.rays.eye_z;
  const V one = Constant(1.0f);
  const V eye = Constant(1.0f + std::max(eye_z, 0.0f) * per_m);
  // Mirrored things lie below the level.
  const V height = Abs(shown.p.z + eye_z);
  const V place = MulAdd(height, per_m, one);
  const V both = eye + place;
  const V r2 = MulAdd(shown.p.x, shown.p.x, shown.p.y * shown.p.y);
  const V sagging = r2 * (0.25f * s.rays.drop_per_m2 * per_m);
  const V middle = Max(MulSub(both, 0.5f, sagging), one);
  return both * 0.5f / (eye * place * middle);
}

// Molecules thin with height as exp(-h / 8 km) does, which 10 km in MeanHaze()'s law are closest
// to.
constexpr float kPerMoleculesHeight_m = 1e-4f;

// What of the air below an eye far over the sea depends on the direction alone.
struct AirAhead {
  V3 below;  // AirBelow()
  V steep;   // how much of haze's colour is the horizon's mean
};

// In a direction of length 1 as the eye has it.
HWY_INLINE AirAhead FindAirAhead(const Light& light, V3 direction) {
  const V down = PartDown(light, direction.z);
  const V level2 = NegMulAdd(down, down, 1.0f), level4 = level2 * level2;
  const V level8 = level4 * level4;
  return {AirBelow(light, direction, down), NegMulAdd(level8, level8, 1.0f)};
}

// The air below an eye far over the sea: haze, and the molecules beyond those that the haze stands
// for. Near the horizon both have the sky's colour there; further down the molecules have that of
// the air below, and haze the mean of the horizon, as under an overcast sky all air has. Of the
// packet, place and distance count. ahead(): asked for where there is any.
template <class Ahead>
HWY_INLINE V3 ThroughAerialPerspective(const Shading& s, const Packet& packet, V3 colour, V length,
                                       const Ahead& ahead) {
  const D d;
  const V zero = hn::Zero(d);
  const V mean_haze = MeanHaze(s, packet, s.media.inv_haze_height_m);
  const V mean_air = MeanHaze(s, packet, kPerMoleculesHeight_m);
  const V haze = length * mean_haze * s.media.inv_haze_m;
  const V air = length * Max(mean_air - mean_haze, zero);
  const glm::vec3 molecules = s.media.molecules_per_m;
  const auto amount = [&](float per_m) HWY_ATTR {
    const V clear = Exp(d, -MulAdd(air, per_m, haze));
    return Max(1.0f - 1.0f / 512.0f - clear, zero);
  };
  const V blue = amount(molecules.z);
  if (hn::AllFalse(d, blue > zero)) return colour;

  const AirAhead seen = ahead();
  const V all = MulAdd(air, molecules.y, Max(haze, 1e-6f));
  const V white = Max(seen.steep * (haze / all), s.media.cloudy);
  const V3 light = Lerp(seen.below, Constant(s.light.horizon), white);
  return {Lerp(colour.x, light.x, amount(molecules.x)),
          Lerp(colour.y, light.y, amount(molecules.y)), Lerp(colour.z, light.z, blue)};
}

// `packet` is a copy: by reference a call would keep all packets in memory.
static HWY_NOINLINE V3 AerialPerspective(const Shading& s, Packet packet, V3 colour, V length) {
  // The direction as the eye has it; to_eye is the place's.
  const V3 p = packet.p;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  const V z = NegMulAdd(r2, s.rays.drop_per_m2, p.z) / packet.distance;
  const V3 direction = {-packet.to_eye.x, -packet.to_eye.y, z};
  return ThroughAerialPerspective(s, packet, colour, length,
                                  [&]() HWY_ATTR { return FindAirAhead(s.light, direction); });
}

// Blends towards the horizon's colour with distance, so that no edge of the sea shows. Haze of less
// than half a step of the picture is left out: near packets then need no lookup. Straight down
// there is no azimuth to look up: the steeper the view, the more the mean of the horizon takes
// over. The haze is that of `length` of the way.
HWY_INLINE V3 Haze(const Shading& s, const Packet& packet, V3 colour, V length) {
  const D d;
  if (s.media.molecules_per_m.z > 0.0f) return AerialPerspective(s, packet, colour, length);
  const V depth = length * -s.media.inv_haze_m * MeanHaze(s, packet, s.media.inv_haze_height_m);
  const V clear = Exp(d, depth);
  const V amount = Max(1.0f - 1.0f / 512.0f - clear, 0.0f);
  if (hn::AllFalse(d, amount > 0.0f)) return colour;
  const V x = -packet.to_eye.x, y = -packet.to_eye.y;
  const V horizontal2 = Max(MulAdd(x, x, y * y), 1e-12f);
  const V3 ahead = SoftSkyRadiance(*s.light.haze_sky, {x, y, hn::Zero(d)}, Sqrt(horizontal2));
  const V level4 = horizontal2 * horizontal2, level8 = level4 * level4;
  const V steep = NegMulAdd(level8, level8, 1.0f);
  return Lerp(colour, Lerp(ahead, Constant(s.light.horizon), steep), amount);
}

HWY_INLINE V3 Haze(const Shading& s, const Packet& packet, V3 colour) {
  return Haze(s, packet, colour, packet.distance);
}

// Haze, and fog in front of it, where an eye over the fog has more haze before both. In a slab fog
// takes haze's place. packet_of(): what the ray ends at, asked for where there is haze.
// haze_before(colour, length): lays the haze before the fog.
template <class PacketOf, class HazeBefore>
HWY_INLINE V3 HazeAndFog(const Shading& s, V distance, const FogPath& path, const FogView& view,
                         V3 colour, const PacketOf& packet_of, const HazeBefore& haze_before) {
  const D d;
  const V zero = hn::Zero(d);
  const Fog& fog = s.media.fog;
  V behind = distance - path.before;
  if (!fog.is_exponential) behind = NegMulAdd(path.amount, fog.takes_haze, behind);
  // What fog hides has no haze.
  const V seen = Max(view.passes.x, Max(view.passes.y, view.passes.z));
  behind = IfThenElseZero(seen >= 1.0f / 512.0f, behind);
  if (!hn::AllFalse(d, behind > zero)) colour = Haze(s, packet_of(), colour, behind);
  colour = ThroughFog(view, colour);
  return hn::AllTrue(d, path.before == zero) ? colour : haze_before(colour, path.before);
}

// Whether rays of this view may meet air before they meet fog, and what this air shows depends on
// the direction alone.
HWY_INLINE bool IsFogSeenFromAbove(const Shading& s) {
  const Fog& fog = s.media.fog;
  const float reaches_m = fog.is_exponential ? 2.0f * fog.top_m : fog.top_m;
  return fog.on && s.media.molecules_per_m.z > 0.0f && fog.at_eye.height_m > reaches_m;
}

// All of the air between the eye and what a packet shows. A function of its own: few call it.
static HWY_NOINLINE V3 ThroughAirAndFog(const Shading& s, Packet packet, V3 colour) {
  const Fog& fog = s.media.fog;
  const FogRay ray = {WayTo(s.rays, packet), fog.at_eye};
  const FogPath path = PathTo(fog, ray);
  return HazeAndFog(
      s, ray.distance, path, SeeFog(fog, ray, path), colour,
      [&]() HWY_ATTR -> const Packet& { return packet; },
      [&](V3 light, V length) HWY_ATTR { return Haze(s, packet, light, length); });
}

HWY_INLINE V3 ThroughAir(const Shading& s, const Packet& packet, V3 colour) {
  return s.media.fog.on ? ThroughAirAndFog(s, packet, colour) : Haze(s, packet, colour);
}

// The sky through fog. An eye over the fog sees it under the sky through as much haze as the sea
// there.
[[maybe_unused]] static HWY_NOINLINE V3 SkyThroughAir(const Shading& s, V3 direction, V3 light) {
  const Fog& fog = s.media.fog;
  if (fog.is_exponential || fog.at_eye.above_m > 0.0f)
    return ThroughFog(SkyFog(fog, fog.at_eye, direction, kPlacesBeforeSky), light);
  const FogRay ray = RayToSky(fog.at_eye, direction);
  const FogPath path = PathInSlab(fog, ray);
  const auto meets = path.amount > 0.0f;
  if (hn::AllFalse(D(), meets)) return light;
  const V3 p = direction * path.before;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  Packet top;
  top.x_px = top.y_px = top.depth = hn::Zero(D());
  top.p = {p.x, p.y, MulAdd(r2, s.rays.drop_per_m2, p.z)};
  top.distance = path.before;
  top.to_eye = -direction;
  const V3 foggy = ThroughFog(SeeFog(fog, ray, path), light);
  return IfThenElse(meets, Haze(s, top, foggy), light);
}

// Fog on a way that begins at the sea.
[[maybe_unused]] static HWY_NOINLINE V3 FogFromSea(const Fog& fog, AirWay way, V3 light) {
  const FogRay ray = {way, fog.at_sea};
  return ThroughFog(SeeFog(fog, ray, PathTo(fog, ray)), light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
