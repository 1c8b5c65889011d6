#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/check.h"
#include "terrain/height_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/height_rays_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

HWY_INLINE V Constant(float value) { return hn::Set(D(), value); }
HWY_INLINE VI Whole(int value) { return hn::Set(DI(), value); }
HWY_INLINE V ToFloat(VI value) { return hn::ConvertTo(D(), value); }

// The rays' place in cells: a whole one and what is left, which floats hold exactly enough.
struct Axis {
  int whole;
  float part, cells;  // of the place; of the grid

  Axis(double from_m, double spacing_m, int samples)
      : whole(static_cast<int>(std::floor(std::clamp(from_m / spacing_m, -1e9, 1e9)))),
        part(static_cast<float>(std::clamp(from_m / spacing_m, -1e9, 1e9) - whole)),
        cells(static_cast<float>(samples - 1)) {}
};

// Rays along one axis, in cells from `whole`.
struct Along {
  V per_t, inverse;
  VI step;     // +1 or -1
  VI forward;  // 1 or 0: which side of a block they leave it by

  explicit Along(V cells_per_t) : per_t(cells_per_t) {
    const auto still = hn::Lt(hn::Abs(per_t), Constant(1e-20f));
    inverse = hn::IfThenElse(still, Constant(1e20f), hn::Div(Constant(1.0f), per_t));
    const auto back = hn::RebindMask(DI(), hn::Lt(per_t, hn::Zero(D())));
    forward = hn::IfThenElse(back, Whole(0), Whole(1));
    step = hn::Sub(hn::Add(forward, forward), Whole(1));
  }
};

// t in which rays lie over the grid along an axis.
HWY_INLINE void ClipToGrid(const Axis& axis, const Along& along, V& begin, V& end) {
  const V low = hn::Mul(Constant(-static_cast<float>(axis.whole) - axis.part), along.inverse);
  const V high =
      hn::Mul(Constant(axis.cells - static_cast<float>(axis.whole) - axis.part), along.inverse);
  begin = hn::Max(begin, hn::Min(low, high));
  end = hn::Min(end, hn::Max(low, high));
}

// Where a line through cells crosses one of their borders.
HWY_INLINE V Crossing(const Axis& axis, const Along& along, VI border) {
  const V from = hn::Sub(ToFloat(hn::Sub(border, Whole(axis.whole))), Constant(axis.part));
  return hn::Mul(from, along.inverse);
}

// Place at t, from a border, in cells.
HWY_INLINE V PastBorder(const Axis& axis, const Along& along, VI border, V t) {
  const V from = ToFloat(hn::Sub(border, Whole(axis.whole)));
  return hn::Sub(hn::MulAdd(along.per_t, t, Constant(axis.part)), from);
}

// Of blocks 2^more to 2^(more + 1) times as wide as this many cells, and 2^more cells at least.
HWY_INLINE VI LevelOf(V cells, int more, int levels) {
  const V some = hn::Min(hn::Max(cells, Constant(1.0f)), Constant(32768.0f));
  // A float's exponent is its logarithm.
  const VI log2 = hn::Sub(hn::ShiftRight<23>(hn::BitCast(DI(), some)), Whole(127));
  return hn::Min(hn::Add(log2, Whole(more)), Whole(levels));
}

// Sixteen bits each at these numbers of an array that has one more.
HWY_INLINE V GatherCodes(const std::uint16_t* codes, VI number) {
  const VI both = hn::GatherOffset(DI(), reinterpret_cast<const std::int32_t*>(codes),
                                   hn::ShiftLeft<1>(number));
  return ToFloat(hn::And(both, Whole(0xffff)));
}

struct RayHeights {
  V z, z_t, z_tt;

  HWY_INLINE V At(V t) const { return hn::MulAdd(hn::MulAdd(z_tt, t, z_t), t, z); }
  // No higher than the ray between t and end.
  HWY_INLINE V LowestIn(V t, V end) const {
    const V way = hn::Sub(end, t);
    const V sag =
        hn::Mul(hn::Mul(hn::Max(z_tt, hn::Zero(D())), Constant(0.25f)), hn::Mul(way, way));
    return hn::Sub(hn::Min(At(t), At(end)), sag);
  }
};

// Bilinear between four posts: x and y in [0, 1] at the begin of a way, and what they grow by t.
struct Patch {
  V h00, along_x, along_y, twist;
  V x, y, x_t, y_t;
};

HWY_INLINE Patch ReadPatch(const HeightPyramid& p, VI i, VI j, VI block) {
  const int last = p.grid.samples_x - 1;
  const VI i1 = hn::Min(hn::Add(i, block), Whole(last)),
           j1 = hn::Min(hn::Add(j, block), Whole(last));
  const V base = Constant(p.base_m), step = Constant(p.step_m);
  const auto post = [&](VI x, VI y) HWY_ATTR {
    const VI number = hn::Add(hn::Mul(y, Whole(p.grid.samples_x)), x);
    return hn::MulAdd(GatherCodes(p.posts.data(), number), step, base);
  };
  const V h00 = post(i, j), h10 = post(i1, j), h01 = post(i, j1), h11 = post(i1, j1);
  Patch patch;
  patch.h00 = h00;
  patch.along_x = hn::Sub(h10, h00);
  patch.along_y = hn::Sub(h01, h00);
  patch.twist = hn::Sub(hn::Sub(h11, h10), patch.along_y);
  return patch;
}

// How far on, up to `way`, rays meet a patch; negative where they do not. A ray that is under it
// already meets it at once. With x = x0 + dx t and so on, the ray's height less the patch's is
// a t^2 + b t + c.
HWY_INLINE V MeetPatch(const Patch& p, const RayHeights& ray, V t, V way) {
  const V zero = hn::Zero(D());
  const V c = hn::Sub(ray.At(t), hn::MulAdd(hn::MulAdd(p.twist, p.y, p.along_x), p.x,
                                            hn::MulAdd(p.along_y, p.y, p.h00)));
  const V turn = hn::MulAdd(p.x, p.y_t, hn::Mul(p.y, p.x_t));
  const V rise = hn::MulAdd(p.twist, turn, hn::MulAdd(p.along_x, p.x_t, hn::Mul(p.along_y, p.y_t)));
  const V b = hn::Sub(hn::MulAdd(hn::Add(ray.z_tt, ray.z_tt), t, ray.z_t), rise);
  const V a = hn::NegMulAdd(p.twist, hn::Mul(p.x_t, p.y_t), ray.z_tt);
  const V root2 = hn::NegMulAdd(hn::Mul(a, c), Constant(4.0f), hn::Mul(b, b));
  const V q = hn::Mul(hn::Add(b, hn::CopySign(hn::Sqrt(hn::Max(root2, zero)), b)), Constant(-0.5f));
  const V first = hn::Div(c, q), second = hn::Div(q, a);
  const V none = Constant(-1.0f);
  // Comparisons with NaN are false.
  const auto inside = [&](V root) HWY_ATTR {
    return hn::And(hn::And(hn::Ge(root, zero), hn::Le(root, way)), hn::Ge(root2, zero));
  };
  const V end = hn::MulAdd(hn::MulAdd(a, way, b), way, c);
  V met = hn::IfThenElse(hn::Le(end, zero), way, none);
  const M second_in = inside(second), first_in = inside(first);
  met = hn::IfThenElse(second_in, second, met);
  const M first_is_nearer = hn::And(first_in, hn::Or(hn::Not(second_in), hn::Lt(first, second)));
  met = hn::IfThenElse(first_is_nearer, first, met);
  return hn::IfThenElse(hn::Le(c, zero), zero, met);
}

// The rays of one packet on their way.
struct Walk {
  V t;
  VI level, i, j;  // block (i, j) of the level
  M active;
  V hit;
};

HWY_INLINE VI IfI(M mask, VI yes, VI no) {
  return hn::IfThenElse(hn::RebindMask(DI(), mask), yes, no);
}

class PacketCast {
 public:
  HWY_INLINE PacketCast(const HeightPyramid& pyramid, const Axis& axis_x, const Axis& axis_y,
                        float detail_cells_per_t, V x_t, V y_t, const RayHeights& heights)
      : pyramid_(pyramid),
        axis_x_(axis_x),
        axis_y_(axis_y),
        detail_(Constant(detail_cells_per_t)),
        along_x_(x_t),
        along_y_(y_t),
        heights_(heights) {}

  HWY_INLINE V Cast(V begin, V end) const {
    const D d;
    ClipToGrid(axis_x_, along_x_, begin, end);
    ClipToGrid(axis_y_, along_y_, begin, end);
    Walk walk = {begin, FirstLevel(begin), Whole(0), Whole(0), hn::Lt(begin, end), hn::Inf(d)};
    walk.i = FirstBlock(axis_x_, along_x_, walk);
    walk.j = FirstBlock(axis_y_, along_y_, walk);
    while (!hn::AllFalse(d, walk.active)) {
      Step(end, walk);
    }
    return walk.hit;
  }

 private:
  // Blocks of some pixels: from there a ray climbs where it is high, in fewer steps than it would
  // come down in from the top.
  HWY_INLINE VI FirstLevel(V t) const { return LevelOf(hn::Mul(detail_, t), 1, pyramid_.levels); }

  HWY_INLINE VI FirstBlock(const Axis& axis, const Along& along, const Walk& w) const {
    const V past = hn::MulAdd(along.per_t, w.t, Constant(axis.part));
    const V cell = hn::Min(
        hn::Max(hn::Add(hn::Floor(past), Constant(static_cast<float>(axis.whole))), hn::Zero(D())),
        Constant(axis.cells - 1.0f));
    return hn::Shr(hn::ConvertTo(DI(), cell), w.level);
  }

  HWY_INLINE void Step(V end, Walk& w) const {
    const D d;
    const DI di;
    const VI one = Whole(1);
    const VI block = hn::Shl(one, w.level);
    const VI corner_x = hn::Shl(w.i, w.level), corner_y = hn::Shl(w.j, w.level);
    const auto far_side = [&](VI corner, const Along& along)
                              HWY_ATTR { return hn::Add(corner, hn::Mul(along.forward, block)); };
    const V out_x = Crossing(axis_x_, along_x_, far_side(corner_x, along_x_));
    const V out_y = Crossing(axis_y_, along_y_, far_side(corner_y, along_y_));
    const V out = hn::Max(hn::Min(hn::Min(out_x, out_y), end), w.t);

    // Blocks whose maximum the ray passes above are left out.
    const M is_cell = hn::RebindMask(d, hn::Eq(w.level, Whole(0)));
    const M is_leaf = hn::Or(is_cell, hn::Le(ToFloat(block), hn::Mul(detail_, w.t)));
    const VI blocks = hn::Shr(Whole(pyramid_.side), w.level);
    const VI number = hn::Add(hn::Mul(hn::Add(blocks, w.j), blocks), w.i);
    const M has_maximum = hn::AndNot(is_cell, w.active);
    const V code = GatherCodes(pyramid_.maxima.data(),
                               hn::IfThenElseZero(hn::RebindMask(di, has_maximum), number));
    const V highest = hn::MulAdd(code, Constant(pyramid_.step_m), Constant(pyramid_.base_m));
    const M meets =
        hn::And(w.active, hn::Or(is_cell, hn::Le(heights_.LowestIn(w.t, out), highest)));
    const M descends = hn::AndNot(is_leaf, meets);
    M moves_on = hn::AndNot(descends, w.active);

    const M tests = hn::AndNot(InHole(corner_x, corner_y, block), hn::And(meets, is_leaf));
    if (!hn::AllFalse(d, tests)) {
      const V met = MeetBlock(corner_x, corner_y, block, tests, w.t, hn::Sub(out, w.t));
      const M found = hn::And(tests, hn::Ge(met, hn::Zero(d)));
      w.hit = hn::IfThenElse(found, hn::Add(w.t, met), w.hit);
      w.active = hn::AndNot(found, w.active);
      moves_on = hn::AndNot(found, moves_on);
    }
    Descend(descends, corner_x, corner_y, w);
    MoveOn(moves_on, hn::Le(out_x, out_y), out, end, w);
  }

  HWY_INLINE M InHole(VI corner_x, VI corner_y, VI block) const {
    const VI begin = Whole(pyramid_.hole_begin - 1), end = Whole(pyramid_.hole_end + 1);
    const auto inside = [&](VI corner) HWY_ATTR {
      return hn::And(hn::Gt(corner, begin), hn::Lt(hn::Add(corner, block), end));
    };
    return hn::RebindMask(D(), hn::And(inside(corner_x), inside(corner_y)));
  }

  HWY_INLINE V MeetBlock(VI corner_x, VI corner_y, VI block, M tests, V t, V way) const {
    const DI di;
    const auto mask = hn::RebindMask(di, tests);
    Patch patch = ReadPatch(pyramid_, hn::IfThenElseZero(mask, corner_x),
                            hn::IfThenElseZero(mask, corner_y), block);
    const V per_block = hn::Div(Constant(1.0f), ToFloat(block));
    const V zero = hn::Zero(D()), one = Constant(1.0f);
    const auto part = [&](V past) HWY_ATTR {
      return hn::Min(hn::Max(hn::Mul(past, per_block), zero), one);
    };
    patch.x = part(PastBorder(axis_x_, along_x_, corner_x, t));
    patch.y = part(PastBorder(axis_y_, along_y_, corner_y, t));
    patch.x_t = hn::Mul(along_x_.per_t, per_block);
    patch.y_t = hn::Mul(along_y_.per_t, per_block);
    return MeetPatch(patch, heights_, t, way);
  }

  // To the quarter of the block that a ray is in.
  HWY_INLINE void Descend(M descends, VI corner_x, VI corner_y, Walk& w) const {
    const VI finer = hn::Sub(w.level, Whole(1));
    const VI half = hn::Shl(Whole(1), hn::Max(finer, Whole(0)));
    const auto child = [&](VI index, VI corner, const Axis& axis, const Along& along) HWY_ATTR {
      const V past = PastBorder(axis, along, hn::Add(corner, half), w.t);
      const VI far = IfI(hn::Ge(past, hn::Zero(D())), Whole(1), Whole(0));
      return hn::Add(hn::Add(index, index), far);
    };
    w.i = IfI(descends, child(w.i, corner_x, axis_x_, along_x_), w.i);
    w.j = IfI(descends, child(w.j, corner_y, axis_y_, along_y_), w.j);
    w.level = IfI(descends, finer, w.level);
  }

  // To the next block, and up a level where it has another parent.
  HWY_INLINE void MoveOn(M moves_on, M by_x, V out, V end, Walk& w) const {
    const D d;
    const VI zero = Whole(0), one = Whole(1);
    const M steps_x = hn::And(moves_on, by_x), steps_y = hn::AndNot(by_x, moves_on);
    w.i = hn::Add(w.i, IfI(steps_x, along_x_.step, zero));
    w.j = hn::Add(w.j, IfI(steps_y, along_y_.step, zero));
    w.t = hn::IfThenElse(moves_on, out, w.t);
    const VI blocks = hn::Shr(Whole(pyramid_.side), w.level);
    const auto outside = [&](VI index) HWY_ATTR {
      return hn::Or(hn::Lt(index, zero), hn::Gt(index, hn::Sub(blocks, one)));
    };
    const M leaves =
        hn::Or(hn::RebindMask(d, hn::Or(outside(w.i), outside(w.j))), hn::Ge(out, end));
    w.active = hn::AndNot(hn::And(moves_on, leaves), w.active);
    // Going on, an even number begins a new parent; going back, an odd one.
    const auto new_parent = [&](VI index, const Along& along) HWY_ATTR {
      return hn::RebindMask(d, hn::Ne(hn::And(index, one), along.forward));
    };
    const M climbs = hn::And(w.active, hn::Or(hn::And(steps_x, new_parent(w.i, along_x_)),
                                              hn::And(steps_y, new_parent(w.j, along_y_))));
    w.i = IfI(climbs, hn::ShiftRight<1>(w.i), w.i);
    w.j = IfI(climbs, hn::ShiftRight<1>(w.j), w.j);
    w.level = IfI(climbs, hn::Add(w.level, one), w.level);
  }

  const HeightPyramid& pyramid_;
  const Axis &axis_x_, &axis_y_;
  V detail_;
  Along along_x_, along_y_;
  RayHeights heights_;
};

void CastRays(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail_m_per_t,
              const HeightRays& rays, float* HWY_RESTRICT t_hit) {
  const D d;
  const Grid& grid = pyramid.grid;
  const glm::dvec2 from = from_world - grid.min_world;
  const Axis axis_x(from.x, grid.spacing_m, grid.samples_x);
  const Axis axis_y(from.y, grid.spacing_m, grid.samples_y);
  const auto per_m = static_cast<float>(1.0 / grid.spacing_m);
  for (std::size_t n = 0; n < rays.x.size(); n += hn::Lanes(d)) {
    const std::size_t count = std::min(hn::Lanes(d), rays.x.size() - n);
    // Lanes beyond the last ray have no way to go.
    const auto load = [&](std::span<const float> values) HWY_ATTR {
      HWY_ALIGN float lane[hn::MaxLanes(d)] = {};
      std::copy_n(values.data() + n, count, lane);
      return hn::Load(d, lane);
    };
    const PacketCast packet(
        pyramid, axis_x, axis_y, detail_m_per_t * per_m, hn::Mul(load(rays.x), Constant(per_m)),
        hn::Mul(load(rays.y), Constant(per_m)), {load(rays.z), load(rays.z_t), load(rays.z_tt)});
    HWY_ALIGN float lane[hn::MaxLanes(d)];
    hn::Store(packet.Cast(load(rays.begin), load(rays.end)), d, lane);
    std::copy_n(lane, count, t_hit + n);
  }
}

// --- Beams

// What a beam covers along an axis between t and t_on, in cells of the grid.
struct Cover {
  V low, high;
};

HWY_INLINE Cover CoverOf(const Axis& axis, V low, V high, V t, V t_on) {
  constexpr float kRounding = 0.02f;
  const float from = static_cast<float>(axis.whole) + axis.part;
  return {hn::Add(hn::Min(hn::Mul(low, t), hn::Mul(low, t_on)), Constant(from - kRounding)),
          hn::Add(hn::Max(hn::Mul(high, t), hn::Mul(high, t_on)), Constant(from + kRounding))};
}

// How far on a beam covers no more than `size` cells along an axis.
HWY_INLINE V Reach(V low, V high, V t, V size) {
  const V wide = hn::Sub(high, low);
  const V speed = hn::Max(hn::Max(hn::Abs(low), hn::Abs(high)), Constant(1e-20f));
  return hn::Div(hn::NegMulAdd(wide, t, size), hn::Add(speed, wide));
}

// Whether a beam has left the grid behind.
HWY_INLINE M Left(const Axis& axis, V low, V high, V t) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const Cover at = CoverOf(axis, low, high, t, t);
  const M before = hn::And(hn::Lt(at.high, hn::Neg(one)), hn::Le(high, zero));
  const M behind = hn::And(hn::Gt(at.low, Constant(axis.cells + 1.0f)), hn::Ge(low, zero));
  return hn::Or(before, behind);
}

// Whether it is above a height and goes up from there.
HWY_INLINE M RisesAbove(V height, const RayHeights& lowest, V t) {
  const V zero = hn::Zero(D());
  const M rises = hn::And(hn::Ge(lowest.z_t, zero), hn::Ge(lowest.z_tt, zero));
  return hn::And(rises, hn::Gt(lowest.At(t), height));
}

// Steps as long as the beam covers two by two blocks at most, larger ones after each that is free.
HWY_INLINE V CastBeam(const HeightPyramid& p, const Axis& axis_x, const Axis& axis_y, V x_low,
                      V x_high, V y_low, V y_high, const RayHeights& lowest, V floor, V t) {
  const D d;
  const DI di;
  constexpr int kMostSteps = 48;
  const VI one = Whole(1);
  VI level =
      LevelOf(hn::Mul(hn::Max(hn::Sub(x_high, x_low), hn::Sub(y_high, y_low)), t), 3, p.levels);
  // One block covers all; a metre above it is beyond rounding.
  const V highest_of_all = Constant(p.base_m + p.step_m * static_cast<float>(p.maxima[1]) + 1.0f);
  M active = hn::FirstN(d, hn::Lanes(d));
  const auto block_of = [&](V cell, VI of_level) HWY_ATTR {
    const V last = Constant(static_cast<float>(p.side) - 1.0f);
    return hn::Shr(hn::ConvertTo(di, hn::Min(hn::Max(cell, hn::Zero(d)), last)), of_level);
  };
  for (int k = 0; k < kMostSteps && !hn::AllFalse(d, active); ++k) {
    const V size = hn::Sub(ToFloat(hn::Shl(one, level)), Constant(0.1f));
    const V way = hn::Min(Reach(x_low, x_high, t, size), Reach(y_low, y_high, t, size));
    const V t_on = hn::Add(t, way);
    const Cover x = CoverOf(axis_x, x_low, x_high, t, t_on);
    const Cover y = CoverOf(axis_y, y_low, y_high, t, t_on);
    const VI i0 = block_of(x.low, level), i1 = block_of(x.high, level);
    const VI j0 = block_of(y.low, level), j1 = block_of(y.high, level);
    const VI blocks = hn::Shr(Whole(p.side), level);
    const auto code = [&](VI i, VI j) HWY_ATTR {
      return GatherCodes(p.maxima.data(), hn::Add(hn::Mul(hn::Add(blocks, j), blocks), i));
    };
    const V highest =
        hn::Max(hn::Max(code(i0, j0), code(i1, j0)), hn::Max(code(i0, j1), code(i1, j1)));
    const V ground = hn::MulAdd(highest, Constant(p.step_m), Constant(p.base_m));
    const V rise = hn::Mul(lowest.z_t, t_on), bend = hn::Mul(hn::Mul(lowest.z_tt, t_on), t_on);
    const V low =
        hn::Max(hn::Add(hn::Add(lowest.z, hn::Min(hn::Mul(hn::Mul(lowest.z_tt, t), t), bend)),
                        hn::Min(hn::Mul(lowest.z_t, t), rise)),
                floor);
    const V size_m = hn::Add(hn::Add(hn::Abs(lowest.z), hn::Abs(bend)), hn::Abs(rise));
    const V rounding = hn::Mul(Constant(1e-6f), size_m);
    const M is_free = hn::And(hn::Gt(way, hn::Zero(d)), hn::Gt(hn::Sub(low, rounding), ground));
    t = hn::IfThenElse(hn::And(active, is_free), t_on, t);
    const M leaves =
        hn::And(hn::And(active, is_free),
                hn::Or(hn::Or(Left(axis_x, x_low, x_high, t), Left(axis_y, y_low, y_high, t)),
                       RisesAbove(highest_of_all, lowest, t)));
    t = hn::IfThenElse(leaves, hn::Inf(d), t);
    active = hn::AndNot(leaves, active);
    const VI coarser = hn::Min(hn::Add(level, one), Whole(p.levels));
    level = IfI(is_free, coarser, hn::Sub(level, one));
    active = hn::And(active, hn::RebindMask(d, hn::Gt(level, Whole(0))));
    level = hn::Max(level, one);
    // A beam that is wider than blocks of this level is too wide for finer ones.
    active = hn::And(active, hn::Or(is_free, hn::Gt(way, hn::Zero(d))));
  }
  return t;
}

void CastBeams(const HeightPyramid& pyramid, glm::dvec2 from_world, const HeightBeams& beams,
               std::span<float> t_free) {
  const D d;
  const Grid& grid = pyramid.grid;
  const glm::dvec2 from = from_world - grid.min_world;
  const Axis axis_x(from.x, grid.spacing_m, grid.samples_x);
  const Axis axis_y(from.y, grid.spacing_m, grid.samples_y);
  const V per_m = Constant(static_cast<float>(1.0 / grid.spacing_m));
  for (std::size_t n = 0; n < t_free.size(); n += hn::Lanes(d)) {
    const std::size_t count = std::min(hn::Lanes(d), t_free.size() - n);
    const auto load = [&](std::span<const float> values) HWY_ATTR {
      HWY_ALIGN float lane[hn::MaxLanes(d)] = {};
      std::copy_n(values.data() + n, count, lane);
      return hn::Load(d, lane);
    };
    HWY_ALIGN float lane[hn::MaxLanes(d)];
    const auto scaled = [&](std::span<const float> values)
                            HWY_ATTR { return hn::Mul(load(values), per_m); };
    hn::Store(CastBeam(pyramid, axis_x, axis_y, scaled(beams.x_low), scaled(beams.x_high),
                       scaled(beams.y_low), scaled(beams.y_high),
                       {load(beams.z), load(beams.z_t), load(beams.z_tt)}, load(beams.floor),
                       load(beams.begin)),
              d, lane);
    std::copy_n(lane, count, t_free.data() + n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::terrain {

HWY_EXPORT(CastRays);
HWY_EXPORT(CastBeams);

void cast_rays(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail_m_per_t,
               const HeightRays& rays, std::span<float> t_hit) {
  const std::size_t count = t_hit.size();
  for (const auto& values : {rays.x, rays.y, rays.z, rays.z_t, rays.z_tt, rays.begin, rays.end})
    SWELL_CHECK(values.size() == count, "rays={} values={}", count, values.size());
  HWY_DYNAMIC_DISPATCH(CastRays)(pyramid, from_world, detail_m_per_t, rays, t_hit.data());
}

void cast_beams(const HeightPyramid& pyramid, glm::dvec2 from_world, const HeightBeams& beams,
                std::span<float> t_free) {
  const std::size_t count = t_free.size();
  for (const auto& values : {beams.x_low, beams.x_high, beams.y_low, beams.y_high, beams.z,
                             beams.z_t, beams.z_tt, beams.floor, beams.begin})
    SWELL_CHECK(values.size() == count, "beams={} values={}", count, values.size());
  HWY_DYNAMIC_DISPATCH(CastBeams)(pyramid, from_world, beams, t_free);
}

}  // namespace swell::terrain
#endif
