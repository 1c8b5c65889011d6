// What a packet's pixels show of squares: their mean over a pixel.
#if defined(SWELL_RENDER_MATERIALS_CHECKER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#undef SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#endif

#include "render/materials/checker.h"
#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// 1 on squares from 0 to 1, -1 on those from 1 to 2, and so on; blended over half_px [squares] on
// both sides of their borders, towards 0 where a pixel shows many.
HWY_INLINE V Stripes(V x, V half_px) {
  const V pairs = MulSub(x, 0.5f, 0.25f);
  const V to_middle = Abs(pairs - Floor(pairs) - 0.5f);
  const V from_border = MulSub(to_middle, 2.0f, 0.5f);
  return Clamp(from_border / Max(half_px, 1e-6f), -1.0f, 1.0f);
}

// Half of a pixel's footprint [m] on a surface that the eye meets at this cosine.
HWY_INLINE V HalfFootprint(const ViewRays& rays, const Packet& packet, V cosine) {
  const V across = packet.depth * (0.5f * rays.pixel_angle);
  return across / Clamp(Abs(cosine), 0.1f, 1.0f);
}

// The ground's reflectance at p.
HWY_INLINE V CheckeredGround(const Checker& checker, const ViewRays& rays, const Packet& packet) {
  const V per_m = Constant(checker.per_m);
  const V half_px = HalfFootprint(rays, packet, packet.to_eye.z) * per_m;
  const V sign = Stripes(MulAdd(packet.p.x, per_m, checker.eye.x), half_px) *
                 Stripes(MulAdd(packet.p.y, per_m, checker.eye.y), half_px);
  return MulAdd(sign, 0.5f * (kLightSquare - kDarkSquare), 0.5f * (kLightSquare + kDarkSquare));
}

// What squares leave of paint at q of a mesh's box, `squares` a unit along its axes; along an axis
// with none all is one square.
HWY_INLINE V CheckeredPaint(V3 squares, V3 q, V half_px) {
  const auto stripes = [&](V per_unit, V at) HWY_ATTR {
    const V sign = Stripes(at * per_unit, half_px);
    return IfThenElse(per_unit > 0.0f, sign, 1.0f);
  };
  const V sign = stripes(squares.x, q.x) * stripes(squares.y, q.y) * stripes(squares.z, q.z);
  return MulAdd(sign, 0.5f * (1.0f - kDarkSquare), 0.5f * (1.0f + kDarkSquare));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
