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

HWY_INLINE WordHalves LoadWords(const std::vector<std::uint64_t>& words, VI at) {
  namespace packed = texture::HWY_NAMESPACE;
  const hn::Repartition<std::int8_t, D> bytes;
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(D())];
  packed::StoreIndex(at, lane_index);
  const auto half0 = packed::LoadWords<8, 0>(bytes, words.data(), lane_index);
  const auto half1 = packed::LoadWords<8, 1>(bytes, words.data(), lane_index);
  return {packed::EvenParts(DI(), half0, half1), packed::OddParts(DI(), half0, half1)};
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
  const WordHalves word = LoadWords(volume.words, WordAt(px, py, pz, volume.side_log2));
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
  const WordHalves word = LoadWords(volume.columns, WordAt(px, py, level, CloudVolume::kSideLog2));
  const auto along_x = [&](VI pair) HWY_ATTR {
    const V left = hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
    return Lerp(left, hn::ConvertTo(d, hn::ShiftRight<16>(pair)), px.part);
  };
  return hn::Mul(Lerp(along_x(word.lower), along_x(word.upper), py.part),
                 Constant(volume.column_step));
}

// What of the form at a place in voxels changes evenly from point to point: of a layer, without its
// profile, base and top.
HWY_INLINE V BodyAt(const CloudVolume& volume, V x, V y, V z) {
  if (!volume.is_layer())
    return hn::MulAdd(SampleCorners(volume.form, x, y, z), Constant(kFormHigh - kFormLow),
                      Constant(kFormLow));
  const V level = Clamp(z, 0.0f, static_cast<float>(volume.form.levels - 1));
  const V points = Constant(volume.level_m / static_cast<float>(volume.voxel_m));
  const V bulges = SampleDetail(volume.detail, x, y, hn::Mul(level, points));
  return hn::MulAdd(bulges, Constant(volume.bulge), ColumnsAt(volume, x, y));
}

// The form of a body at a height in levels.
HWY_INLINE V FormOf(const CloudVolume& volume, V body, V z) {
  if (!volume.is_layer()) return body;
  const auto top = static_cast<float>(volume.form.levels - 1);
  const V level = Clamp(z, 0.0f, top);
  const V height = hn::Mul(level, Constant(1.0f / top));
  const V lean = hn::MulAdd(height, Constant(1.0f - volume.towers), Constant(volume.towers));
  const V profile = hn::Mul(hn::Mul(lean, lean), height);
  const V inside = hn::Min(level, hn::Sub(Constant(top), level));
  return hn::Min(hn::NegMulAdd(profile, Constant(volume.rise), body),
                 hn::Mul(inside, Constant(volume.limit_per_m * volume.level_m)));
}

// The form at a place in voxels.
HWY_INLINE V FormAt(const CloudVolume& volume, V x, V y, V z) {
  return FormOf(volume, BodyAt(volume, x, y, z), z);
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

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
