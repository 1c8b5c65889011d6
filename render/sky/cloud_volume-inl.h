// What a point in a volumetric cloud holds, and rays through clouds.
#if defined(SWELL_RENDER_SKY_CLOUD_VOLUME_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUD_VOLUME_INL_H_
#undef SWELL_RENDER_SKY_CLOUD_VOLUME_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUD_VOLUME_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/volume_clouds.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A cell of a lattice and the place in it.
struct LatticePlace {
  VI cell;
  V part;
};

HWY_INLINE LatticePlace PlaceOnLattice(V x) {
  const V whole = Floor(x);
  return {TruncateToInt(whole), x - whole};
}

// The 64 bits that begin at an entry of a table: their lower and upper halves.
struct WordHalves {
  VI lower, upper;
};

template <class Entry>
HWY_INLINE WordHalves LoadWords(const std::vector<Entry>& entries, VI at) {
  namespace packed = texture::HWY_NAMESPACE;
  const hn::Repartition<std::int8_t, D> bytes;
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(D())];
  packed::StoreIndex(at, lane_index);
  const auto half0 = packed::LoadWords<sizeof(Entry), 0>(bytes, entries.data(), lane_index);
  const auto half1 = packed::LoadWords<sizeof(Entry), 1>(bytes, entries.data(), lane_index);
  return {packed::EvenParts(DI(), half0, half1), packed::OddParts(DI(), half0, half1)};
}

// Where the entry of a place stands in a table of 2^n x (2^n + 1) to a level.
HWY_INLINE VI EntryAt(VI x, VI y, VI z, int n) {
  const VI wrap = hn::Set(DI(), (1 << n) - 1);
  const VI row = hn::ShiftLeftSame(z, n) + (y & wrap);
  return hn::ShiftLeftSame(row, n) + row + (x & wrap);
}

// Weights of an interpolation between entries and between the halves of each, as multiples of
// 1 / 128 in both halves of a lane.
using Halves = hn::Repartition<std::int16_t, D>;
struct HalfWeights {
  hn::Vec<Halves> entries, halves;  // halves: 1 - part in the lower half, part in the upper
};

HWY_INLINE HalfWeights WeightsOf(V part_of_entries, V part_of_halves) {
  const VI x = TruncateToInt(part_of_entries * 128.0f);
  const VI y = TruncateToInt(part_of_halves * 128.0f);
  const VI both = hn::ShiftLeft<16>(y) + 128 - y;
  return {hn::BitCast(Halves(), hn::ShiftLeft<16>(x) | x), hn::BitCast(Halves(), both)};
}

// Between two entries of four bytes, and between the halves of each: what that is of the even and
// of the odd bytes, [0, 255 * 128^2].
struct BytesBetween {
  V even, odd;
};

HWY_INLINE BytesBetween BetweenEntries(const WordHalves& word, const HalfWeights& weights) {
  const DI di;
  const Halves dh;
  const VI low = hn::Set(di, 0x00ff00ff);
  const auto between = [&](VI a, VI b) HWY_ATTR {
    const auto first = hn::BitCast(dh, a & low), next = hn::BitCast(dh, b & low);
    const auto mixed = hn::ShiftLeft<7>(first) + (next - first) * weights.entries;
    VI rest = hn::Zero(di);
    const VI sum = hn::ReorderWidenMulAccumulate(di, mixed, weights.halves, hn::Zero(di), rest);
    return hn::ConvertTo(D(), hn::RearrangeToOddPlusEven(sum, rest));
  };
  return {between(word.lower, word.upper),
          between(hn::ShiftRight<8>(word.lower), hn::ShiftRight<8>(word.upper))};
}
constexpr float kPerCorner = 1.0f / (255.0f * 128.0f * 128.0f);

// A volume at (x, y, z), in points, as a part of 255; above and below as at its ends.
HWY_INLINE V SampleCorners(const CornerVolume& volume, V x, V y, V z) {
  const LatticePlace px = PlaceOnLattice(x), py = PlaceOnLattice(y);
  const LatticePlace pz =
      PlaceOnLattice(Clamp(z, 0.0f, static_cast<float>(volume.levels) - 1.001f));
  const WordHalves word =
      LoadWords(volume.entries, EntryAt(px.cell, py.cell, pz.cell, volume.side_log2));
  const BytesBetween levels = BetweenEntries(word, WeightsOf(px.part, py.part));
  return Lerp(levels.even, levels.odd, pz.part) * kPerCorner;
}

// Small forms at a place in their points, which repeat along all axes.
HWY_INLINE V SampleDetail(const CornerVolume& detail, V x, V y, V z) {
  const auto side = static_cast<float>(detail.side());
  const V turns = Floor(z * (1.0f / side));
  return SampleCorners(detail, x, y, NegMulAdd(turns, side, z));
}

HWY_INLINE V ColumnsAt(const CloudVolume& volume, V x, V y) {
  const D d;
  const LatticePlace px = PlaceOnLattice(x), py = PlaceOnLattice(y);
  const WordHalves word =
      LoadWords(volume.columns, EntryAt(px.cell, py.cell, hn::Zero(DI()), CloudVolume::kSideLog2));
  const auto along_y = [&](VI pair) HWY_ATTR {
    const V low = hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
    return Lerp(low, hn::ConvertTo(d, hn::ShiftRight<16>(pair)), py.part);
  };
  return Lerp(along_y(word.lower), along_y(word.upper), px.part) * volume.column_step;
}

// What of the form at a place in voxels changes evenly from point to point: of a layer, without its
// profile, base and top.
HWY_INLINE V BodyAt(const CloudVolume& volume, V x, V y, V z) {
  if (!volume.is_layer())
    return MulAdd(SampleCorners(volume.form, x, y, z), kFormHigh - kFormLow, kFormLow);
  const V level = Clamp(z, 0.0f, static_cast<float>(volume.form.levels - 1));
  const V points = Constant(volume.level_m / static_cast<float>(volume.voxel_m));
  const V bulges = SampleDetail(volume.detail, x, y, level * points);
  return MulAdd(bulges, volume.bulge, ColumnsAt(volume, x, y));
}

// The form of a body at a height in levels.
HWY_INLINE V FormOf(const CloudVolume& volume, V body, V z) {
  if (!volume.is_layer()) return body;
  const auto top = static_cast<float>(volume.form.levels - 1);
  const V level = Clamp(z, 0.0f, top);
  const V height = level * (1.0f / top);
  const V lean = MulAdd(height, 1.0f - volume.towers, volume.towers);
  const V profile = lean * lean * height;
  const V inside = Min(level, top - level);
  return Min(NegMulAdd(profile, volume.rise, body), inside * (volume.limit_per_m * volume.level_m));
}

// The form at a place in voxels.
HWY_INLINE V FormAt(const CloudVolume& volume, V x, V y, V z) {
  return FormOf(volume, BodyAt(volume, x, y, z), z);
}

constexpr float kMeanSmall = 0.33f;  // of small forms

// The density of a form with small forms, as a part of the greatest.
HWY_INLINE V DensityOf(const CloudVolume& volume, V form, V small) {
  const V left = NegMulAdd(1.0f - small, volume.cut, form);
  const float scale = 1.0f / (1.0f - volume.threshold);
  // Thin at first: an edge that is soft for the rays, some pixels apart, that look for it.
  const V inside = Clamp(left, 0.0f, 1.0f), density = inside * inside;
  return Clamp(MulSub(density, scale, volume.threshold * scale), 0.0f, 1.0f);
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
    const V x = MulAdd(d.x, t, place.x), y = MulAdd(d.y, t, place.y);
    const V z = MulAdd(d.z, t, place.z);
    V density = DensityOf(volume, FormAt(volume, x, y, z), Constant(kMeanSmall));
    auto inside = (z >= 0.0f) & (z <= highest);
    if (!volume.repeats) {
      const V zero = hn::Zero(D());
      inside = inside & (((x >= zero) & (x <= most)) & ((y >= zero) & (y <= most)));
    }
    density = IfThenElseZero(inside, density);
    depth = MulAdd(density, volume.extinction_per_m * length_m, depth);
    begin_m += length_m;
    length_m *= growth;
  }
  return depth;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
