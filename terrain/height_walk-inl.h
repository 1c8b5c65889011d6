// Ways of rays over heights, block by block of a pyramid of maxima: for the kernels of land and of
// implicit surfaces that have tables of heights.
#if defined(SWELL_TERRAIN_HEIGHT_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TERRAIN_HEIGHT_WALK_INL_H_
#undef SWELL_TERRAIN_HEIGHT_WALK_INL_H_
#else
#define SWELL_TERRAIN_HEIGHT_WALK_INL_H_
#endif

#include "terrain/height_rays.h"
#include "terrain/height_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {

// Places that rays come from, one a lane, in cells.
struct LaneAxis {
  static constexpr int whole = 0;
  V part;
  float cells;  // of the grid
};

// Bilinear between four posts: x and y in [0, 1] at the begin of a way, and what they grow by t.
struct Patch {
  V h00, along_x, along_y, twist;
  V x, y, x_t, y_t;
};

// How far on, up to `way`, rays meet a patch; negative where they do not. A ray that is under it
// already meets it at once. With x = x0 + dx t and so on, the ray's height less the patch's is
// a t^2 + b t + c.
HWY_INLINE V MeetPatch(const Patch& p, const RayHeights& ray, V t, V way) {
  const V zero = hn::Zero(D());
  const V c =
      ray.At(t) - MulAdd(MulAdd(p.twist, p.y, p.along_x), p.x, MulAdd(p.along_y, p.y, p.h00));
  const V turn = MulAdd(p.x, p.y_t, p.y * p.x_t);
  const V rise = MulAdd(p.twist, turn, MulAdd(p.along_x, p.x_t, p.along_y * p.y_t));
  const V b = MulAdd(ray.z_tt + ray.z_tt, t, ray.z_t) - rise;
  const V a = NegMulAdd(p.twist, p.x_t * p.y_t, ray.z_tt);
  const V root2 = NegMulAdd(a * c, 4.0f, b * b);
  const V q = (b + hn::CopySign(Sqrt(Max(root2, zero)), b)) * -0.5f;
  const V first = c / q, second = q / a;
  const V none = Constant(-1.0f);
  // Comparisons with NaN are false.
  const auto inside = [&](V root)
                          HWY_ATTR { return ((root >= zero) & (root <= way)) & (root2 >= zero); };
  const V end = MulAdd(MulAdd(a, way, b), way, c);
  V met = IfThenElse(end <= zero, way, none);
  const M second_in = inside(second), first_in = inside(first);
  met = IfThenElse(second_in, second, met);
  const M first_is_nearer = first_in & ((!second_in) | (first < second));
  met = IfThenElse(first_is_nearer, first, met);
  return IfThenElse(c <= zero, zero, met);
}

// Rays on their way, one in a lane, each at a block of its own.
struct Walk {
  V x_t, y_t, inverse_x, inverse_y;  // [cells per t], [t per cell]
  V z, z_t, z_tt, end;
  V t;
  VI corner_x, corner_y, level;  // of the block; in cells

  HWY_INLINE RayHeights Heights() const { return {z, z_t, z_tt}; }
  HWY_INLINE VI Block() const { return hn::Shl(Whole(1), level); }
};

// Where a ray leaves its block.
struct Exit {
  V t;
  M by_x;
};

// Axis: where rays come from, one place for all or one a lane. Heights: OneTable or TwoTables.
template <class Axis, class Heights>
class Traveller {
 public:
  // detail: cells a t that blocks may be wide to be taken for one cell; 0: none.
  HWY_INLINE Traveller(const Heights& heights, const Axis& axis_x, const Axis& axis_y, float detail)
      : heights_(heights),
        pyramid_(heights.Grid()),
        axis_x_(axis_x),
        axis_y_(axis_y),
        detail_(detail) {}

  // Puts rays whose x_t, y_t, z, z_t, z_tt, t and end are set at their first blocks, which are as
  // wide as `cells` at least. Returns which have a way.
  HWY_INLINE M Begin(Walk& w, V cells) const {
    w.inverse_x = Inverse(w.x_t), w.inverse_y = Inverse(w.y_t);
    ClipToGrid(axis_x_, w.inverse_x, w);
    ClipToGrid(axis_y_, w.inverse_y, w);
    // Blocks of some pixels: from there a ray climbs where it is high, in fewer steps than it would
    // come down in from the top.
    w.level = LevelOf(Max(kSmoothBlocks * detail_ * w.t, cells), 1, pyramid_.levels);
    w.corner_x = FirstCorner(axis_x_, w.x_t, w);
    w.corner_y = FirstCorner(axis_y_, w.y_t, w);
    return w.t < w.end;
  }

  // A step of lanes that go: out of a block whose maximum they pass above, or into a quarter of it.
  // Those at a block to be tested stay.
  HWY_INLINE void Step(M& goes, M& waits, Walk& w) const {
    const D d;
    const VI block = w.Block();
    const Exit exit = ExitOf(block, w);
    const M is_cell = hn::RebindMask(d, w.level == Whole(0));
    const Maximum highest = HighestIn(hn::AndNot(is_cell, goes), w);
    const V width = ToFloat(block), detail = detail_ * w.t;
    const V widest = IfThenElse(highest.is_smooth, detail * kSmoothBlocks, detail);
    const M is_leaf = is_cell | (width <= widest);
    const M is_low = w.Heights().LowestIn(w.t, exit.t) <= highest.height;
    const M meets = goes & (is_cell | is_low);
    const M tests = meets & is_leaf, descends = hn::AndNot(is_leaf, meets);
    waits = waits | tests;
    goes = hn::AndNot(tests, goes);
    Descend(descends, block, w);
    MoveOn(hn::AndNot(descends, goes), block, exit, goes, w);
  }

  // Lanes at blocks to be tested: where they meet them, negative where they go on.
  HWY_INLINE V Test(M& goes, Walk& w) const {
    const VI block = w.Block();
    const Exit exit = ExitOf(block, w);
    const V met = MeetPatch(PatchOf(goes, block, w), w.Heights(), w.t, exit.t - w.t);
    const M found = hn::AndNot(InHole(block, w), goes) & (met >= 0.0f);
    const V t_hit = IfThenElse(found, w.t + met, -1.0f);
    goes = hn::AndNot(found, goes);
    MoveOn(goes, block, exit, goes, w);
    return t_hit;
  }

 private:
  static HWY_INLINE V Inverse(V per_t) {
    const auto still = Abs(per_t) < 1e-20f;
    return IfThenElse(still, 1e20f, 1.0f / per_t);
  }

  // t in which rays lie over the grid along an axis.
  static HWY_INLINE void ClipToGrid(const Axis& axis, V inverse, Walk& w) {
    const float whole = static_cast<float>(axis.whole);
    const V low = (-whole - axis.part) * inverse;
    const V high = (axis.cells - whole - axis.part) * inverse;
    w.t = Max(w.t, Min(low, high));
    w.end = Min(w.end, Max(low, high));
  }

  static HWY_INLINE VI FirstCorner(const Axis& axis, V per_t, const Walk& w) {
    const V past = MulAdd(per_t, w.t, axis.part);
    const V cell = Min(Max(Floor(past) + static_cast<float>(axis.whole), 0.0f), axis.cells - 1.0f);
    return hn::Shl(hn::Shr(hn::ConvertTo(DI(), cell), w.level), w.level);
  }

  // Which side of blocks rays leave them by.
  static HWY_INLINE M Forward(V inverse) { return inverse >= 0.0f; }

  // Where a line through cells crosses one of their borders.
  static HWY_INLINE V Crossing(const Axis& axis, V inverse, VI corner, VI block) {
    const VI border = corner + MaskedI(Forward(inverse), block);
    const V from = ToFloat(border - Whole(axis.whole)) - axis.part;
    return from * inverse;
  }

  // Place at t, from a border, in cells.
  static HWY_INLINE V PastBorder(const Axis& axis, V per_t, VI border, V t) {
    const V from = ToFloat(border - Whole(axis.whole));
    return MulAdd(per_t, t, axis.part) - from;
  }

  HWY_INLINE Exit ExitOf(VI block, const Walk& w) const {
    const V x = Crossing(axis_x_, w.inverse_x, w.corner_x, block);
    const V y = Crossing(axis_y_, w.inverse_y, w.corner_y, block);
    return {Max(Min(Min(x, y), w.end), w.t), x <= y};
  }

  // Returns log2 of the number of blocks a side of the level.
  HWY_INLINE VI BlocksLog2(const Walk& w) const { return Whole(pyramid_.levels) - w.level; }

  // The maxima of blocks that are larger than cells.
  HWY_INLINE Maximum HighestIn(M lanes, const Walk& w) const {
    const VI blocks = hn::Shr(Whole(pyramid_.side), w.level);
    const VI i = hn::Shr(w.corner_x, w.level), j = hn::Shr(w.corner_y, w.level);
    const VI number = hn::Shl(blocks + j, BlocksLog2(w)) + i;
    return heights_.MaximumAt(MaskedI(lanes, number));
  }

  // Goes down to the quarter of the block that a ray is in.
  HWY_INLINE void Descend(M descends, VI block, Walk& w) const {
    const VI half = hn::ShiftRight<1>(block);
    const auto corner = [&](const Axis& axis, V per_t, VI before) HWY_ATTR {
      const VI middle = before + half;
      const M far = PastBorder(axis, per_t, middle, w.t) >= 0.0f;
      return IfI(descends & far, middle, before);
    };
    w.corner_x = corner(axis_x_, w.x_t, w.corner_x);
    w.corner_y = corner(axis_y_, w.y_t, w.corner_y);
    w.level = w.level - MaskedI(descends, Whole(1));
  }

  // To the next block, and up a level where it has another parent. Lanes that leave the grid, or
  // end, go no more.
  HWY_INLINE void MoveOn(M moves, VI block, const Exit& exit, M& goes, Walk& w) const {
    const D d;
    const VI zero = Whole(0);
    const M forward_x = Forward(w.inverse_x), forward_y = Forward(w.inverse_y);
    const M steps_x = moves & exit.by_x, steps_y = hn::AndNot(exit.by_x, moves);
    const VI back = zero - block;
    w.corner_x = w.corner_x + MaskedI(steps_x, IfI(forward_x, block, back));
    w.corner_y = w.corner_y + MaskedI(steps_y, IfI(forward_y, block, back));
    w.t = IfThenElse(moves, exit.t, w.t);
    const VI last = Whole(pyramid_.side - 1);
    const auto outside = [&](VI corner) HWY_ATTR {
      return (corner & last) != corner;  // side is a power of two
    };
    const M leaves =
        hn::RebindMask(d, outside(w.corner_x) | outside(w.corner_y)) | (exit.t >= w.end);
    goes = hn::AndNot(moves & leaves, goes);
    // Going on, an even number begins a new parent; going back, an odd one.
    const auto new_parent = [&](VI corner, M forward) HWY_ATTR {
      const M is_even = hn::RebindMask(d, (corner & block) == zero);
      return !hn::Xor(is_even, forward);
    };
    const M climbs = (moves & goes) & ((steps_x & new_parent(w.corner_x, forward_x)) |
                                       (steps_y & new_parent(w.corner_y, forward_y)));
    const VI bit = MaskedI(climbs, block);
    w.corner_x = hn::AndNot(bit, w.corner_x);
    w.corner_y = hn::AndNot(bit, w.corner_y);
    w.level = w.level + MaskedI(climbs, Whole(1));
  }

  HWY_INLINE M InHole(VI block, const Walk& w) const {
    const VI begin = Whole(pyramid_.hole_begin - 1), end = Whole(pyramid_.hole_end + 1);
    const auto inside = [&](VI corner)
                            HWY_ATTR { return (corner > begin) & (corner + block < end); };
    return hn::RebindMask(D(), inside(w.corner_x) & inside(w.corner_y));
  }

  HWY_INLINE Patch PatchOf(M lanes, VI block, const Walk& w) const {
    // Two posts of a row lie side by side.
    const PostNumbers at = NumbersOf(w);
    const PostPair low = heights_.PostsAt(MaskedI(lanes, at.number));
    const PostPair high = heights_.PostsAt(MaskedI(lanes, at.number + at.stride));
    Patch p;
    p.h00 = low.first, p.along_x = low.second - low.first, p.along_y = high.first - low.first;
    p.twist = high.second - low.second - p.along_y;

    const V per_block = 1.0f / ToFloat(block);
    const auto part = [&](V past) HWY_ATTR { return Min(Max(past * per_block, 0.0f), 1.0f); };
    p.x = part(PastBorder(axis_x_, w.x_t, w.corner_x, w.t));
    p.y = part(PastBorder(axis_y_, w.y_t, w.corner_y, w.t));
    p.x_t = w.x_t * per_block;
    p.y_t = w.y_t * per_block;
    return p;
  }

  struct PostNumbers {
    VI number, stride;  // of a block's first post; from row to row
  };

  // HeightPyramid::posts_of_level().
  HWY_INLINE PostNumbers NumbersOf(const Walk& w) const {
    const VI one = Whole(1);
    const int coarse_begin = static_cast<int>(pyramid_.grid.size());
    const M is_cell = hn::RebindMask(D(), w.level == Whole(0));
    const VI blocks = hn::Shr(Whole(pyramid_.side), w.level);
    const VI thirds = (hn::Shl(blocks, BlocksLog2(w)) - one) & Whole(0x55555555);
    const VI begin = thirds + (blocks + blocks) + (BlocksLog2(w) + Whole(coarse_begin - 2));
    const VI stride = IfI(is_cell, Whole(pyramid_.grid.samples_x), blocks + one);
    const VI i = hn::Shr(w.corner_x, w.level), j = hn::Shr(w.corner_y, w.level);
    return {IfI(is_cell, Whole(0), begin) + (j * stride + i), stride};
  }

  Heights heights_;
  const HeightPyramid& pyramid_;
  Axis axis_x_, axis_y_;
  float detail_;
};

// A packet of rays on its way. t_hit: infinity while nothing is met.
struct Packet {
  Walk walk;
  M goes, waits;
  V t_hit;

  HWY_INLINE bool IsUnderWay() const { return !hn::AllFalse(D(), goes | waits); }
};

// One step, and tests once as many lanes wait for them as go on: a test takes longer than a step.
template <class Travel>
HWY_INLINE void StepPacket(const Travel& traveller, Packet& p) {
  const D d;
  traveller.Step(p.goes, p.waits, p.walk);
  if (hn::CountTrue(d, p.waits) < hn::CountTrue(d, p.goes) || hn::AllFalse(d, p.waits)) return;
  const V t = traveller.Test(p.waits, p.walk);
  p.t_hit = IfThenElse(t >= 0.0f, t, p.t_hit);
  p.goes = p.goes | p.waits;
  p.waits = hn::FirstN(d, 0);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
