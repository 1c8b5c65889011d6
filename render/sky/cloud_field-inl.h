// The clouds of a frame along rays from the eye.
#if defined(SWELL_RENDER_SKY_CLOUD_FIELD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUD_FIELD_INL_H_
#undef SWELL_RENDER_SKY_CLOUD_FIELD_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUD_FIELD_INL_H_
#endif

#include "render/sky/cloud_rays-inl.h"
#include "render/sky/cloud_volume-inl.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/sky_maps.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Two lobes. Source: L. G. Henyey, J. L. Greenstein, Diffuse radiation in the galaxy, 1941, eq. 2.
HWY_INLINE V HenyeyGreenstein(V cosine, float g) {
  const V base = MulAdd(cosine, -2.0f * g, 1.0f + g * g);
  return (1.0f - g * g) * 0.0795774715f / (base * Sqrt(base));
}
HWY_INLINE V DropletPhase(V cosine, float part = 1.0f) {
  return MulAdd(HenyeyGreenstein(cosine, 0.8f * part), 0.8f,
                HenyeyGreenstein(cosine, -0.3f * part) * 0.2f);
}

// Light that was scattered more than once counts as two more octaves, which reach deeper and go
// more evenly in all directions. Their weights make a thick cloud send back about what it gets.
// Source: M. Wrenninge, C. Kulla, V. Lundqvist, Oz: The Great and Volumetric, 2013.
constexpr float kOctave1 = 0.7f, kOctave2 = 2.2f;

// How long a way is that goes a length along an axis.
HWY_INLINE V WayAlong(V per_m, float length_m) {
  return length_m / hn::CopySign(Max(Abs(per_m), 1e-9f), per_m);
}

struct FrameCloudField {
  const VolumeClouds& clouds;
  V3 direction;          // unit, in the flat world
  V drop;                // how far the earth sinks under a ray, over distance^2
  V across_x, across_y;  // the way from voxel to voxel [m]
  V phase0, phase1;      // towards the eye

  HWY_INLINE FrameCloudField(const VolumeClouds& c, V3 ray)
      : FrameCloudField(c, ray, DropletPhase(Dot(ray, Constant(c.to_light))),
                        DropletPhase(Dot(ray, Constant(c.to_light)), 0.5f) * kOctave1) {}
  HWY_INLINE FrameCloudField(const VolumeClouds& c, V3 ray, V phase0_, V phase1_)
      : clouds(c),
        direction(ray),
        drop(MulAdd(ray.x, ray.x, ray.y * ray.y) * c.drop_per_m2),
        across_x(WayAlong(ray.x, static_cast<float>(c.volume->voxel_m))),
        across_y(WayAlong(ray.y, static_cast<float>(c.volume->voxel_m))),
        phase0(phase0_),
        phase1(phase1_) {}

  HWY_INLINE V Height(V t) const { return MulAdd(MulAdd(drop, t, direction.z), t, clouds.eye_z); }

  // In voxels.
  HWY_INLINE V3 Place(V t) const {
    const CloudVolume& volume = *clouds.volume;
    const V along = t * static_cast<float>(1.0 / volume.voxel_m);
    return {MulAdd(direction.x, along, clouds.eye_voxel.x),
            MulAdd(direction.y, along, clouds.eye_voxel.y),
            (Height(t) - volume.base_m) * (1.0f / volume.level_m)};
  }

  HWY_INLINE V EmptyUntil(V t) const {
    const DI di;
    const CloudVolume& volume = *clouds.volume;
    if (!clouds.skips_empty) return hn::Zero(D());
    constexpr float kPerVoxel = 1.0f / CloudVolume::kCell;
    const V3 place = Place(t);
    const auto cell_of = [](V x) HWY_ATTR { return Floor(x * kPerVoxel); };
    const V x = cell_of(place.x), y = cell_of(place.y);
    const V z = Clamp(cell_of(place.z), 0.0f, static_cast<float>(volume.cell_levels - 1));
    const VI wrap = hn::Set(di, CloudVolume::kCells - 1);
    const VI row =
        hn::ShiftLeft<CloudVolume::kCellsLog2>(TruncateToInt(z)) + (TruncateToInt(y) & wrap);
    const VI at = hn::ShiftLeft<CloudVolume::kCellsLog2>(row) + (TruncateToInt(x) & wrap);
    const VI bytes = LoadWords(volume.empty, at).lower;
    const V cells = hn::ConvertTo(D(), bytes & 0xff);
    // The faces of the box of empty cells that the ray leaves by.
    const V reach = cells - 1.0f;
    const auto leave = [&](V p, V cell, V m_per_voxel) HWY_ATTR {
      const V ahead = cell + 1.0f + reach, behind = cell - reach;
      const auto forward = m_per_voxel >= 0.0f;
      constexpr float kVoxels = CloudVolume::kCell;
      const V face = IfThenElse(forward, ahead, behind) * kVoxels;
      return Max((face - p) * m_per_voxel, 0.0f);
    };
    const V rise = MulAdd(drop + drop, t, direction.z);
    const V way = Min(Min(leave(place.x, x, across_x), leave(place.y, y, across_y)),
                      leave(place.z, z, WayAlong(rise, volume.level_m)));
    return IfThenElseZero(cells > 0.0f, t + way);
  }

  HWY_INLINE V Body(V t) const {
    const V3 place = Place(t);
    return BodyAt(*clouds.volume, place.x, place.y, place.z);
  }
  HWY_INLINE V Form(V t, V body) const { return FormOf(*clouds.volume, body, Place(t).z); }
  HWY_INLINE hn::Mask<D> MayHold(V form) const { return form > clouds.volume->least_form; }

  HWY_INLINE V Density(V t, V form) const {
    const D d;
    const CloudVolume& volume = *clouds.volume;
    // Far away small forms are too small to see.
    constexpr float kFade_m = 8000.0f;
    const V shown = Clamp(NegMulAdd(t, 1.0f / kFade_m, 2.0f), 0.0f, 1.0f);
    V small = Constant(kMeanSmall);
    if (clouds.small_forms && !hn::AllFalse(d, shown > 0.0f)) {
      const auto points_per_m = static_cast<float>(volume.detail.side() / volume.detail_period_m);
      const V along = t * points_per_m;
      const V x = MulAdd(direction.x, along, clouds.detail_at_eye.x);
      const V y = MulAdd(direction.y, along, clouds.detail_at_eye.y);
      const V z = MulAdd(Height(t), points_per_m, clouds.detail_at_eye.z);
      small = Lerp(small, SampleDetail(volume.detail, x, y, z), shown);
    }
    // The farthest clouds fade away.
    constexpr float kFadeFrom_m = 0.6f * kFarthestCloud_m;
    const V near =
        Clamp((kFarthestCloud_m - t) * (1.0f / (kFarthestCloud_m - kFadeFrom_m)), 0.0f, 1.0f);
    return DensityOf(volume, form, small) * near;
  }

  // Sunlight as it is scattered on to the eye, over the irradiance.
  HWY_INLINE void Light(V t, V& sun, V& sky) const {
    const D d;
    const CloudVolume& volume = *clouds.volume;
    const V3 place = Place(t);
    constexpr int n = CloudVolume::kLightSideLog2;
    const LatticePlace px = PlaceOnLattice(place.x * 0.5f);
    const LatticePlace py = PlaceOnLattice(place.y * 0.5f);
    const LatticePlace pz =
        PlaceOnLattice(Clamp(place.z, 0.0f, static_cast<float>(volume.form.levels) - 1.001f));
    const VI next_row = py.cell + 1;
    const WordHalves row0 = LoadWords(volume.light, EntryAt(px.cell, py.cell, pz.cell, n));
    const WordHalves row1 = LoadWords(volume.light, EntryAt(px.cell, next_row, pz.cell, n));
    const HalfWeights weights = WeightsOf(px.part, pz.part);
    const BytesBetween light0 = BetweenEntries(row0, weights);
    const BytesBetween light1 = BetweenEntries(row1, weights);
    V x1 = Lerp(light0.even, light1.even, py.part) * kPerCorner;
    sky = Lerp(light0.odd, light1.odd, py.part) * kPerCorner;
    if (clouds.rays)
      x1 = Exp(d, DepthTowards(volume, place, clouds.to_light, 8, 20.0f, 1.6f) *
                      (-1.0f / CloudVolume::kLightDepth));
    // x1 = exp(-depth / 8)
    const V x2 = x1 * x1, x4 = x2 * x2, x8 = x4 * x4;
    V first = phase0 * x8;
    // 2 (1 - e^-2d), less where little lies towards the sun.
    if (clouds.powder) first = first * NegMulAdd(x8, x8 * 2.0f, 2.0f);
    sun = MulAdd(phase1, x4, MulAdd(x1, kOctave2 * 0.0795774715f, first));
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
  const V discriminant = MulAdd(drop * 4.0f, h, z * z);
  const auto exists = discriminant >= 0.0f;
  const V root = Sqrt(Max(discriminant, 0.0f));
  // q = -(z + sign(z) root) / 2: roots q / drop and -h / q.
  const V q = (z + hn::CopySign(root, z)) * -0.5f;
  const V tiny = Constant(1e-12f);
  const V safe_q = hn::CopySign(Max(Abs(q), tiny), q);
  const V a = -h / safe_q;
  const V b = q / Max(drop, 1e-14f);
  const V low = Min(a, b), high = Max(a, b);
  first = IfThenElse(exists, Max(Min(low, none), -1e9f), none);
  second = IfThenElse(exists, Max(Min(high, none), -1e9f), none);
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
  const V to_sea = IfThenElse(sea0 > zero, sea0, none);
  CloudWay way;
  if (to_base > 0.0f) {  // below them: up through the base, on through the top
    way = {base1, top1};
    way.begin = IfThenElse(base1 > zero, base1, none);
  } else if (to_top >= 0.0f) {  // among them: out through the base, or the top
    const V down = IfThenElse(base0 > zero, base0, none);
    const V up = IfThenElse(top1 > zero, top1, none);
    // A ray that dips below the base and misses the sea comes up again.
    const V through = IfThenElse(to_sea < none, down, up);
    way = {zero, IfThenElse(down < none, through, up)};
  } else {  // above them: in through the top, out through the base or again the top
    way.begin = IfThenElse(top0 > zero, top0, none);
    const V down = IfThenElse(base0 > zero, base0, none);
    way.end = IfThenElse((down < none) & (to_sea < none), down, top1);
  }
  way.end = Min(Min(way.end, farthest), Min(to_sea, kFarthestCloud_m));
  if (!volume.repeats) {
    const auto most = static_cast<float>(volume.form.side() - 1);
    const auto clip = [&](float at, V per_m) HWY_ATTR {
      const V speed = hn::CopySign(Max(Abs(per_m), 1e-12f), per_m);
      const V a = -at / speed, b = (most - at) / speed;
      way.begin = Max(way.begin, Min(a, b));
      way.end = Min(way.end, Max(a, b));
    };
    const V per_m = Constant(static_cast<float>(1.0 / volume.voxel_m));
    clip(clouds.eye_voxel.x, field.direction.x * per_m);
    clip(clouds.eye_voxel.y, field.direction.y * per_m);
  }
  return way;
}

// Where rays of length 1 are followed up to a distance. What rays around them met first they met at
// `nearest`: forms that fill a step are larger than what lies between rays, so that to look from a
// group of steps before on is enough.
struct CloudRayEnds {
  V begin, end;
  hn::Mask<D> among_clouds;  // else there is nothing
};
HWY_INLINE CloudRayEnds EndsAmongClouds(const VolumeClouds& clouds, const FrameCloudField& field,
                                        V nearest, V farthest) {
  const CloudWay way = WayThroughClouds(clouds, field, farthest);
  const StepGroup met = GroupAt(nearest, clouds.steps);
  const V before = Max(NegMulAdd(met.length, 0.5f, met.first), 0.0f);
  const V begin = Max(way.begin, GroupAt(before, clouds.steps).first);
  return {begin, way.end, way.begin < way.end};
}

// What rays of length 1 see of the clouds up to a distance.
HWY_INLINE CloudLightSeen SeeClouds(const VolumeClouds& clouds, V3 direction, V farthest) {
  const FrameCloudField field(clouds, direction);
  const CloudRayEnds ends = EndsAmongClouds(clouds, field, hn::Zero(D()), farthest);
  return FollowRays(field, ends.begin, ends.end, clouds.steps, clouds.volume->extinction_per_m);
}

// The radiance of what they see.
HWY_INLINE V3 RadianceOf(const VolumeClouds& clouds, const CloudLightSeen& seen) {
  const V deep = seen.opacity - seen.sky;
  return MulAdd(Constant(clouds.sun), seen.sun,
                MulAdd(Constant(clouds.sky), seen.sky, Constant(clouds.ground) * deep));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
