// Rays and implicit surfaces: the nearest place along each ray where a part's terms are all at
// least 0.
//
// Along a ray a quadric is a parabola of the depth u. A term without perturbations is at least 0
// between, or outside, two roots. A term with some is walked along by steps that cannot pass a
// zero: with G < 0 at u, and M at least the second derivative of G on [u, u + h], the parabola
// G + G' s + M s^2 / 2 lies over G for all s in [0, h], and the step goes to its first zero, or to
// the end of h if it has none. The steps shrink with the square near a zero, as Newton's do, and
// come from one side, so that no thin part is passed however long the way is.
//
// A part with a table of heights h(u, v) over a plane, and a threshold, is where h >= max(z,
// threshold), z the ray's height over the plane: first where one is the higher, then where the
// other is, a ray's way goes over the table's pyramid of maxima as over land
// (terrain/height_walk-inl.h).
#include <array>
#include <cstddef>

#include "render/view/implicit_rays.h"
#include "scene/implicit_surface.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/view/implicit_rays_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/view/implicit_tables-inl.h"
#include "render/view/implicit_vectors-inl.h"
#include "terrain/height_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
constexpr float kNowhere = 1e30f;
constexpr float kSmallest = 1e-20f;  // a ray's part along an axis that it does not go along

struct RayPacket {
  V3 p, d;  // points p + u d
};

// a u^2 + 2 b u + c.
struct Parabola {
  V a, b, c;
  HWY_INLINE V At(V u) const { return MulAdd(MulAdd(a, u, b + b), u, c); }
  HWY_INLINE V HalfSlopeAt(V u) const { return MulAdd(a, u, b); }
};

HWY_INLINE Parabola Along(const RayQuadric& f, const RayPacket& ray) {
  const V3 b = Constant(f.b), ad = Times(f, ray.d), ap = Times(f, ray.p);
  const V3 more = {ap.x + b.x, ap.y + b.y, ap.z + b.z};
  const V3 most = {more.x + b.x, more.y + b.y, more.z + b.z};
  return {Dot(ray.d, ad), Dot(ray.d, more), Dot(ray.p, most) + f.c};
}

// Between which depths a parabola is below 0 that opens upwards, and outside which if downwards.
struct Roots {
  V low, high;
  M upwards;
};

HWY_INLINE Roots RootsOf(const Parabola& f) {
  const D d;
  const V far = Constant(kNowhere), zero = hn::Zero(d);
  const V inside = NegMulAdd(f.a, f.c, f.b * f.b);
  const M none = inside <= zero;
  const V root = Sqrt(Max(inside, zero));
  // The sum without cancellation, then Vieta's other one.
  const V q = -(f.b + hn::CopySign(root, f.b));
  const V first = q / f.a, second = f.c / q;
  const M always = none & (f.c >= zero);
  Roots roots = {Min(first, second), Max(first, second), f.a >= zero};
  // Without a root: a gap that is empty, or all.
  roots.low = IfThenElse(none, IfThenElse(always, far, -far), roots.low);
  roots.high = IfThenElse(none, far, roots.high);
  roots.upwards = roots.upwards | none;
  return roots;
}

// The first depth from u on where the parabola is at least 0, or kNowhere.
HWY_INLINE V NextInside(const Roots& f, V u) {
  const M in_gap = (u > f.low) & (u < f.high);
  const V over_gap = IfThenElse(in_gap, f.high, u);
  const V to_inside = IfThenElse(u > f.high, kNowhere, Max(u, f.low));
  return IfThenElse(f.upwards, over_gap, to_inside);
}

// A term along the rays.
struct TermAlong {
  Parabola base;
  std::size_t perturbations;
  std::array<Parabola, scene::kMostPerturbations> r;
  std::array<float, scene::kMostPerturbations> factor;
};

// The most of a parabola between depths u and u + h, where it is `here` and `there`.
HWY_INLINE V MostBetween(const Parabola& f, V here, V there, V h) {
  // An arch rises over its chord by no more than -a h^2 / 4.
  const V arch = Max(-f.a, 0.0f) * (h * h);
  return MulAdd(arch, 0.25f, Max(here, there));
}

// One step along a term, below 0 at u: how far it is surely below 0, at most h.
HWY_INLINE V SureStep(const TermAlong& term, V u, V h, V& value) {
  const D d;
  const V zero = hn::Zero(d), six = Constant(6.0f);
  V g = term.base.At(u), half_slope = term.base.HalfSlopeAt(u), half_bend = term.base.a;
  for (std::size_t i = 0; i < term.perturbations; ++i) {
    const Parabola& r = term.r[i];
    const V f = Constant(term.factor[i]);
    const V here = r.At(u), slope = r.HalfSlopeAt(u);
    const V q = Max(here, zero), q2 = q * q;
    g = MulAdd(f, q2 * q, g);
    half_slope = MulAdd(f * 3.0f, q2 * slope, half_slope);
    // R'' = 6 Q Q'^2 + 6 Q^2 a, with Q' linear: at most what the ends of h give.
    const V most = Max(MostBetween(r, here, r.At(u + h), h), zero);
    const V end_slope = MulAdd(r.a, h, slope);
    const V slope2 = Max(slope * slope, end_slope * end_slope);
    const V of_factor = term.factor[i] > 0.0f ? MulAdd(4.0f, slope2, most * Max(r.a, zero))
                                              : most * Max(-r.a, zero);
    const V size = Constant(term.factor[i] > 0.0f ? term.factor[i] : -term.factor[i]);
    half_bend = MulAdd(size * 0.5f, six * (most * of_factor), half_bend);
  }
  value = g;
  // The first zero of g + 2 half_slope s + half_bend s^2.
  const V inside = NegMulAdd(half_bend, g, half_slope * half_slope);
  const V below = half_slope + Sqrt(Max(inside, zero));
  const M has_zero = (inside >= zero) & (below > zero);
  const V step = -g / below;
  return IfThenElse(has_zero, Min(step, h), h);
}

// Where a ray may still meet a part.
struct Stay {
  V from, to;
};

// Cuts off what lies in a gap at the stay's begin or end. Returns where a gap is left in its midst.
HWY_INLINE M CutTo(const Roots& f, Stay& stay) {
  const M starts_in_gap = f.upwards & (f.low < stay.from);
  const M ends_in_gap = f.upwards & (f.high > stay.to);
  const V far = Constant(kNowhere);
  const V from = IfThenElse(starts_in_gap, f.high, IfThenElse(f.upwards, -far, f.low));
  const V to = IfThenElse(ends_in_gap, f.low, IfThenElse(f.upwards, far, f.high));
  stay.from = Max(stay.from, from);
  stay.to = Min(stay.to, to);
  return f.upwards & ((f.high > stay.from) & ((f.low < stay.to) & (f.low < f.high)));
}

// A term's perturbations on a packet's rays: between which depths each may tell.
struct Perturbed {
  std::array<Stay, scene::kMostPerturbations> tells;
};

HWY_INLINE Perturbed PerturbedOf(const TermAlong& term) {
  Perturbed along;
  for (std::size_t i = 0; i < term.perturbations; ++i) {
    const Roots roots = RootsOf(term.r[i]);
    // One that opens upwards tells outside its gap, here: everywhere.
    const V far = Constant(kNowhere);
    along.tells[i] = {IfThenElse(roots.upwards, -far, roots.low),
                      IfThenElse(roots.upwards, far, roots.high)};
  }
  return along;
}

// As NextInside(), for a term with perturbations, as far as `to`. With none that tells it is where
// the base is inside; before that, and before any bump begins, the term is below 0.
HWY_INLINE V WalkInside(const TermAlong& term, const Roots& base, const Perturbed& along, V u, V to,
                        V least_step, M lanes) {
  const D d;
  constexpr int kMostSteps = 400;
  const V of_base = NextInside(base, u);
  V start = of_base;
  bool has_dent = false;
  for (std::size_t i = 0; i < term.perturbations; ++i) {
    if (term.factor[i] < 0.0f) {
      has_dent = true;
      continue;
    }
    const V bump = IfThenElse(along.tells[i].to > u, Max(along.tells[i].from, u), kNowhere);
    start = Min(start, bump);
  }
  M told = hn::FirstN(d, 0);
  for (std::size_t i = 0; i < term.perturbations; ++i)
    told = told | ((start > along.tells[i].from) & (start < along.tells[i].to));
  told = told | (start < of_base);
  u = start;
  M walking = (lanes & told) & (u < to);
  const V short_stretch = least_step * 64.0f;
  V h = (to - u) * 0.25f;
  // Where nothing takes away from the base it ends there.
  if (!has_dent) {
    const M ends = of_base < to;
    h = IfThenElse(ends & (of_base > u), of_base - u, h);
  }
  for (int k = 0; k < kMostSteps && !hn::AllFalse(d, walking); ++k) {
    V value;
    const V step = SureStep(term, u, h, value);
    const M inside = value >= 0.0f;
    walking = hn::AndNot(inside, walking);
    u = IfThenElse(walking, u + step, u);
    // So near a zero as to be there; but over a long stretch M may be far too much.
    const M arrives = (step < least_step) & (h <= short_stretch);
    walking = hn::AndNot(arrives, walking);
    const M passed = walking & (u >= to);
    u = IfThenElse(passed, kNowhere, u);
    walking = hn::AndNot(passed, walking);
    const V less = Max(step * 4.0f, h * (1.0f / 16.0f));
    const V next = IfThenElse(step < h, less, h * 2.0f);
    const V left = Max(to - u, least_step);
    h = Min(Max(next, least_step + least_step), left);
  }
  return u;
}

HWY_INLINE V Inverse(V along) {
  const M is_level = Abs(along) < kSmallest;
  return 1.0f / IfThenElse(is_level, kSmallest, along);
}

HWY_INLINE void StayAlong(V p, V inverse, float half, Stay& stay) {
  const V a = (-half - p) * inverse;
  const V b = (half - p) * inverse;
  stay.from = Max(stay.from, Min(a, b));
  stay.to = Min(stay.to, Max(a, b));
}

HWY_INLINE TermAlong TermOf(const PosedImplicit& implicit, const RayTerm& term,
                            const RayPacket& ray) {
  TermAlong along;
  along.base = Along(term.quadric, ray);
  along.perturbations = term.perturbations;
  for (std::size_t i = 0; i < term.perturbations; ++i) {
    const RayPerturbation& r = implicit.perturbations[term.first_perturbation + i];
    along.r[i] = Along(r.quadric, ray);
    along.factor[i] = r.factor;
  }
  return along;
}

// The first depth from `from` on, before `to`, where a ray is under the table's heights.
template <class Heights>
HWY_INLINE V MeetHeights(const Heights& of, const RayTable& table, const RayPacket& ray, V from,
                         V to, M lanes) {
  const D d;
  const V zero = hn::Zero(d);
  const V3 way = Turned(table.linear, ray.d);
  const V3 start = MulAdd(way, from, InTable(table, ray.p));
  const auto cells = static_cast<float>(of.Grid().grid.samples_x - 1);
  const heights::Traveller<heights::LaneAxis, Heights> traveller(of, {start.x, cells},
                                                                 {start.y, cells}, 0.0f);
  // Under the threshold a ray is as high as this.
  const V over = start.z - table.threshold_m;
  const M rises = way.z > zero, is_level = way.z == zero;
  const M above = (over > zero) | ((over == zero) & rises);
  const V crossing = -over / IfThenElse(is_level, 1.0f, way.z);
  const V length = to - from;
  const M crosses = hn::AndNot(is_level, (crossing > zero) & (crossing < length));
  const V split = IfThenElse(crosses, crossing, length);
  // As the paper picks a level: by the projection of the way on the table.
  constexpr float kOfWay = 0.25f;
  const V widest = Max(Abs(way.x), Abs(way.y)) * (kOfWay * length);
  const auto meet = [&](V begin, V end, M is_above, M which) HWY_ATTR {
    heights::Packet packet;
    packet.goes = packet.waits = hn::FirstN(d, 0);
    packet.t_hit = hn::Inf(d);
    heights::Walk& w = packet.walk;
    w.x_t = way.x, w.y_t = way.y;
    w.z = IfThenElse(is_above, start.z, table.threshold_m);
    w.z_t = IfThenElseZero(is_above, way.z), w.z_tt = zero;
    w.t = begin, w.end = end;
    packet.goes = traveller.Begin(w, widest) & which;
    while (packet.IsUnderWay()) heights::StepPacket(traveller, packet);
    return packet.t_hit;
  };
  V t = meet(zero, split, above, lanes);
  const M goes_on = (lanes & crosses) & (t > length);
  if (!hn::AllFalse(d, goes_on)) t = Min(t, meet(split, length, !above, goes_on));
  return IfThenElse(t > length, kNowhere, from + t);
}

// As NextInside(), for a part's table.
HWY_INLINE V NextUnder(const RayTable& table, const RayPacket& ray, V u, V to, M lanes) {
  return WithHeights(
      table, [&](const auto& of) HWY_ATTR { return MeetHeights(of, table, ray, u, to, lanes); });
}

// The first depth in the stay where all of the part's terms are at least 0, else kNowhere or past
// the stay, which ends where they cannot be any more.
HWY_INLINE V FirstInside(const PosedImplicit& implicit, const RayPart& part, const RayPacket& ray,
                         Stay& stay, M lanes) {
  const D d;
  const RayTerm& first = implicit.terms[part.first_term];
  const V least_step = 2e-7f * (stay.to - stay.from + Abs(stay.from));
  // Terms without perturbations are intervals, or all but a gap.
  std::array<Roots, scene::kMostTerms> gaps;
  std::size_t gap_count = 0;
  for (std::size_t i = first.perturbations > 0 ? 1 : 0; i < part.terms; ++i) {
    Roots& roots = gaps[gap_count];
    roots = RootsOf(Along(implicit.terms[part.first_term + i].quadric, ray));
    const M has_gap = CutTo(roots, stay);
    lanes = lanes & (stay.from < stay.to);
    if (hn::AllFalse(d, lanes)) return Constant(kNowhere);
    gap_count += hn::AllFalse(d, has_gap & lanes) ? 0 : 1;
  }
  V u = stay.from;
  if (part.table != RayPart::kNoTable) {
    const RayTable& table = implicit.tables[static_cast<std::size_t>(part.table)];
    for (std::size_t pass = 0; pass < 2 * scene::kMostTerms; ++pass) {
      const V under = NextUnder(table, ray, u, stay.to, lanes);
      u = under;
      for (std::size_t i = 0; i < gap_count; ++i) u = NextInside(gaps[i], u);
      if (hn::AllFalse(d, lanes & ((u > under) & (u < stay.to)))) break;
    }
    return u;
  }
  if (first.perturbations == 0) {
    for (std::size_t pass = 0; pass < gap_count; ++pass)
      for (std::size_t i = 0; i < gap_count; ++i) u = NextInside(gaps[i], u);
    return u;
  }
  const TermAlong term = TermOf(implicit, first, ray);
  const Roots base = RootsOf(term.base);
  const Perturbed along = PerturbedOf(term);
  for (std::size_t pass = 0; pass < 2 * scene::kMostTerms; ++pass) {
    const V before = u;
    u = WalkInside(term, base, along, u, stay.to, least_step, lanes);
    for (std::size_t i = 0; i < gap_count; ++i) u = NextInside(gaps[i], u);
    const M moved = lanes & ((u > before) & (u < stay.to));
    if (gap_count == 0 || hn::AllFalse(d, moved)) break;
  }
  return u;
}

HWY_INLINE RayPacket StraightRays(const RayBlock& block, V x, V y) {
  const V3 dx = Constant(block.ray_dx), dy = Constant(block.ray_dy);
  const V3 aside = {MulAdd(dx.x, x, dy.x * y), MulAdd(dx.y, x, dy.y * y),
                    MulAdd(dx.z, x, dy.z * y)};
  return {MulAdd(aside, Constant(block.middle_depth_m), Constant(block.middle)),
          {aside.x + block.ray.x, aside.y + block.ray.y, aside.z + block.ray.z}};
}

// Snell's law keeps the horizontal part of a ray whose depth is that of what it shows.
HWY_INLINE RayPacket RaysBeyondWater(const RayBlock& block, V x, V y, V& from) {
  const BentRays& bent = *block.bent;
  const V3 ray =
      MulAdd(Constant(bent.ray_dx), x, MulAdd(Constant(bent.ray_dy), y, Constant(bent.ray)));
  const V horizontal2 = MulAdd(ray.x, ray.x, ray.y * ray.y);
  const V length2 = MulAdd(ray.z, ray.z, horizontal2);
  const V beyond2 = MulSub(bent.index2, length2, horizontal2);
  const V meets = (bent.level_rel_m - bent.rise_m) / ray.z;
  const M goes_on = (ray.z * bent.towards > 1e-6f) & ((beyond2 > 0.0f) & (meets > 0.0f));
  from = IfThenElse(goes_on, from, kNowhere);
  const V depth = Constant(block.middle_depth_m);
  const V down = bent.towards * Sqrt(Max(beyond2, 1e-12f));
  const V3 way = {ray.x, ray.y, down};
  const V safe = IfThenElse(goes_on, meets, depth);
  const V3 p = {ray.x * depth, ray.y * depth, MulAdd(depth - safe, down, bent.level_rel_m)};
  return {Turned(bent.implicit_from_world, p - Constant(bent.origin_rel)),
          Turned(bent.implicit_from_world, way)};
}

// Keeps what lies on the planes' sides.
HWY_INLINE void CutOff(const RayBlock& block, const RayPacket& ray, Stay& stay) {
  const D d;
  const V far = Constant(kNowhere), zero = hn::Zero(d);
  for (int i = 0; i < block.plane_count; ++i) {
    const glm::vec4 plane = block.planes[static_cast<std::size_t>(i)];
    const V over = Dot(ray.p, Constant(glm::vec3(plane))) + plane.w;
    const V rise = Dot(ray.d, Constant(glm::vec3(plane)));
    const V at = -over / IfThenElse(rise == zero, 1.0f, rise);
    const V from = IfThenElse(rise > zero, at, -far);
    const M is_level = rise == zero;
    const V to = IfThenElse(rise < zero, at, far);
    stay.from = Max(stay.from, from);
    stay.to = Min(stay.to, IfThenElse(is_level & (over < zero), -far, to));
  }
}

HWY_INLINE void CastPacket(const ListedParts& parts, const RayBlock& block, const float* x,
                           const float* y, float* z, std::uint32_t* primitive) {
  const PosedImplicit& implicit = parts.implicit;
  const D d;
  const DU du;
  Stay whole = {Constant(block.near_m - block.middle_depth_m), Constant(kNowhere)};
  const V x_px = hn::LoadU(d, x), y_px = hn::LoadU(d, y);
  const RayPacket rays =
      block.bent ? RaysBeyondWater(block, x_px, y_px, whole.from) : StraightRays(block, x_px, y_px);
  CutOff(block, rays, whole);
  const V before = hn::LoadU(d, z);
  // What is there already; as far again as rounding goes.
  const V there = 1.0001f * block.near_m / Max(before, 1e-30f);
  whole.to = Min(whole.to, there - block.middle_depth_m);
  const V3 inverse = {Inverse(rays.d.x), Inverse(rays.d.y), Inverse(rays.d.z)};
  V nearest = whole.to;
  auto found = hn::Set(du, 0u);
  M any = hn::FirstN(d, 0);
  for (const std::uint16_t number : parts.number) {
    const RayPart& part = implicit.parts[number];
    const RayPacket ray = {rays.p - Constant(part.middle), rays.d};
    Stay stay = {whole.from, nearest};
    StayAlong(ray.p.x, inverse.x, part.half.x, stay);
    StayAlong(ray.p.y, inverse.y, part.half.y, stay);
    StayAlong(ray.p.z, inverse.z, part.half.z, stay);
    const M passes = stay.from < stay.to;
    if (hn::AllFalse(d, passes)) continue;
    const V u = FirstInside(implicit, part, ray, stay, passes);
    const M met = passes & (u < stay.to);
    nearest = IfThenElse(met, u, nearest);
    found = IfThenElse(hn::RebindMask(du, met), hn::Set(du, parts.first_primitive + number), found);
    any = any | met;
  }
  const V depth = nearest + block.middle_depth_m;
  const V z_found = block.near_m / depth;
  const M shows = any & (z_found > before);
  hn::StoreU(IfThenElse(shows, z_found, before), d, z);
  hn::StoreU(IfThenElse(hn::RebindMask(du, shows), found, hn::LoadU(du, primitive)), du, primitive);
}

void CastRays(const ListedParts& parts, const RayBlock& block, std::span<const float> x,
              std::span<const float> y, std::span<float> z, std::span<std::uint32_t> primitive) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    CastPacket(parts, block, &x[i], &y[i], &z[i], &primitive[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(CastRays);

void cast_rays(const ListedParts& parts, const RayBlock& block, std::span<const float> x,
               std::span<const float> y, std::span<float> z, std::span<std::uint32_t> primitive) {
  HWY_DYNAMIC_DISPATCH(CastRays)(parts, block, x, y, z, primitive);
}

}  // namespace swell::render
#endif
