#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/open_sea/sea.h"

// A patch position is a 16.16 fixed-point number of samples: whole samples pick the cell, 16
// fraction bits are the bilinear weight, and a power-of-two patch wraps by a mask.

#ifndef SWELL_OCEAN_SAMPLE_FIELD  // this file is compiled once a target
#define SWELL_OCEAN_SAMPLE_FIELD
namespace swell::ocean {
namespace {

// kSomePacked: heights, of which those of some patches are packed.
enum class Field { kHeight, kSomePacked, kSlopeX, kSlopeY };

constexpr bool is_height(Field field) {
  return field == Field::kHeight || field == Field::kSomePacked;
}

bool has_packed_heights(const SeaFrame& frame) {
  return std::ranges::any_of(frame.patches,
                             [](const PatchFrame& patch) { return !patch.height_quads.empty(); });
}

const float* patch_samples(const PatchFrame& patch, Field field) {
  if (is_height(field)) return patch.height_m.data();
  return field == Field::kSlopeX ? patch.slope_x.data() : patch.slope_y.data();
}

// Returns the amplitude of A sin(phase), or of its derivative 2 pi k A cos(phase) along an axis.
float sine_amplitude(const SineFrame& sine, Field field) {
  if (is_height(field)) return static_cast<float>(sine.amplitude_m);
  const double cycles_per_m = field == Field::kSlopeX ? sine.cycles_per_m.x : sine.cycles_per_m.y;
  return static_cast<float>(2.0 * kPi * cycles_per_m * sine.amplitude_m);
}

// What takes metres to 16.16 samples of a patch, and those to periods.
struct PatchScale {
  glm::dvec2 fixed_per_m;
  double fixed_size, periods_per_fixed;
};

PatchScale scale_of(const PatchFrame& patch) {
  const double fixed_size = 65536.0 * patch.resolution;
  return {fixed_size / patch.length_m, fixed_size, 1.0 / fixed_size};
}

// Where an origin lies along one axis of a patch: 16.16 samples in [0, resolution], and the period.
struct OriginPlace {
  int fx16 = 0, period = 0;
  float periods_per_m = 0.0f;
};

struct OriginPlaces {
  OriginPlace x, y;
};

}  // namespace
}  // namespace swell::ocean
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/open_sea/sample_heights_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "ocean/open_sea/patch_tiles-inl.h"
#include "ocean/spectrum/vectors-inl.h"
#include "texture/packed_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

// As many doubles as V has floats.
struct DoublePacket {
  VDouble low, high;
};

// Places along one axis: 16.16 samples, and by how many periods they have been moved into the
// patch.
struct FixedPlace {
  VI fx16, period;
};

struct HalfFixedPlace {
  hn::Vec<DHalfInt> fx16, period;
};

// x in metres to 16.16 samples modulo the patch; periods modulo 2^16.
HWY_INLINE HalfFixedPlace HalfFixedPosition(VDouble x_m, double fixed_per_m,
                                            const PatchScale& scale) {
  const DDouble dd;
  const auto u = hn::Round(x_m * hn::Set(dd, fixed_per_m));
  const auto wraps = Floor(u * hn::Set(dd, scale.periods_per_fixed));
  const auto turns = Floor(wraps * hn::Set(dd, 1.0 / 65536.0));
  const auto period = NegMulAdd(turns, hn::Set(dd, 65536.0), wraps);
  return {hn::DemoteTo(DHalfInt(), NegMulAdd(wraps, hn::Set(dd, scale.fixed_size), u)),
          hn::DemoteTo(DHalfInt(), period)};
}

HWY_INLINE FixedPlace FixedPosition(DoublePacket x_m, double fixed_per_m, const PatchScale& scale) {
  const HalfFixedPlace low = HalfFixedPosition(x_m.low, fixed_per_m, scale);
  const HalfFixedPlace high = HalfFixedPosition(x_m.high, fixed_per_m, scale);
  return {hn::Combine(DI(), high.fx16, low.fx16), hn::Combine(DI(), high.period, low.period)};
}

// Four samples, at the corners of a cell: its left and right, lower and upper ones.
struct Corners {
  V h00, h10, h01, h11;
};

HWY_INLINE V BetweenCorners(const Corners& c, VI x_fx16, VI y_fx16) {
  const D d;
  const VI fraction_bits = hn::Set(DI(), 0xffff);
  const V unit = hn::Set(d, 0x1p-16f);
  const V fx = hn::ConvertTo(d, x_fx16 & fraction_bits) * unit;
  const V fy = hn::ConvertTo(d, y_fx16 & fraction_bits) * unit;
  const V h0 = MulAdd(fx, c.h10 - c.h00, c.h00);
  const V h1 = MulAdd(fx, c.h11 - c.h01, c.h01);
  return MulAdd(fy, h1 - h0, h0);
}

// A sample of packed heights: one load of 64 bits a lane.
HWY_INLINE V QuadSample(const PatchFrame& patch, VI x_fx16, VI y_fx16) {
  namespace packed = texture::HWY_NAMESPACE;
  const D d;
  const DI di;
  const VI mask = hn::Set(di, patch.resolution - 1);
  const VI column = hn::ShiftRight<16>(x_fx16) & mask, row = hn::ShiftRight<16>(y_fx16) & mask;
  HWY_ALIGN std::uint32_t lane_index[hn::MaxLanes(d)];
  packed::StoreIndex(row * patch.resolution + column, lane_index);
  const hn::Repartition<std::uint8_t, D> d8;
  const auto quads0 = packed::LoadWords<8, 0>(d8, patch.height_quads.data(), lane_index);
  const auto quads1 = packed::LoadWords<8, 1>(d8, patch.height_quads.data(), lane_index);
  const VI lower = packed::EvenParts(di, quads0, quads1);
  const VI upper = packed::OddParts(di, quads0, quads1);
  const auto left = [&](VI pair) HWY_ATTR {
    return hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
  };
  const auto right = [&](VI pair) HWY_ATTR { return hn::ConvertTo(d, hn::ShiftRight<16>(pair)); };
  const Corners steps = {left(lower), right(lower), left(upper), right(upper)};
  return BetweenCorners(steps, x_fx16, y_fx16) * patch.height_step_m;
}

// Bilinear sample of a field at 16.16 positions (any integers: they wrap).
template <Field kField>
HWY_INLINE V PatchSample(const PatchFrame& patch, VI x_fx16, VI y_fx16) {
  const D d;
  const DI di;
  if (kField == Field::kSomePacked && !patch.height_quads.empty())
    return QuadSample(patch, x_fx16, y_fx16);
  const VI mask = hn::Set(di, patch.resolution - 1), one = hn::Set(di, 1);
  const VI x0 = hn::ShiftRight<16>(x_fx16) & mask;
  const VI y0 = hn::ShiftRight<16>(y_fx16) & mask;
  const VI x1 = (x0 + one) & mask;
  const VI row0 = y0 * patch.resolution;
  const VI row1 = ((y0 + one) & mask) * patch.resolution;

  const float* const samples = patch_samples(patch, kField);
  const Corners corners = {
      hn::GatherIndex(d, samples, row0 + x0), hn::GatherIndex(d, samples, row0 + x1),
      hn::GatherIndex(d, samples, row1 + x0), hn::GatherIndex(d, samples, row1 + x1)};
  return BetweenCorners(corners, x_fx16, y_fx16);
}

// The tiles' share in a field: a slope has the slope of their weights times their height as well.
template <Field kField>
HWY_INLINE V AddTile(const PatchFrame& patch, const TileWeight<V>& tile, VI x_fx16, VI y_fx16,
                     V sum) {
  sum = MulAdd(tile.weight, PatchSample<kField>(patch, x_fx16, y_fx16), sum);
  if constexpr (is_height(kField)) return sum;
  constexpr bool kAlongX = kField == Field::kSlopeX;
  const double length_m = kAlongX ? patch.length_m.x : patch.length_m.y;
  const V per_m = hn::Set(D(), static_cast<float>(1.0 / length_m));
  const V slope = (kAlongX ? tile.slope_x : tile.slope_y) * per_m;
  return MulAdd(slope, PatchSample<Field::kHeight>(patch, x_fx16, y_fx16), sum);
}

// Sample of a field whose patch is tiled, at places in [0, resolution] of their periods.
template <Field kField>
HWY_INLINE V TiledSample(const PatchFrame& patch, FixedPlace x, FixedPlace y) {
  const D d;
  const DI di;
  const V unit = hn::Set(d, 0x1p-16f / static_cast<float>(patch.resolution));
  const SquarePlace<D> place = {x.period, y.period, hn::ConvertTo(d, x.fx16) * unit,
                                hn::ConvertTo(d, y.fx16) * unit};
  const RowPlace<D> in_row = PlaceInRow(d, place, place.row);
  const auto moved = [](VI at_fx16, VI samples)
                         HWY_ATTR { return at_fx16 + hn::ShiftLeft<16>(samples); };
  if (AllInOneTile(d, in_row, place.y)) {
    const auto by = OffsetOfTile(di, patch.tiling.seed, in_row.column, place.row, patch.resolution);
    return PatchSample<kField>(patch, moved(x.fx16, by.x), moved(y.fx16, by.y));
  }
  V sum = hn::Zero(d);
  ForEachTile(d, patch.tiling, patch.resolution, place,
              [&](TileOffset<VI> by, const TileWeight<V>& tile) HWY_ATTR {
                sum = AddTile<kField>(patch, tile, moved(x.fx16, by.x), moved(y.fx16, by.y), sum);
              });
  return sum;
}

template <Field kField>
HWY_INLINE V FieldSample(const PatchFrame& patch, FixedPlace x, FixedPlace y) {
  return patch.tiling.on ? TiledSample<kField>(patch, x, y)
                         : PatchSample<kField>(patch, x.fx16, y.fx16);
}

HWY_INLINE hn::Vec<DHalf> HalfSineTurns(const SineFrame& sine, VDouble x_m, VDouble y_m) {
  const DDouble dd;
  const auto along_y = MulAdd(hn::Set(dd, sine.cycles_per_m.y), y_m, hn::Set(dd, sine.cycles));
  const auto turns = MulAdd(hn::Set(dd, sine.cycles_per_m.x), x_m, along_y);
  return hn::DemoteTo(DHalf(), turns - hn::Round(turns));
}

// Adds the sine waves; their phases are exact to double.
template <Field kField>
HWY_INLINE V AddSines(std::span<const SineFrame> sines, DoublePacket x_m, DoublePacket y_m, V sum) {
  const D d;
  for (const SineFrame& sine : sines) {
    const V turns = hn::Combine(d, HalfSineTurns(sine, x_m.high, y_m.high),
                                HalfSineTurns(sine, x_m.low, y_m.low));
    V s, c;
    swell::HWY_NAMESPACE::SinCosTurns(d, turns, s, c);
    const V amplitude = hn::Set(d, sine_amplitude(sine, kField));
    sum = MulAdd(amplitude, is_height(kField) ? s : c, sum);
  }
  return sum;
}

// One packet of world points.
template <Field kField>
HWY_INLINE V WorldPacket(const SeaFrame& frame, std::span<const PatchScale> scales,
                         const glm::dvec2* p_world) {
  const DDouble dd;
  const double* const p = &p_world->x;
  DoublePacket x, y;
  hn::LoadInterleaved2(dd, p, x.low, y.low);
  hn::LoadInterleaved2(dd, p + 2 * hn::Lanes(dd), x.high, y.high);
  V sum = hn::Zero(D());
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const PatchScale& scale = scales[i];
    sum = sum + FieldSample<kField>(frame.patches[i], FixedPosition(x, scale.fixed_per_m.x, scale),
                                    FixedPosition(y, scale.fixed_per_m.y, scale));
  }
  return AddSines<kField>(frame.sines, x, y, sum);
}

// origin + an offset in metres as 16.16 samples modulo the patch. Wrapped before it is scaled up:
// it has to fit.
HWY_INLINE FixedPlace FixedOffset(V offset_m, const PatchFrame& patch, OriginPlace origin) {
  const V patches = offset_m * origin.periods_per_m;
  const V whole = Floor(patches);
  const float fixed_size = 65536.0f * static_cast<float>(patch.resolution);
  const VI fraction = RoundToInt((patches - whole) * fixed_size);
  const VI sum = fraction + origin.fx16;
  const VI wraps = hn::ShiftRight<16>(
      hn::ShiftRightSame(sum, std::countr_zero(static_cast<unsigned>(patch.resolution))));
  const VI period = TruncateToInt(whole) + wraps + origin.period;
  const VI fx16 = sum & (65536 * patch.resolution - 1);
  return {fx16, period};
}

HWY_INLINE DoublePacket WorldCoordinate(double origin, V offset) {
  const DDouble dd;
  const DHalf dh;
  const auto base = hn::Set(dd, origin);
  return {base + hn::PromoteTo(dd, hn::LowerHalf(dh, offset)),
          base + hn::PromoteTo(dd, hn::UpperHalf(dh, offset))};
}

// One packet of points around an origin, which lies at these places in the patches.
template <Field kField>
HWY_INLINE V OffsetPacket(const SeaFrame& frame, glm::dvec2 origin, const OriginPlaces* places,
                          const glm::vec2* offsets) {
  const D d;
  V x, y;
  hn::LoadInterleaved2(d, &offsets->x, x, y);
  V height = hn::Zero(d);
  for (const PatchFrame& patch : frame.patches) {
    height = height + FieldSample<kField>(patch, FixedOffset(x, patch, places->x),
                                          FixedOffset(y, patch, places->y));
    ++places;
  }
  if (frame.sines.empty()) return height;
  return AddSines<kField>(frame.sines, WorldCoordinate(origin.x, x), WorldCoordinate(origin.y, y),
                          height);
}

// Calls packet(points) for full packets, then once more for what is left, filled up with zeros.
template <class Point, class Packet>
HWY_INLINE void ForPackets(std::span<const Point> points, float* height_m, Packet packet) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= points.size(); i += lanes) {
    hn::StoreU(packet(points.data() + i), d, height_m + i);
  }
  if (i == points.size()) return;
  std::array<Point, hn::MaxLanes(D())> last{};
  alignas(64) std::array<float, hn::MaxLanes(D())> last_height;
  std::copy(points.begin() + static_cast<std::ptrdiff_t>(i), points.end(), last.begin());
  hn::StoreU(packet(last.data()), d, last_height.data());
  std::copy_n(last_height.begin(), points.size() - i, height_m + i);
}

template <Field kField>
void SampleField(const SeaFrame& frame, std::size_t patches, std::span<const glm::dvec2> p_world,
                 float* samples) {
  SWELL_CHECK(patches <= kMaxPatches, "patches={}", patches);
  std::array<PatchScale, kMaxPatches> all;
  for (std::size_t p = 0; p < patches; ++p) all[p] = scale_of(frame.patches[p]);
  const std::span<const PatchScale> scales(all.data(), patches);
  ForPackets(p_world, samples,
             [&](const glm::dvec2* p) HWY_ATTR { return WorldPacket<kField>(frame, scales, p); });
}

void SampleWorld(const SeaFrame& frame, std::size_t patches, std::span<const glm::dvec2> p_world,
                 float* height_m) {
  if (has_packed_heights(frame))
    return SampleField<Field::kSomePacked>(frame, patches, p_world, height_m);
  SampleField<Field::kHeight>(frame, patches, p_world, height_m);
}

void SampleSlopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world, float* slope_x,
                  float* slope_y) {
  SampleField<Field::kSlopeX>(frame, frame.patches.size(), p_world, slope_x);
  SampleField<Field::kSlopeY>(frame, frame.patches.size(), p_world, slope_y);
}

void SampleOffsets(const SeaFrame& frame, glm::dvec2 origin, const OriginPlaces* places,
                   std::span<const glm::vec2> offsets, float* height_m) {
  if (has_packed_heights(frame))
    return ForPackets(offsets, height_m, [&](const glm::vec2* p) HWY_ATTR {
      return OffsetPacket<Field::kSomePacked>(frame, origin, places, p);
    });
  ForPackets(offsets, height_m, [&](const glm::vec2* p) HWY_ATTR {
    return OffsetPacket<Field::kHeight>(frame, origin, places, p);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {
namespace {

OriginPlace origin_place(double x_m, double length_m, int resolution) {
  const double patches = x_m / length_m, whole = std::floor(patches);
  return {static_cast<int>(std::nearbyint((patches - whole) * 65536.0 * resolution)),
          tile_number(whole), static_cast<float>(1.0 / length_m)};
}

}  // namespace

HWY_EXPORT(SampleWorld);
HWY_EXPORT(SampleOffsets);
HWY_EXPORT(SampleSlopes);

void sample_heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m, std::size_t longest_patches) {
  SWELL_CHECK(p_world.size() == height_m.size(), "{} points, {} heights", p_world.size(),
              height_m.size());
  HWY_DYNAMIC_DISPATCH(SampleWorld)
  (frame, std::min(longest_patches, frame.patches.size()), p_world, height_m.data());
}

void sample_slopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                   std::span<float> slope_x, std::span<float> slope_y) {
  SWELL_CHECK(p_world.size() == slope_x.size() && p_world.size() == slope_y.size(),
              "{} points, {} and {} slopes", p_world.size(), slope_x.size(), slope_y.size());
  HWY_DYNAMIC_DISPATCH(SampleSlopes)(frame, p_world, slope_x.data(), slope_y.data());
}

void sample_heights(const SeaFrame& frame, glm::dvec2 origin_world,
                    std::span<const glm::vec2> offset_m, std::span<float> height_m) {
  SWELL_CHECK(offset_m.size() == height_m.size(), "{} points, {} heights", offset_m.size(),
              height_m.size());
  SWELL_CHECK(frame.patches.size() <= kMaxPatches, "patches={}", frame.patches.size());
  SWELL_CHECK(std::isfinite(origin_world.x) && std::isfinite(origin_world.y), "origin={},{}",
              origin_world.x, origin_world.y);
  std::array<OriginPlaces, kMaxPatches> places;
  for (std::size_t p = 0; p < frame.patches.size(); ++p) {
    const PatchFrame& patch = frame.patches[p];
    places[p] = {origin_place(origin_world.x, patch.length_m.x, patch.resolution),
                 origin_place(origin_world.y, patch.length_m.y, patch.resolution)};
  }
  HWY_DYNAMIC_DISPATCH(SampleOffsets)
  (frame, origin_world, places.data(), offset_m, height_m.data());
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
