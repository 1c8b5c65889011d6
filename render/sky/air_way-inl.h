// The way of light through air.
#if defined(SWELL_RENDER_SKY_AIR_WAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_AIR_WAY_INL_H_
#undef SWELL_RENDER_SKY_AIR_WAY_INL_H_
#else
#define SWELL_RENDER_SKY_AIR_WAY_INL_H_
#endif

#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Further than all that a medium lies before.
constexpr float kEndless_m = 1e7f;

// A way away from where light arrives, at the eye or at the sea: its direction of length 1, its
// length, kEndless_m to the sky, how far it ends and begins over the sea, and how far it begins
// from the eye along x and y.
struct AirWay {
  V3 direction;
  V distance;
  V end_height;
  float begin_height_m;
  V from_x = hn::Zero(D()), from_y = hn::Zero(D());
};

// The way from the eye to what a packet shows; on a round earth that rises as the flat world's
// does.
HWY_INLINE AirWay WayTo(const ViewRays& rays, const Packet& packet) {
  const V3 p = packet.p;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  const V length = Max(packet.distance, 1e-3f);
  const V rise = NegMulAdd(r2, rays.drop_per_m2, p.z) / length;
  return {
      {-packet.to_eye.x, -packet.to_eye.y, rise}, packet.distance, p.z + rays.eye_z, rays.eye_z};
}

// The way that begins at the sea and ends at a place, which is so high over it.
HWY_INLINE AirWay WayFromSea(V3 direction, V distance, V height, V3 place) {
  const V length = Max(distance, 1e-3f), up = Max(height, 0.0f);
  direction.z = Min(up / length, 1.0f);
  return {direction,
          distance,
          up,
          0.0f,
          NegMulAdd(direction.x, distance, place.x),
          NegMulAdd(direction.y, distance, place.y)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
