#include <algorithm>
#include <array>
#include <cstddef>

#include "ocean/open_sea/crests_kernels.h"
#include "ocean/spectrum/fft.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/open_sea/crests_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ocean/spectrum/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

struct Pair {
  V x, y;
};

// A packet of places in a periodic field: the indices of the four samples around each, and the
// parts of the way from the first of them.
struct Cells {
  VI i00, i10, i01, i11;
  V part_x, part_y;
};

// x, y in samples, of a size below 2^22.
HWY_INLINE Cells CellsAt(int size, V x, V y) {
  const DI di;
  const VI mask = hn::Set(di, size - 1), one = hn::Set(di, 1), width = hn::Set(di, size);
  const V floor_x = Floor(x), floor_y = Floor(y);
  const VI column = hn::ConvertTo(di, floor_x), row = hn::ConvertTo(di, floor_y);
  const VI x0 = column & mask, x1 = (column + one) & mask;
  const VI y0 = (row & mask) * width;
  const VI y1 = ((row + one) & mask) * width;
  return {y0 + x0, y0 + x1, y1 + x0, y1 + x1, x - floor_x, y - floor_y};
}

HWY_INLINE V Bilinear(const Cells& at, const float* samples) {
  const D d;
  const V s00 = hn::GatherIndex(d, samples, at.i00), s10 = hn::GatherIndex(d, samples, at.i10);
  const V s01 = hn::GatherIndex(d, samples, at.i01), s11 = hn::GatherIndex(d, samples, at.i11);
  const V low = MulAdd(at.part_x, s10 - s00, s00);
  const V high = MulAdd(at.part_x, s11 - s01, s01);
  return MulAdd(at.part_y, high - low, low);
}

// Where the water at samples (i.., j) rests, in samples.
HWY_INLINE Cells RestingCells(int size, int i, int j, V samples_per_m, Pair displaced) {
  const D d;
  const V x = hn::Iota(d, static_cast<float>(i)), y = hn::Set(d, static_cast<float>(j));
  return CellsAt(size, NegMulAdd(samples_per_m, displaced.x, x),
                 NegMulAdd(samples_per_m, displaced.y, y));
}

HWY_INLINE V MovedSamples_per_m(const Crests& crests, const PatchFrame& patch) {
  return hn::Set(D(),
                 static_cast<float>(crests.choppiness * (patch.resolution / patch.length_m.x)));
}

void WarpRows(const Crests& crests, const LinearWaves& linear, int first, int last,
              PatchFrame& patch) {
  const D d;
  const int n = patch.resolution;
  const V samples_per_m = MovedSamples_per_m(crests, patch);
  const V rise = hn::Set(d, crests.rise_per_m), half_rise = hn::Set(d, 0.5f * crests.rise_per_m);
  const V mean = hn::Set(d, crests.mean_m), one = hn::Set(d, 1.0f);
  for (int j = first; j < last; ++j) {
    for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(d))) {
      const auto at = static_cast<std::size_t>(j * n + i);
      // X, by steps.
      Pair displaced = {hn::LoadU(d, linear.displacement_x_m + at),
                        hn::LoadU(d, linear.displacement_y_m + at)};
      for (int step = 1; step < kWarpSteps; ++step) {
        const Cells cells = RestingCells(n, i, j, samples_per_m, displaced);
        displaced = {Bilinear(cells, linear.displacement_x_m),
                     Bilinear(cells, linear.displacement_y_m)};
      }
      const Cells cells = RestingCells(n, i, j, samples_per_m, displaced);
      // h + r / 2 (h^2 + |D|^2) - mean, and the gradient of the first two there.
      const V h = Bilinear(cells, linear.height_m);
      const V square = MulAdd(h, h, MulAdd(displaced.x, displaced.x, displaced.y * displaced.y));
      hn::StoreU(MulAdd(half_rise, square, h) - mean, d, &patch.height_m[at]);
      const V gain = MulAdd(rise, h, one);
      hn::StoreU(gain * Bilinear(cells, linear.slope_x), d, &patch.slope_x[at]);
      hn::StoreU(gain * Bilinear(cells, linear.slope_y), d, &patch.slope_y[at]);
      hn::StoreU(displaced.x, d, &patch.displaced_x_m[at]);
      hn::StoreU(displaced.y, d, &patch.displaced_y_m[at]);
    }
  }
}

// A row of a periodic field with samples beyond both ends.
class WrappedRow {
 public:
  WrappedRow(const std::vector<float>& field, int row, int size) {
    const float* const from = field.data() + static_cast<std::size_t>(row) * size;
    for (int i = -kEnds; i < 0; ++i) samples_[i + kEnds] = from[size + i];
    std::copy_n(from, size, samples_.data() + kEnds);
    for (int i = 0; i < kEnds; ++i) samples_[size + kEnds + i] = from[i];
  }
  HWY_INLINE V Load(int i) const { return hn::LoadU(D(), samples_.data() + kEnds + i); }

 private:
  static constexpr int kEnds = 2;
  std::array<float, kMaxFftSize + 2 * kEnds> samples_;
};

// The derivative at a sample, from those one and two before and after, times the sample spacing;
// exact for polynomials of degree 4.
HWY_INLINE V Difference(V before2, V before, V after, V after2) {
  return MulSub(2.0f / 3.0f, after - before, 1.0f / 12.0f * (after2 - before2));
}

// dz/dx = v - dD/dx . (c v - r D), v the slopes where the waves come from, D as it is here.
void SteepenRows(const Crests& crests, int first, int last, PatchFrame& patch) {
  const D d;
  const int n = patch.resolution;
  const V c = hn::Set(d, crests.choppiness), r = hn::Set(d, crests.rise_per_m);
  const V samples_per_m = hn::Set(d, static_cast<float>(n / patch.length_m.x));
  for (int j = first; j < last; ++j) {
    const WrappedRow row_x(patch.displaced_x_m, j, n), row_y(patch.displaced_y_m, j, n);
    const auto along_x = [&](const WrappedRow& row, int i) HWY_ATTR {
      return Difference(row.Load(i - 2), row.Load(i - 1), row.Load(i + 1), row.Load(i + 2));
    };
    const auto along_y = [&](const std::vector<float>& field, int i) HWY_ATTR {
      const auto load = [&](int dj) HWY_ATTR {
        return hn::LoadU(d, &field[static_cast<std::size_t>(((j + dj) & (n - 1)) * n + i)]);
      };
      return Difference(load(-2), load(-1), load(1), load(2));
    };
    for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(d))) {
      const auto at = static_cast<std::size_t>(j * n + i);
      const V slope_x = hn::LoadU(d, &patch.slope_x[at]),
              slope_y = hn::LoadU(d, &patch.slope_y[at]);
      const V gx = samples_per_m * MulSub(c, slope_x, r * row_x.Load(i));
      const V gy = samples_per_m * MulSub(c, slope_y, r * row_y.Load(i));
      const V warp_x = MulAdd(along_x(row_x, i), gx, along_x(row_y, i) * gy);
      const V warp_y =
          MulAdd(along_y(patch.displaced_x_m, i), gx, along_y(patch.displaced_y_m, i) * gy);
      hn::StoreU(slope_x - warp_x, d, &patch.slope_x[at]);
      hn::StoreU(slope_y - warp_y, d, &patch.slope_y[at]);
    }
  }
}

// dz/dt = (1 + r h) dh/dt - (c grad z - r D) . dD/dt at X. The first factor follows from z:
// (1 + r h)^2 = 1 + 2 r (z + mean - r / 2 |D|^2).
void MoveRows(const Crests& crests, const PatchFrame& patch, const float* linear, int first,
              int last, const PatchVelocity& velocity) {
  const D d;
  const int n = patch.resolution;
  const std::size_t samples = patch.height_m.size();
  const V samples_per_m = MovedSamples_per_m(crests, patch);
  const V c = hn::Set(d, crests.choppiness), r = hn::Set(d, crests.rise_per_m);
  const V mean = hn::Set(d, crests.mean_m), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
  for (int j = first; j < last; ++j) {
    for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(d))) {
      const auto at = static_cast<std::size_t>(j * n + i);
      const V dx = hn::LoadU(d, &patch.displaced_x_m[at]);
      const V dy = hn::LoadU(d, &patch.displaced_y_m[at]);
      const Cells cells = RestingCells(n, i, j, samples_per_m, {dx, dy});
      const V x = Bilinear(cells, linear), y = Bilinear(cells, linear + samples);
      const V rising = Bilinear(cells, linear + 2 * samples);
      const V twice_z = two * (hn::LoadU(d, &patch.height_m[at]) + mean);
      const V twice_h = NegMulAdd(r, MulAdd(dx, dx, dy * dy), twice_z);
      const V gain = Sqrt(Max(MulAdd(r, twice_h, one), 0.0f));
      const V gx = MulSub(c, hn::LoadU(d, &patch.slope_x[at]), r * dx);
      const V gy = MulSub(c, hn::LoadU(d, &patch.slope_y[at]), r * dy);
      const V carried = MulAdd(gx, x, gy * y);
      hn::StoreU(x, d, &velocity.x_mps[at]);
      hn::StoreU(y, d, &velocity.y_mps[at]);
      hn::StoreU(MulSub(gain, rising, carried), d, &velocity.z_mps[at]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(WarpRows);
HWY_EXPORT(SteepenRows);
HWY_EXPORT(MoveRows);

void warp_rows(const Crests& crests, const LinearWaves& linear, int first, int last,
               PatchFrame& patch) {
  HWY_DYNAMIC_DISPATCH(WarpRows)(crests, linear, first, last, patch);
}

void steepen_rows(const Crests& crests, int first, int last, PatchFrame& patch) {
  HWY_DYNAMIC_DISPATCH(SteepenRows)(crests, first, last, patch);
}

void move_rows(const Crests& crests, const PatchFrame& patch, const float* linear, int first,
               int last, const PatchVelocity& velocity) {
  HWY_DYNAMIC_DISPATCH(MoveRows)(crests, patch, linear, first, last, velocity);
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
