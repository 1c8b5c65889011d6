// The light of stars.
#if defined(SWELL_RENDER_TILE_STARS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_STARS_INL_H_
#undef SWELL_RENDER_TILE_STARS_INL_H_
#else
#define SWELL_RENDER_TILE_STARS_INL_H_
#endif

#include "render/materials/stars.h"
#include "render/tile/packet-inl.h"

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
  h = hn::Mul(h, hn::Set(du, 0x7feb352du));
  h = hn::Xor(h, hn::ShiftRight<15>(h));
  h = hn::Mul(h, hn::Set(du, 0x846ca68bu));
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  return hn::BitCast(di, h);
}

// (0, 1] of 16 bits of a hash.
template <int kShift>
HWY_INLINE V PartOf(VI hash) {
  const DI di;
  const VI bits = hn::And(hn::ShiftRight<kShift>(hash), hn::Set(di, 0xffff));
  return hn::Mul(hn::Add(hn::ConvertTo(D(), bits), Constant(0.5f)), Constant(1.0f / 65536.0f));
}

// Radiance in a direction (world) of length 1, of stars drawn as spots of a radius [rad]. What
// would be wider than kWidestStar is not drawn.
static HWY_NOINLINE V3 StarLight(const Stars& stars, V3 world, V radius) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V3 from_x = Constant(stars.from_world[0]), from_y = Constant(stars.from_world[1]);
  const V3 from_z = Constant(stars.from_world[2]);
  const V3 p = ScaleAdd(from_x, world.x, ScaleAdd(from_y, world.y, Scale(from_z, world.z)));

  // The cube's face, the place on it and the cell.
  const V ax = hn::Abs(p.x), ay = hn::Abs(p.y), az = hn::Abs(p.z);
  const auto is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
  const auto is_y = hn::AndNot(is_x, hn::Ge(ay, az));
  const V major = hn::IfThenElse(is_x, p.x, hn::IfThenElse(is_y, p.y, p.z));
  const V inverse = hn::Div(one, hn::Abs(major));
  const V u = hn::Mul(hn::IfThenElse(is_x, p.y, p.x), inverse);
  const V v = hn::Mul(hn::IfThenElse(hn::Or(is_x, is_y), p.z, p.y), inverse);
  const V half = Constant(0.5f * kStarCells);
  const V last = Constant(kStarCells - 1.0f);
  const V i = hn::Min(hn::Floor(hn::MulAdd(u, half, half)), last);
  const V j = hn::Min(hn::Floor(hn::MulAdd(v, half, half)), last);
  const V axis = hn::IfThenElse(is_x, zero, hn::IfThenElse(is_y, one, Constant(2.0f)));
  const V face = hn::MulAdd(axis, Constant(2.0f), hn::IfThenElse(hn::Lt(major, zero), one, zero));
  const V cell =
      hn::MulAdd(hn::MulAdd(face, Constant(1.0f * kStarCells), j), Constant(1.0f * kStarCells), i);

  // Where in the cell its star is.
  const VI hash = HashCell(hn::Add(hn::ConvertTo(di, cell), hn::Set(di, 1)));
  const VI more = HashCell(hn::Xor(hash, hn::Set(di, 0x5bd1e995)));
  const V inner = Constant(1.0f - 2.0f * kStarMargin), rim = Constant(kStarMargin);
  const auto on_face = [&](V column, V part) HWY_ATTR {
    const V at = hn::Add(column, hn::MulAdd(part, inner, rim));
    return hn::MulSub(at, Constant(2.0f / kStarCells), one);
  };
  const V star_u = on_face(i, PartOf<0>(hash)), star_v = on_face(j, PartOf<16>(hash));
  const V star_length = InverseSqrt(hn::MulAdd(star_u, star_u, hn::MulAdd(star_v, star_v, one)));
  const V3 apart = {hn::Sub(hn::Mul(star_u, star_length), hn::Mul(u, hn::Abs(major))),
                    hn::Sub(hn::Mul(star_v, star_length), hn::Mul(v, hn::Abs(major))),
                    hn::Sub(star_length, hn::Abs(major))};
  const V inv_radius = hn::Div(one, radius);
  const V away2 = hn::Mul(Dot(apart, apart), hn::Mul(inv_radius, inv_radius));
  const V inside = hn::Max(hn::Sub(one, away2), zero);
  const VI third = HashCell(hn::Xor(hash, hn::Set(di, 0x1b873593)));
  const V solid = hn::Mul(hn::Mul(star_length, star_length), star_length);
  const auto drawn = hn::And(hn::Lt(PartOf<0>(third), hn::Mul(solid, Constant(kMostStars))),
                             hn::And(hn::Gt(inside, zero), hn::Lt(radius, Constant(kWidestStar))));
  if (hn::AllFalse(d, drawn)) return {zero, zero, zero};

  // So many stars are brighter than a magnitude m: 10^(0.51 m). The spot (1 - r^2)^2 has the
  // integral pi / 3.
  const V rank = hn::Max(PartOf<0>(more), Constant(1.0f / 5400.0f));
  const V bright = Exp2(d, hn::Mul(Log2(d, rank), Constant(-0.4f / 0.51f)));
  const V spot = hn::Mul(hn::Mul(inside, inside), hn::Mul(inv_radius, inv_radius));
  // Air takes a fifth of them overhead and nearly all at the horizon.
  const V air = Exp(d, hn::Div(Constant(-0.23f), hn::Add(hn::Max(world.z, zero), Constant(0.03f))));
  const V light = hn::IfThenElseZero(
      drawn,
      hn::Mul(hn::Mul(bright, air), hn::Mul(spot, Constant(stars.brightness * 0.954929659f))));
  const V warm = PartOf<16>(more);
  return {hn::Mul(light, hn::MulAdd(warm, Constant(0.5f), Constant(0.75f))), light,
          hn::Mul(light, hn::NegMulAdd(warm, Constant(0.7f), Constant(1.4f)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
