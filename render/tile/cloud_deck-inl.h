// Clouds that lie below the eye, between it and the sea.
#if defined(SWELL_RENDER_TILE_CLOUD_DECK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_CLOUD_DECK_INL_H_
#undef SWELL_RENDER_TILE_CLOUD_DECK_INL_H_
#else
#define SWELL_RENDER_TILE_CLOUD_DECK_INL_H_
#endif

#include "render/sky/clouds-inl.h"
#include "render/tile/air-inl.h"
#include "render/tile/medium-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Less of a cloud is none.
constexpr float kLeastHidden = 1.0f / 512.0f;
// Further than all that hides clouds.
constexpr float kNothingNear_m = 1e9f;

// Where the direction's ray comes down to the layer; rays that do not get a slant of no meaning and
// the rise 0.
HWY_INLINE CloudPlace PlaceOnDeck(const Clouds& clouds, float drop_per_m2, V3 direction) {
  const float depth_m = -clouds.height_m;
  const V down = Max(-direction.z, 1e-6f);
  const V rise2 = NegMulAdd(4.0f * drop_per_m2, depth_m, down * down);
  const V rise = Sqrt(Max(rise2, 0.0f));
  const V slant = 2.0f * depth_m / (down + rise);
  return {direction.x * slant, direction.y * slant, slant, rise};
}

// What a place on the layer shows as a packet, for the air before it.
HWY_INLINE Packet DeckPacket(const Shading& s, V3 direction, const CloudPlace& at) {
  Packet packet;
  packet.x_px = packet.y_px = packet.depth = hn::Zero(D());
  packet.distance = at.slant;
  packet.to_eye = -direction;
  packet.p = {at.x, at.y, Constant(s.light.clouds.height_m)};
  return packet;
}

// Lays the clouds before `light`, what is seen after distance_m in a direction of length 1.
static HWY_NOINLINE V3 AddCloudDeck(const Shading& s, V3 direction, V distance_m, V3 light) {
  const D d;
  const Clouds& clouds = s.light.clouds;
  const V one = Constant(1.0f);
  const CloudPlace at = PlaceOnDeck(clouds, s.rays.drop_per_m2, direction);
  const auto seen = (at.rise > 0.0f) & (at.slant < distance_m);
  if (hn::AllFalse(d, seen)) return light;
  const V pixel_angle_log2 = Log2Coarse(d, Constant(s.rays.pixel_angle));
  const V level = FootprintLevel(Log2Coarse(d, at.slant) + pixel_angle_log2, at.rise);
  CloudNoise noise = SampleClouds(clouds, at.x, at.y, level);
  const V zero = hn::Zero(d);
  V unused = zero, lost = zero;
  AddSlopes(clouds.regions, {at.x, at.y, zero}, level, {zero, zero}, noise.noise, unused, lost);
  const V passes = Exp(d, -OpticalDepth(clouds, noise));
  const V hidden = (one - passes) * clouds.shown;
  const auto some = seen & (hidden > kLeastHidden);
  if (hn::AllFalse(d, some)) return light;
  // White from above however thick they are, brighter towards the light.
  const V bright = Clamp(MulAdd(noise.side, 0.5f * clouds.inv_deviation, one), 0.6f, 1.5f);
  const V3 own = Constant(clouds.light.tops) * bright;
  const V3 arriving = Haze(s, DeckPacket(s, direction, at), own);
  return Lerp(light, arriving, IfThenElseZero(some, hidden));
}

// The layer before surfaces; the sky has its own.
struct CloudDeck : LaidByPixel<CloudDeck> {
  static constexpr bool kBeforeSky = false;
  static bool IsOn(const Shading& s) { return s.light.clouds.is_below; }
  static HWY_INLINE V3 Through(const Shading& s, const AirWay& way, V3 light) {
    return AddCloudDeck(s, way.direction, way.distance, light);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
