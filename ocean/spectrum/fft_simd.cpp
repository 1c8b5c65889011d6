#include <cstddef>
#include <cstdint>

#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/fft_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/spectrum/fft_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// BatchRows points into a batch, whose row is two vectors of 8 lanes or one of 16.
struct BatchRows {
  float* re;
  float* im;
};

HWY_INLINE BatchRows RowAt(BatchRows batch, std::size_t row, std::size_t lane) {
  const std::size_t offset = row * kFftBatch + lane;
  return {batch.re + offset, batch.im + offset};
}

// Samples of rows, a lane each.
struct RowSamples {
  V re, im;
};

HWY_INLINE RowSamples LoadRow(D d, BatchRows x) { return {hn::Load(d, x.re), hn::Load(d, x.im)}; }

// Loads row x, turned by w = (w[0], w[1]).
HWY_INLINE RowSamples LoadTurned(D d, BatchRows x, const float* w) {
  const V c = hn::Set(d, w[0]), s = hn::Set(d, w[1]);
  const auto [re, im] = LoadRow(d, x);
  return {NegMulAdd(im, s, re * c), MulAdd(im, c, re * s)};
}

// Y[p] = sum_s i^(s p) x_s, stored at y, y + step, y + 2 step, y + 3 step.
HWY_INLINE void StoreButterfly4(D d, RowSamples x0, RowSamples x1, RowSamples x2, RowSamples x3,
                                BatchRows y, std::size_t step) {
  const V even_sum_re = x0.re + x2.re, even_sum_im = x0.im + x2.im;
  const V even_dif_re = x0.re - x2.re, even_dif_im = x0.im - x2.im;
  const V odd_sum_re = x1.re + x3.re, odd_sum_im = x1.im + x3.im;
  const V odd_dif_re = x1.re - x3.re, odd_dif_im = x1.im - x3.im;
  hn::Store(even_sum_re + odd_sum_re, d, y.re);
  hn::Store(even_sum_im + odd_sum_im, d, y.im);
  // i (re, im) = (-im, re).
  hn::Store(even_dif_re - odd_dif_im, d, y.re + step);
  hn::Store(even_dif_im + odd_dif_re, d, y.im + step);
  hn::Store(even_sum_re - odd_sum_re, d, y.re + 2 * step);
  hn::Store(even_sum_im - odd_sum_im, d, y.im + 2 * step);
  hn::Store(even_dif_re + odd_dif_im, d, y.re + 3 * step);
  hn::Store(even_dif_im - odd_dif_re, d, y.im + 3 * step);
}

// First stage of a size that is no power of four: neighbouring rows, no turning.
HWY_INLINE void FirstStage2(D d, std::size_t size, BatchRows batch) {
  for (std::size_t i = 0; i < size * kFftBatch; i += 2 * kFftBatch) {
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      float* const re = batch.re + i + lane;
      float* const im = batch.im + i + lane;
      const V a_re = hn::Load(d, re), b_re = hn::Load(d, re + kFftBatch);
      const V a_im = hn::Load(d, im), b_im = hn::Load(d, im + kFftBatch);
      hn::Store(a_re + b_re, d, re);
      hn::Store(a_im + b_im, d, im);
      hn::Store(a_re - b_re, d, re + kFftBatch);
      hn::Store(a_im - b_im, d, im + kFftBatch);
    }
  }
}

HWY_INLINE void FirstStage4(D d, std::size_t size, BatchRows batch) {
  constexpr std::size_t kStep = kFftBatch;
  for (std::size_t row = 0; row < size; row += 4) {
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      const BatchRows x = RowAt(batch, row, lane);
      const auto row_of = [&](std::size_t n) HWY_ATTR {
        return LoadRow(d, {x.re + n * kStep, x.im + n * kStep});
      };
      StoreButterfly4(d, row_of(0), row_of(1), row_of(2), row_of(3), x, kStep);
    }
  }
}

// Joins groups of four transforms of m rows each into one of 4 m rows.
HWY_INLINE void Stage4(D d, std::size_t size, std::size_t m, const float* twiddles,
                       BatchRows batch) {
  const std::size_t step = m * kFftBatch;
  for (std::size_t group = 0; group < size; group += 4 * m) {
    for (std::size_t k = 0; k < m; ++k) {
      const float* const w = twiddles + 6 * k;
      for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
        const BatchRows x = RowAt(batch, group + k, lane);
        const auto turned = [&](std::size_t n) HWY_ATTR {
          return LoadTurned(d, {x.re + n * step, x.im + n * step}, w + 2 * (n - 1));
        };
        StoreButterfly4(d, LoadRow(d, x), turned(1), turned(2), turned(3), x, step);
      }
    }
  }
}

void InverseFftBatch(const FftPlan& plan, float* re, float* im) {
  const D d;
  const std::size_t size = static_cast<std::size_t>(plan.size);
  const bool power_of_four = (size & 0x5555) != 0;
  const BatchRows batch{re, im};
  std::size_t m = power_of_four ? 4 : 2;
  if (power_of_four) {
    FirstStage4(d, size, batch);
  } else {
    FirstStage2(d, size, batch);
  }
  const float* twiddles = plan.twiddles.data();
  for (; m < size; twiddles += 6 * m, m *= 4) Stage4(d, size, m, twiddles, batch);
}

void StoreColumns(int size, const float* batch, float* plane, std::size_t stride) {
  const D d;
  for (std::size_t row = 0; row < static_cast<std::size_t>(size); ++row) {
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      hn::StoreU(hn::Load(d, batch + row * kFftBatch + lane), d, plane + row * stride + lane);
    }
  }
}

// A vector whose 128-bit block b holds four samples of row 4 b.
template <class DV>
HWY_INLINE hn::Vec<DV> LoadBlocks(DV d, const float* row, std::size_t stride) {
  if constexpr (hn::MaxLanes(d) == 4) {
    return hn::LoadU(d, row);
  } else {
    const hn::Half<DV> dh;
    return hn::Combine(d, LoadBlocks(dh, row + hn::Lanes(dh) * stride, stride),
                       LoadBlocks(dh, row, stride));
  }
}

template <class DV>
HWY_INLINE void StoreBlocks(hn::Vec<DV> v, DV d, float* row, std::size_t stride) {
  if constexpr (hn::MaxLanes(d) == 4) {
    hn::StoreU(v, d, row);
  } else {
    const hn::Half<DV> dh;
    StoreBlocks(hn::LowerHalf(dh, v), dh, row, stride);
    StoreBlocks(hn::UpperHalf(dh, v), dh, row + hn::Lanes(dh) * stride, stride);
  }
}

// Transposes the 4 x 4 samples in each 128-bit block of v0 ... v3.
HWY_INLINE void TransposeBlocks(D d, V& v0, V& v1, V& v2, V& v3) {
  const hn::RepartitionToWide<D> dw;
  const auto low01 = hn::BitCast(dw, hn::InterleaveLower(d, v0, v1));
  const auto high01 = hn::BitCast(dw, hn::InterleaveUpper(d, v0, v1));
  const auto low23 = hn::BitCast(dw, hn::InterleaveLower(d, v2, v3));
  const auto high23 = hn::BitCast(dw, hn::InterleaveUpper(d, v2, v3));
  v0 = hn::BitCast(d, hn::InterleaveLower(dw, low01, low23));
  v1 = hn::BitCast(d, hn::InterleaveUpper(dw, low01, low23));
  v2 = hn::BitCast(d, hn::InterleaveLower(dw, high01, high23));
  v3 = hn::BitCast(d, hn::InterleaveUpper(dw, high01, high23));
}

void LoadRows(const FftPlan& plan, const float* plane, std::size_t stride, float* batch) {
  const D d;
  for (std::size_t x = 0; x < static_cast<std::size_t>(plan.size); x += 4) {
    const std::uint16_t* const slot = plan.slot.data() + x;
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      const float* const corner = plane + lane * stride + x;
      V v0 = LoadBlocks(d, corner, stride), v1 = LoadBlocks(d, corner + stride, stride);
      V v2 = LoadBlocks(d, corner + 2 * stride, stride);
      V v3 = LoadBlocks(d, corner + 3 * stride, stride);
      TransposeBlocks(d, v0, v1, v2, v3);
      hn::Store(v0, d, batch + slot[0] * kFftBatch + lane);
      hn::Store(v1, d, batch + slot[1] * kFftBatch + lane);
      hn::Store(v2, d, batch + slot[2] * kFftBatch + lane);
      hn::Store(v3, d, batch + slot[3] * kFftBatch + lane);
    }
  }
}

void StoreRows(int size, const float* batch, float* rows, std::size_t stride) {
  const D d;
  for (std::size_t x = 0; x < static_cast<std::size_t>(size); x += 4) {
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      const float* const from = batch + x * kFftBatch + lane;
      V v0 = hn::Load(d, from), v1 = hn::Load(d, from + kFftBatch);
      V v2 = hn::Load(d, from + 2 * kFftBatch), v3 = hn::Load(d, from + 3 * kFftBatch);
      TransposeBlocks(d, v0, v1, v2, v3);
      float* const corner = rows + lane * stride + x;
      StoreBlocks(v0, d, corner, stride);
      StoreBlocks(v1, d, corner + stride, stride);
      StoreBlocks(v2, d, corner + 2 * stride, stride);
      StoreBlocks(v3, d, corner + 3 * stride, stride);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(InverseFftBatch);
HWY_EXPORT(StoreColumns);
HWY_EXPORT(LoadRows);
HWY_EXPORT(StoreRows);

void inverse_fft_batch(const FftPlan& plan, float* re, float* im) {
  HWY_DYNAMIC_DISPATCH(InverseFftBatch)(plan, re, im);
}

void store_columns(int size, const float* batch, float* plane, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(StoreColumns)(size, batch, plane, stride);
}

void load_rows(const FftPlan& plan, const float* plane, std::size_t stride, float* batch) {
  HWY_DYNAMIC_DISPATCH(LoadRows)(plan, plane, stride, batch);
}

void store_rows(int size, const float* batch, float* rows, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(StoreRows)(size, batch, rows, stride);
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
