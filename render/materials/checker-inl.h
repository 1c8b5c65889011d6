// What a packet's pixels show of squares: their mean over a pixel.
#if defined(SWELL_RENDER_MATERIALS_CHECKER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#undef SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CHECKER_INL_H_
#endif

#include "render/materials/checker.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr float kDarkSquare = 0.06f, kLightSquare = 0.8f;  // reflectances, of the ground

// 1 on squares from 0 to 1, -1 on those from 1 to 2, and so on; blended over half_px [squares] on
// both sides of their borders, towards 0 where a pixel shows many.
HWY_INLINE V Stripes(V x, V half_px) {
  const V pairs = hn::MulSub(x, Constant(0.5f), Constant(0.25f));
  const V to_middle = hn::Abs(hn::Sub(hn::Sub(pairs, hn::Floor(pairs)), Constant(0.5f)));
  const V from_border = hn::MulSub(to_middle, Constant(2.0f), Constant(0.5f));
  return Clamp(hn::Div(from_border, hn::Max(half_px, Constant(1e-6f))), -1.0f, 1.0f);
}

// Half of a pixel's footprint [m] on a surface that the eye meets at this cosine.
HWY_INLINE V HalfFootprint(const ViewRays& rays, const Packet& packet, V cosine) {
  const V across = hn::Mul(packet.depth, Constant(0.5f * rays.pixel_angle));
  return hn::Div(across, Clamp(hn::Abs(cosine), 0.1f, 1.0f));
}

// The ground's reflectance at p.
HWY_INLINE V CheckeredGround(const Checker& checker, const ViewRays& rays, const Packet& packet) {
  const V per_m = Constant(checker.per_m);
  const V half_px = hn::Mul(HalfFootprint(rays, packet, packet.to_eye.z), per_m);
  const V sign = hn::Mul(Stripes(hn::MulAdd(packet.p.x, per_m, Constant(checker.eye.x)), half_px),
                         Stripes(hn::MulAdd(packet.p.y, per_m, Constant(checker.eye.y)), half_px));
  return hn::MulAdd(sign, Constant(0.5f * (kLightSquare - kDarkSquare)),
                    Constant(0.5f * (kLightSquare + kDarkSquare)));
}

// What squares leave of paint at q of a mesh's box, `squares` a unit along its axes; along an axis
// with none all is one square.
HWY_INLINE V CheckeredPaint(V3 squares, V3 q, V half_px) {
  const auto stripes = [&](V per_unit, V at) HWY_ATTR {
    const V sign = Stripes(hn::Mul(at, per_unit), half_px);
    return hn::IfThenElse(hn::Gt(per_unit, hn::Zero(D())), sign, Constant(1.0f));
  };
  const V sign =
      hn::Mul(hn::Mul(stripes(squares.x, q.x), stripes(squares.y, q.y)), stripes(squares.z, q.z));
  return hn::MulAdd(sign, Constant(0.5f * (1.0f - kDarkSquare)),
                    Constant(0.5f * (1.0f + kDarkSquare)));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
