// The light of stars.
#if defined(SWELL_RENDER_SKY_STARS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_STARS_INL_H_
#undef SWELL_RENDER_SKY_STARS_INL_H_
#else
#define SWELL_RENDER_SKY_STARS_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/stars.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A cube about the eye, whose faces have so many cells a side. The part of cells that have a star
// goes by how much of the sky they cover: 5,400 stars, as there are down to magnitude 6, everywhere
// as dense. Stars keep off the rims of their cells, so that no pixel has to look into the next one.
constexpr int kStarCells = 44;
constexpr float kMostStars = 5400.0f / (3.14159265f * kStarCells * kStarCells);  // a cell
constexpr float kStarMargin = 0.2f;                                              // of a cell's side
// As wide as a star may be drawn [rad]: faces are stretched by at most 3.
constexpr float kWidestStar = kStarMargin * 2.0f / kStarCells / 3.0f;

// Source: C. Wellons, Prospecting for Hash Functions, 2018 (lowbias32).
HWY_INLINE VI HashCell(VI x) {
  const DI di;
  const hn::RebindToUnsigned<DI> du;
  auto h = hn::BitCast(du, x);
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  h = h * 0x7feb352du;
  h = hn::Xor(h, hn::ShiftRight<15>(h));
  h = h * 0x846ca68bu;
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  return hn::BitCast(di, h);
}

// (0, 1] of 16 bits of a hash.
template <int kShift>
HWY_INLINE V PartOf(VI hash) {
  const VI bits = hn::ShiftRight<kShift>(hash) & 0xffff;
  return (hn::ConvertTo(D(), bits) + 0.5f) * (1.0f / 65536.0f);
}

// Radiance in a direction (world) of length 1, of stars drawn as spots of a radius [rad]. What
// would be wider than kWidestStar is not drawn.
static HWY_NOINLINE V3 StarLight(const Stars& stars, V3 world, V radius) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V3 from_x = Constant(stars.from_world[0]), from_y = Constant(stars.from_world[1]);
  const V3 from_z = Constant(stars.from_world[2]);
  const V3 p = MulAdd(from_x, world.x, MulAdd(from_y, world.y, from_z * world.z));

  // The cube's face, the place on it and the cell.
  const V ax = Abs(p.x), ay = Abs(p.y), az = Abs(p.z);
  const auto is_x = (ax >= ay) & (ax >= az);
  const auto is_y = hn::AndNot(is_x, ay >= az);
  const V major = IfThenElse(is_x, p.x, IfThenElse(is_y, p.y, p.z));
  const V inverse = one / Abs(major);
  const V u = IfThenElse(is_x, p.y, p.x) * inverse;
  const V v = IfThenElse(is_x | is_y, p.z, p.y) * inverse;
  const V half = Constant(0.5f * kStarCells);
  const V last = Constant(kStarCells - 1.0f);
  const V i = Min(Floor(MulAdd(u, half, half)), last);
  const V j = Min(Floor(MulAdd(v, half, half)), last);
  const V axis = IfThenElse(is_x, zero, IfThenElse(is_y, one, 2.0f));
  const V face = MulAdd(axis, 2.0f, IfThenElse(major < zero, one, zero));
  const V cell = MulAdd(MulAdd(face, 1.0f * kStarCells, j), 1.0f * kStarCells, i);

  // Where in the cell its star is.
  const VI hash = HashCell(hn::ConvertTo(di, cell) + 1);
  const VI more = HashCell(hn::Xor(hash, hn::Set(di, 0x5bd1e995)));
  const V inner = Constant(1.0f - 2.0f * kStarMargin), rim = Constant(kStarMargin);
  const auto on_face = [&](V column, V part) HWY_ATTR {
    const V at = column + MulAdd(part, inner, rim);
    return MulSub(at, 2.0f / kStarCells, one);
  };
  const V star_u = on_face(i, PartOf<0>(hash)), star_v = on_face(j, PartOf<16>(hash));
  const V star_length = InverseSqrt(MulAdd(star_u, star_u, MulAdd(star_v, star_v, one)));
  const V3 apart = {star_u * star_length - u * Abs(major), star_v * star_length - v * Abs(major),
                    star_length - Abs(major)};
  const V inv_radius = one / radius;
  const V away2 = Dot(apart, apart) * (inv_radius * inv_radius);
  const V inside = Max(one - away2, zero);
  const VI third = HashCell(hn::Xor(hash, hn::Set(di, 0x1b873593)));
  const V solid = star_length * star_length * star_length;
  const auto drawn =
      (PartOf<0>(third) < solid * kMostStars) & ((inside > zero) & (radius < kWidestStar));
  if (hn::AllFalse(d, drawn)) return {zero, zero, zero};

  // So many stars are brighter than a magnitude m: 10^(0.51 m). The spot (1 - r^2)^2 has the
  // integral pi / 3.
  const V rank = Max(PartOf<0>(more), 1.0f / 5400.0f);
  const V bright = Exp2(d, Log2(d, rank) * (-0.4f / 0.51f));
  const V spot = inside * inside * (inv_radius * inv_radius);
  // Air takes a fifth of them overhead and nearly all at the horizon.
  const V air = Exp(d, -0.23f / (Max(world.z, zero) + 0.03f));
  const V light = IfThenElseZero(drawn, bright * air * (spot * (stars.brightness * 0.954929659f)));
  const V warm = PartOf<16>(more);
  return {light * MulAdd(warm, 0.5f, 0.75f), light, light * NegMulAdd(warm, 0.7f, 1.4f)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
