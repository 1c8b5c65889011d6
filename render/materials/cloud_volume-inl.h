// What a point in a volumetric cloud holds, and rays through clouds.
#if defined(SWELL_RENDER_MATERIALS_CLOUD_VOLUME_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CLOUD_VOLUME_INL_H_
#undef SWELL_RENDER_MATERIALS_CLOUD_VOLUME_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CLOUD_VOLUME_INL_H_
#endif

#include "render/materials/volume_clouds.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A cell of a lattice and the place in it.
struct LatticePlace {
  VI cell;
  V part;
};

HWY_INLINE LatticePlace PlaceOnLattice(V x) {
  const V whole = hn::Floor(x);
  return {hn::ConvertTo(DI(), whole), hn::Sub(x, whole)};
}

// Weights of an interpolation along y and z, as multiples of 1 / 128 in both halves of a lane.
using Halves = hn::Repartition<std::int16_t, D>;
struct HalfWeights {
  hn::Vec<Halves> y, z;  // y: 1 - part in the lower half, part in the upper
};

HWY_INLINE HalfWeights WeightsOf(V part_y, V part_z) {
  const DI di;
  const VI y = hn::ConvertTo(di, hn::Mul(part_y, Constant(128.0f)));
  const VI z = hn::ConvertTo(di, hn::Mul(part_z, Constant(128.0f)));
  const VI both = hn::Sub(hn::Add(hn::ShiftLeft<16>(y), hn::Set(di, 128)), y);
  return {hn::BitCast(Halves(), both), hn::BitCast(Halves(), hn::Or(hn::ShiftLeft<16>(z), z))};
}

// Between four bytes of a level and four of the next, each the values at (x, y), (x + 1, y),
// (x, y + 1) and (x + 1, y + 1) from the low byte up; [0, 255 * 128^2].
HWY_INLINE V BetweenCorners(VI level, VI next, V part_x, const HalfWeights& weights) {
  const DI di;
  const Halves dh;
  const VI low = hn::Set(di, 0x00ff00ff);
  const auto at_x = [&](VI a, VI b) HWY_ATTR {
    const auto below = hn::BitCast(dh, hn::And(a, low)), above = hn::BitCast(dh, hn::And(b, low));
    const auto between =
        hn::Add(hn::ShiftLeft<7>(below), hn::Mul(hn::Sub(above, below), weights.z));
    VI rest = hn::Zero(di);
    const VI sum = hn::ReorderWidenMulAccumulate(di, between, weights.y, hn::Zero(di), rest);
    return hn::ConvertTo(D(), hn::RearrangeToOddPlusEven(sum, rest));
  };
  return Lerp(at_x(level, next), at_x(hn::ShiftRight<8>(level), hn::ShiftRight<8>(next)), part_x);
}
constexpr float kPerCorner = 1.0f / (255.0f * 128.0f * 128.0f);

// Words of 64 bits: their lower and upper halves.
struct WordHalves {
  VI lower, upper;
};

HWY_INLINE WordHalves GatherWords(const std::vector<std::uint64_t>& words, VI at) {
  const hn::Repartition<std::int64_t, D> wide;
  const DI di;
  const auto* const from = reinterpret_cast<const std::int64_t*>(words.data());
  const hn::Half<DI> half;
  const auto gather = [&](auto some) HWY_ATTR {
    return hn::BitCast(di, hn::GatherIndex(wide, from, hn::PromoteTo(wide, some)));
  };
  const VI first = gather(hn::LowerHalf(half, at)), second = gather(hn::UpperHalf(half, at));
  return {hn::ConcatEven(di, second, first), hn::ConcatOdd(di, second, first)};
}

// Where the word of a place stands that is made of cells of 2^n x 2^n to a level.
HWY_INLINE VI WordAt(const LatticePlace& x, const LatticePlace& y, const LatticePlace& z, int n) {
  const VI wrap = hn::Set(DI(), (1 << n) - 1);
  const VI row = hn::Add(hn::ShiftLeftSame(z.cell, n), hn::And(y.cell, wrap));
  return hn::Add(hn::ShiftLeftSame(row, n), hn::And(x.cell, wrap));
}

// A volume at (x, y, z), in points, as a part of 255; above and below as at its ends.
HWY_INLINE V SampleCorners(const CornerVolume& volume, V x, V y, V z) {
  const LatticePlace px = PlaceOnLattice(x), py = PlaceOnLattice(y);
  const LatticePlace pz =
      PlaceOnLattice(Clamp(z, 0.0f, static_cast<float>(volume.levels) - 1.001f));
  const WordHalves word = GatherWords(volume.words, WordAt(px, py, pz, volume.side_log2));
  return hn::Mul(BetweenCorners(word.lower, word.upper, px.part, WeightsOf(py.part, pz.part)),
                 Constant(kPerCorner));
}

// Small forms at a place in their points, which repeat along all axes.
HWY_INLINE V SampleDetail(const CornerVolume& detail, V x, V y, V z) {
  const auto side = static_cast<float>(detail.side());
  const V turns = hn::Floor(hn::Mul(z, Constant(1.0f / side)));
  return SampleCorners(detail, x, y, hn::NegMulAdd(turns, Constant(side), z));
}

HWY_INLINE V ColumnsAt(const CloudVolume& volume, V x, V y) {
  const D d;
  const LatticePlace px = PlaceOnLattice(x), py = PlaceOnLattice(y);
  const LatticePlace level = {hn::Zero(DI()), hn::Zero(d)};
  const WordHalves word =
      GatherWords(volume.columns, WordAt(px, py, level, CloudVolume::kSideLog2));
  const auto along_x = [&](VI pair) HWY_ATTR {
    const V left = hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
    return Lerp(left, hn::ConvertTo(d, hn::ShiftRight<16>(pair)), px.part);
  };
  return hn::Mul(Lerp(along_x(word.lower), along_x(word.upper), py.part),
                 Constant(volume.column_step));
}

HWY_INLINE V LayerFormAt(const CloudVolume& volume, V x, V y, V z) {
  const auto top = static_cast<float>(volume.form.levels - 1);
  const V level = Clamp(z, 0.0f, top);
  const V points = Constant(volume.level_m / static_cast<float>(volume.voxel_m));
  const V bulges = SampleDetail(volume.detail, x, y, hn::Mul(level, points));
  const V height = hn::Mul(level, Constant(1.0f / top));
  const V lean = hn::MulAdd(height, Constant(1.0f - volume.towers), Constant(volume.towers));
  const V profile = hn::Mul(hn::Mul(lean, lean), height);
  const V form = hn::NegMulAdd(profile, Constant(volume.rise),
                               hn::MulAdd(bulges, Constant(volume.bulge), ColumnsAt(volume, x, y)));
  const V inside = hn::Min(level, hn::Sub(Constant(top), level));
  return hn::Min(form, hn::Mul(inside, Constant(volume.limit_per_m * volume.level_m)));
}

// The form at a place in voxels.
HWY_INLINE V FormAt(const CloudVolume& volume, V x, V y, V z) {
  if (volume.is_layer()) return LayerFormAt(volume, x, y, z);
  return hn::MulAdd(SampleCorners(volume.form, x, y, z), Constant(kFormHigh - kFormLow),
                    Constant(kFormLow));
}

constexpr float kMeanSmall = 0.33f;  // of small forms

// The density of a form with small forms, as a part of the greatest.
HWY_INLINE V DensityOf(const CloudVolume& volume, V form, V small) {
  const V left = hn::NegMulAdd(hn::Sub(Constant(1.0f), small), Constant(volume.cut), form);
  const float scale = 1.0f / (1.0f - volume.threshold);
  // Thin at first: an edge that is soft for the rays, some pixels apart, that look for it.
  const V inside = Clamp(left, 0.0f, 1.0f), density = hn::Mul(inside, inside);
  return Clamp(hn::MulSub(density, Constant(scale), Constant(volume.threshold * scale)), 0.0f,
               1.0f);
}

// The optical depth from a place in voxels towards `direction` (in the world) over steps that grow.
// Small forms count by their mean.
HWY_INLINE V DepthTowards(const CloudVolume& volume, V3 place, glm::vec3 direction, int steps,
                          float first_m, float growth) {
  const auto voxels_per_m = static_cast<float>(1.0 / volume.voxel_m);
  const glm::vec3 d(direction.x * voxels_per_m, direction.y * voxels_per_m,
                    direction.z / volume.level_m);
  const float most = static_cast<float>(volume.form.side() - 1);
  const float highest = static_cast<float>(volume.form.levels - 1);
  V depth = hn::Zero(D());
  float begin_m = 0.0f, length_m = first_m;
  for (int i = 0; i < steps; ++i) {
    const V t = Constant(begin_m + 0.5f * length_m);
    const V x = hn::MulAdd(Constant(d.x), t, place.x), y = hn::MulAdd(Constant(d.y), t, place.y);
    const V z = hn::MulAdd(Constant(d.z), t, place.z);
    V density = DensityOf(volume, FormAt(volume, x, y, z), Constant(kMeanSmall));
    auto inside = hn::And(hn::Ge(z, hn::Zero(D())), hn::Le(z, Constant(highest)));
    if (!volume.repeats) {
      const V zero = hn::Zero(D());
      inside = hn::And(inside, hn::And(hn::And(hn::Ge(x, zero), hn::Le(x, Constant(most))),
                                       hn::And(hn::Ge(y, zero), hn::Le(y, Constant(most)))));
    }
    density = hn::IfThenElseZero(inside, density);
    depth = hn::MulAdd(density, Constant(volume.extinction_per_m * length_m), depth);
    begin_m += length_m;
    length_m *= growth;
  }
  return depth;
}

// ---- Rays

// What a ray gathers between two distances.
struct CloudLightSeen {
  V opacity;      // the part of what lies behind that is hidden
  V sun, sky;     // sunlight scattered to the eye, over the irradiance, and the part of skylight
  V front, back;  // where clouds begin and end
  V distance;     // their mean distance
};

// Less than this is let through nothing.
constexpr float kLeastPassing = 1.0f / 256.0f;

// The length of steps at a distance: step_m up to far_m, twice as long from there on, and so on.
HWY_INLINE V StepAt(V t, const CloudSteps& steps) {
  const DI di;
  const V ratio = hn::Mul(t, Constant(1.0f / steps.far_m));
  const V power = hn::BitCast(D(), hn::And(hn::BitCast(di, ratio), hn::Set(di, 0x7f800000)));
  return hn::Mul(hn::Max(power, Constant(1.0f)), Constant(steps.step_m));
}

// x rounded down to whole steps, which are powers of two.
HWY_INLINE V WholeSteps(V x, V step) {
  const DI di;
  const V per_step =
      hn::BitCast(D(), hn::Sub(hn::Set(di, 0x7f000000), hn::BitCast(di, step)));  // 1 / step
  return hn::Mul(hn::Floor(hn::Mul(x, per_step)), step);
}

// Follows rays from `begin` to `end`, in steps that lie on a lattice of distances from the eye, the
// first and the last cut. Midpoints are sampled. What a step scatters is its source times what it
// hides, so that light is neither made nor lost whatever the step. A step hides at most 1 - e^-0.5:
// where far steps are longer the extinction is less, as of a cloud seen blurred. kGroup steps at a
// time are passed over or taken, and the light between their ends is interpolated.
//
// `field` says density(t) in [0, 1], light(t, sun, sky) and empty_until(t), a distance up to which
// there is surely nothing, or less than t.
template <class Field>
HWY_INLINE CloudLightSeen FollowRays(const Field& field, V begin, V end, const CloudSteps& steps,
                                     float extinction_per_m) {
  constexpr int kGroup = CloudSteps::kGroup;
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  CloudLightSeen seen = {zero, zero, zero, zero, zero, zero};
  V t = begin, passes = one, last = begin, weighted = zero;
  V known = Constant(-1.0f), sun = zero, sky = zero;  // the light at a distance
  seen.front = end;
  for (;;) {
    const auto active = hn::And(hn::Lt(t, end), hn::Gt(passes, Constant(kLeastPassing)));
    if (hn::AllFalse(d, active)) break;
    const V step = StepAt(t, steps), group = hn::Mul(step, Constant(float{kGroup}));
    const V first = WholeSteps(t, group), next = hn::Add(first, group);
    const V empty_until = field.EmptyUntil(t);
    const V group_there = hn::Mul(StepAt(empty_until, steps), Constant(float{kGroup}));
    const V go_on = hn::Max(next, WholeSteps(empty_until, group_there));
    const auto sampled = hn::And(active, hn::Lt(empty_until, next));
    if (!hn::AllFalse(d, sampled)) {
      // The optical depth of each step.
      const V most = hn::Div(Constant(steps.most_depth), hn::Max(first, Constant(steps.far_m)));
      const V extinction = hn::Min(most, Constant(extinction_per_m));
      V from[kGroup], to[kGroup], depth[kGroup];
      V sum = zero;
      for (int i = 0; i < kGroup; ++i) {
        from[i] = hn::Max(hn::MulAdd(step, Constant(float(i)), first), t);
        to[i] = hn::Min(hn::MulAdd(step, Constant(float(i + 1)), first), end);
        const V middle = hn::Mul(hn::Add(from[i], to[i]), Constant(0.5f));
        const auto here = hn::And(sampled, hn::Lt(from[i], to[i]));
        const V density = hn::IfThenElseZero(here, field.Density(middle, here));
        depth[i] = hn::Mul(hn::Mul(density, extinction), hn::Sub(to[i], from[i]));
        sum = hn::Add(sum, depth[i]);
      }
      const auto some = hn::Gt(sum, zero);
      if (!hn::AllFalse(d, some)) {
        if (!hn::AllFalse(d, hn::AndNot(hn::Eq(known, first), some))) field.Light(first, sun, sky);
        V sun_next, sky_next;
        field.Light(next, sun_next, sky_next);
        const V per_m = hn::Div(one, group);
        for (int i = 0; i < kGroup; ++i) {
          const V middle = hn::Mul(hn::Add(from[i], to[i]), Constant(0.5f));
          const V part = hn::Mul(hn::Sub(middle, first), per_m);
          const V kept = Exp(d, hn::Neg(depth[i]));
          const V hidden = hn::NegMulAdd(passes, kept, passes);
          const auto hides = hn::Gt(hidden, zero);
          seen.sun = hn::MulAdd(hidden, Lerp(sun, sun_next, part), seen.sun);
          seen.sky = hn::MulAdd(hidden, Lerp(sky, sky_next, part), seen.sky);
          weighted = hn::MulAdd(hidden, middle, weighted);
          seen.front = hn::IfThenElse(hides, hn::Min(seen.front, from[i]), seen.front);
          last = hn::IfThenElse(hides, to[i], last);
          passes = hn::Sub(passes, hidden);
        }
        known = next, sun = sun_next, sky = sky_next;
      }
    }
    t = hn::IfThenElse(active, hn::Min(go_on, end), t);
  }
  // What is almost opaque is opaque.
  const V found = hn::Sub(one, passes);
  const auto opaque = hn::Le(passes, Constant(kLeastPassing));
  seen.opacity = hn::IfThenElse(opaque, one, found);
  const V scale = hn::Div(seen.opacity, hn::Max(found, Constant(1e-20f)));
  seen.sun = hn::Mul(seen.sun, scale);
  seen.sky = hn::Mul(seen.sky, scale);
  seen.distance = hn::Div(weighted, hn::Max(found, Constant(1e-20f)));
  seen.back = hn::Max(last, hn::Add(seen.front, one));
  return seen;
}

// ---- The clouds of a frame along rays

// Two lobes. Source: L. G. Henyey, J. L. Greenstein, Diffuse radiation in the galaxy, 1941, eq. 2.
HWY_INLINE V HenyeyGreenstein(V cosine, float g) {
  const V base = hn::MulAdd(cosine, Constant(-2.0f * g), Constant(1.0f + g * g));
  return hn::Div(Constant((1.0f - g * g) * 0.0795774715f), hn::Mul(base, hn::Sqrt(base)));
}
HWY_INLINE V DropletPhase(V cosine, float part = 1.0f) {
  return hn::MulAdd(HenyeyGreenstein(cosine, 0.8f * part), Constant(0.8f),
                    hn::Mul(HenyeyGreenstein(cosine, -0.3f * part), Constant(0.2f)));
}

// Light that was scattered more than once counts as two more octaves, which reach deeper and go
// more evenly in all directions. Their weights make a thick cloud send back about what it gets.
// Source: M. Wrenninge, C. Kulla, V. Lundqvist, Oz: The Great and Volumetric, 2013.
constexpr float kOctave1 = 0.7f, kOctave2 = 2.2f;

// How long a way is that goes a length along an axis.
HWY_INLINE V WayAlong(V per_m, float length_m) {
  return hn::Div(Constant(length_m), hn::CopySign(hn::Max(hn::Abs(per_m), Constant(1e-9f)), per_m));
}

struct FrameCloudField {
  const VolumeClouds& clouds;
  V3 direction;          // unit, in the flat world
  V drop;                // how far the earth sinks under a ray, over distance^2
  V across_x, across_y;  // the way from voxel to voxel [m]
  V phase0, phase1;      // towards the eye

  HWY_INLINE FrameCloudField(const VolumeClouds& c, V3 ray)
      : clouds(c),
        direction(ray),
        drop(hn::Mul(hn::MulAdd(ray.x, ray.x, hn::Mul(ray.y, ray.y)), Constant(c.drop_per_m2))) {
    const auto voxel_m = static_cast<float>(c.volume->voxel_m);
    across_x = WayAlong(ray.x, voxel_m), across_y = WayAlong(ray.y, voxel_m);
    const V cosine = Dot(ray, Constant(c.to_light));
    phase0 = DropletPhase(cosine);
    phase1 = hn::Mul(DropletPhase(cosine, 0.5f), Constant(kOctave1));
  }

  HWY_INLINE V Height(V t) const {
    return hn::MulAdd(hn::MulAdd(drop, t, direction.z), t, Constant(clouds.eye_z));
  }

  // In voxels.
  HWY_INLINE V3 Place(V t) const {
    const CloudVolume& volume = *clouds.volume;
    const V along = hn::Mul(t, Constant(static_cast<float>(1.0 / volume.voxel_m)));
    return {hn::MulAdd(direction.x, along, Constant(clouds.eye_voxel.x)),
            hn::MulAdd(direction.y, along, Constant(clouds.eye_voxel.y)),
            hn::Mul(hn::Sub(Height(t), Constant(volume.base_m)), Constant(1.0f / volume.level_m))};
  }

  HWY_INLINE V EmptyUntil(V t) const {
    const DI di;
    const CloudVolume& volume = *clouds.volume;
    if (!clouds.skips_empty) return hn::Zero(D());
    constexpr float kPerVoxel = 1.0f / CloudVolume::kCell;
    const V3 place = Place(t);
    const auto cell_of = [](V x) HWY_ATTR { return hn::Floor(hn::Mul(x, Constant(kPerVoxel))); };
    const V x = cell_of(place.x), y = cell_of(place.y);
    const V z = Clamp(cell_of(place.z), 0.0f, static_cast<float>(volume.cell_levels - 1));
    const VI wrap = hn::Set(di, CloudVolume::kCells - 1);
    const VI row = hn::Add(hn::ShiftLeft<CloudVolume::kCellsLog2>(hn::ConvertTo(di, z)),
                           hn::And(hn::ConvertTo(di, y), wrap));
    const VI at =
        hn::Add(hn::ShiftLeft<CloudVolume::kCellsLog2>(row), hn::And(hn::ConvertTo(di, x), wrap));
    const auto* const bytes = reinterpret_cast<const std::int32_t*>(volume.empty.data());
    const V cells = hn::ConvertTo(D(), hn::And(hn::GatherOffset(di, bytes, at), hn::Set(di, 0xff)));
    // The faces of the box of empty cells that the ray leaves by.
    const V reach = hn::Sub(cells, Constant(1.0f));
    const auto leave = [&](V p, V cell, V m_per_voxel) HWY_ATTR {
      const V ahead = hn::Add(hn::Add(cell, Constant(1.0f)), reach), behind = hn::Sub(cell, reach);
      const auto forward = hn::Ge(m_per_voxel, hn::Zero(D()));
      constexpr float kVoxels = CloudVolume::kCell;
      const V face = hn::Mul(hn::IfThenElse(forward, ahead, behind), Constant(kVoxels));
      return hn::Max(hn::Mul(hn::Sub(face, p), m_per_voxel), hn::Zero(D()));
    };
    const V rise = hn::MulAdd(hn::Add(drop, drop), t, direction.z);
    const V way = hn::Min(hn::Min(leave(place.x, x, across_x), leave(place.y, y, across_y)),
                          leave(place.z, z, WayAlong(rise, volume.level_m)));
    return hn::IfThenElseZero(hn::Gt(cells, hn::Zero(D())), hn::Add(t, way));
  }

  template <class M>
  HWY_INLINE V Density(V t, M sampled) const {
    const D d;
    const CloudVolume& volume = *clouds.volume;
    const V3 place = Place(t);
    const V form = FormAt(volume, place.x, place.y, place.z);
    if (hn::AllFalse(d, hn::And(sampled, hn::Gt(form, Constant(volume.least_form)))))
      return hn::Zero(d);
    // Far away small forms are too small to see.
    constexpr float kFade_m = 8000.0f;
    const V shown = Clamp(hn::NegMulAdd(t, Constant(1.0f / kFade_m), Constant(2.0f)), 0.0f, 1.0f);
    V small = Constant(kMeanSmall);
    if (!hn::AllFalse(d, hn::Gt(shown, hn::Zero(d)))) {
      const auto points_per_m = static_cast<float>(volume.detail.side() / volume.detail_period_m);
      const V along = hn::Mul(t, Constant(points_per_m));
      const V x = hn::MulAdd(direction.x, along, Constant(clouds.detail_at_eye.x));
      const V y = hn::MulAdd(direction.y, along, Constant(clouds.detail_at_eye.y));
      const V z = hn::MulAdd(Height(t), Constant(points_per_m), Constant(clouds.detail_at_eye.z));
      small = Lerp(small, SampleDetail(volume.detail, x, y, z), shown);
    }
    // The farthest clouds fade away.
    constexpr float kFadeFrom_m = 0.6f * kFarthestCloud_m;
    const V near = Clamp(hn::Mul(hn::Sub(Constant(kFarthestCloud_m), t),
                                 Constant(1.0f / (kFarthestCloud_m - kFadeFrom_m))),
                         0.0f, 1.0f);
    return hn::Mul(DensityOf(volume, form, small), near);
  }

  // Sunlight as it is scattered on to the eye, over the irradiance.
  HWY_INLINE void Light(V t, V& sun, V& sky) const {
    const D d;
    const DI di;
    const CloudVolume& volume = *clouds.volume;
    const V3 place = Place(t);
    constexpr int n = CloudVolume::kLightSideLog2;
    const LatticePlace px = PlaceOnLattice(hn::Mul(place.x, Constant(0.5f)));
    const LatticePlace py = PlaceOnLattice(hn::Mul(place.y, Constant(0.5f)));
    const LatticePlace pz =
        PlaceOnLattice(Clamp(place.z, 0.0f, static_cast<float>(volume.form.levels) - 1.001f));
    const VI at = WordAt(px, py, pz, n);
    const WordHalves here = GatherWords(volume.light, at);
    const WordHalves above = GatherWords(volume.light, hn::Add(at, hn::Set(di, 1 << (2 * n))));
    const HalfWeights weights = WeightsOf(py.part, pz.part);
    V x1 = hn::Mul(BetweenCorners(here.lower, above.lower, px.part, weights), Constant(kPerCorner));
    sky = hn::Mul(BetweenCorners(here.upper, above.upper, px.part, weights), Constant(kPerCorner));
    if (clouds.rays)
      x1 = Exp(d, hn::Mul(DepthTowards(volume, place, clouds.to_light, 8, 20.0f, 1.6f),
                          Constant(-1.0f / CloudVolume::kLightDepth)));
    // x1 = exp(-depth / 8)
    const V x2 = hn::Mul(x1, x1), x4 = hn::Mul(x2, x2), x8 = hn::Mul(x4, x4);
    V first = hn::Mul(phase0, x8);
    // 2 (1 - e^-2d), less where little lies towards the sun.
    if (clouds.powder)
      first = hn::Mul(first, hn::NegMulAdd(x8, hn::Mul(x8, Constant(2.0f)), Constant(2.0f)));
    sun = hn::MulAdd(phase1, x4, hn::MulAdd(x1, Constant(kOctave2 * 0.0795774715f), first));
  }
};

// Between which distances a ray of length 1 is among clouds; end <= begin if it is not.
struct CloudWay {
  V begin, end;
};

// Where a ray over a round earth rises through the height h over the eye's: the smaller and the
// greater root of drop t^2 + z t - h = 0; both far away if there is none.
HWY_INLINE void RootsAtHeight(V z, V drop, float h, V& first, V& second) {
  const V none = Constant(1e9f);
  const V discriminant = hn::MulAdd(hn::Mul(drop, Constant(4.0f)), Constant(h), hn::Mul(z, z));
  const auto exists = hn::Ge(discriminant, hn::Zero(D()));
  const V root = hn::Sqrt(hn::Max(discriminant, hn::Zero(D())));
  // q = -(z + sign(z) root) / 2: roots q / drop and -h / q.
  const V q = hn::Mul(hn::Add(z, hn::CopySign(root, z)), Constant(-0.5f));
  const V tiny = Constant(1e-12f);
  const V safe_q = hn::CopySign(hn::Max(hn::Abs(q), tiny), q);
  const V a = hn::Div(Constant(-h), safe_q);
  const V b = hn::Div(q, hn::Max(drop, Constant(1e-14f)));
  const V low = hn::Min(a, b), high = hn::Max(a, b);
  first = hn::IfThenElse(exists, hn::Max(hn::Min(low, none), Constant(-1e9f)), none);
  second = hn::IfThenElse(exists, hn::Max(hn::Min(high, none), Constant(-1e9f)), none);
}

HWY_INLINE CloudWay WayThroughClouds(const VolumeClouds& clouds, const FrameCloudField& field,
                                     V farthest) {
  const D d;
  const CloudVolume& volume = *clouds.volume;
  const V zero = hn::Zero(d), none = Constant(1e9f);
  const float to_base = volume.base_m - clouds.eye_z, to_top = volume.top_m - clouds.eye_z;
  const V z = field.direction.z;
  V base0, base1, top0, top1, sea0, sea1;
  RootsAtHeight(z, field.drop, to_base, base0, base1);
  RootsAtHeight(z, field.drop, to_top, top0, top1);
  RootsAtHeight(z, field.drop, std::min(-clouds.eye_z, -0.01f), sea0, sea1);
  const V to_sea = hn::IfThenElse(hn::Gt(sea0, zero), sea0, none);
  CloudWay way;
  if (to_base > 0.0f) {  // below them: up through the base, on through the top
    way = {base1, top1};
    way.begin = hn::IfThenElse(hn::Gt(base1, zero), base1, none);
  } else if (to_top >= 0.0f) {  // among them: out through the base, or the top
    const V down = hn::IfThenElse(hn::Gt(base0, zero), base0, none);
    const V up = hn::IfThenElse(hn::Gt(top1, zero), top1, none);
    // A ray that dips below the base and misses the sea comes up again.
    const V through = hn::IfThenElse(hn::Lt(to_sea, none), down, up);
    way = {zero, hn::IfThenElse(hn::Lt(down, none), through, up)};
  } else {  // above them: in through the top, out through the base or again the top
    way.begin = hn::IfThenElse(hn::Gt(top0, zero), top0, none);
    const V down = hn::IfThenElse(hn::Gt(base0, zero), base0, none);
    way.end = hn::IfThenElse(hn::And(hn::Lt(down, none), hn::Lt(to_sea, none)), down, top1);
  }
  way.end = hn::Min(hn::Min(way.end, farthest), hn::Min(to_sea, Constant(kFarthestCloud_m)));
  if (!volume.repeats) {
    const auto most = static_cast<float>(volume.form.side() - 1);
    const auto clip = [&](float at, V per_m) HWY_ATTR {
      const V speed = hn::CopySign(hn::Max(hn::Abs(per_m), Constant(1e-12f)), per_m);
      const V a = hn::Div(Constant(-at), speed), b = hn::Div(Constant(most - at), speed);
      way.begin = hn::Max(way.begin, hn::Min(a, b));
      way.end = hn::Min(way.end, hn::Max(a, b));
    };
    const V per_m = Constant(static_cast<float>(1.0 / volume.voxel_m));
    clip(clouds.eye_voxel.x, hn::Mul(field.direction.x, per_m));
    clip(clouds.eye_voxel.y, hn::Mul(field.direction.y, per_m));
  }
  return way;
}

// What rays of length 1 see of the clouds, up to a distance.
HWY_INLINE CloudLightSeen SeeClouds(const VolumeClouds& clouds, V3 direction, V farthest) {
  const FrameCloudField field(clouds, direction);
  const CloudWay way = WayThroughClouds(clouds, field, farthest);
  return FollowRays(field, way.begin, way.end, clouds.steps, clouds.volume->extinction_per_m);
}

// The radiance of what they see.
HWY_INLINE V3 RadianceOf(const VolumeClouds& clouds, const CloudLightSeen& seen) {
  const V deep = hn::Sub(seen.opacity, seen.sky);
  return ScaleAdd(Constant(clouds.sun), seen.sun,
                  ScaleAdd(Constant(clouds.sky), seen.sky, Scale(Constant(clouds.ground), deep)));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
