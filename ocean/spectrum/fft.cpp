#include "ocean/spectrum/fft.h"

#include <algorithm>
#include <bit>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/spectrum/fft_kernels.h"

namespace swell::ocean {
namespace {

// One batch in work: 64 KiB, on the stack of the thread that transforms it.
struct Batch {
  alignas(64) float re[kMaxFftSize * kFftBatch];
  alignas(64) float im[kMaxFftSize * kFftBatch];
};

// Rows one cache line longer than the data: a column's samples fall into different cache sets.
std::size_t plane_stride(int size) { return static_cast<std::size_t>(size + kFftBatch); }

// The radix of the first stage, whose inputs need no turning; all later stages have radix 4.
int first_radix(int size) { return std::countr_zero(static_cast<unsigned>(size)) % 2 == 0 ? 4 : 2; }

// Decimation in time: input x goes to the sub-transform x mod 4, until the first stage is left.
int input_slot(int x, int size, int radix) {
  if (size == radix) return x;
  return (x & 3) * (size / 4) + input_slot(x >> 2, size / 4, radix);
}

void append_stage_twiddles(int sub_size, std::vector<float>& twiddles) {
  for (int k = 0; k < sub_size; ++k) {
    for (int s = 1; s < 4; ++s) {
      const SinCos w = sin_cos_turns(static_cast<double>(s * k) / (4.0 * sub_size));
      twiddles.push_back(static_cast<float>(w.cos));
      twiddles.push_back(static_cast<float>(w.sin));
    }
  }
}

}  // namespace

FftPlan make_fft_plan(int size) {
  SWELL_CHECK(size >= kMinFftSize && size <= kMaxFftSize && std::has_single_bit(unsigned(size)),
              "size={}", size);
  const int radix = first_radix(size);
  FftPlan plan;
  plan.size = size;
  for (int x = 0; x < size; ++x) {
    plan.slot.push_back(static_cast<std::uint16_t>(input_slot(x, size, radix)));
  }
  for (int m = radix; m < size; m *= 4) append_stage_twiddles(m, plan.twiddles);
  return plan;
}

void inverse_fft_2d(const FftPlan& plan, FillBatch fill, std::span<const FftOutput> outputs,
                    std::vector<float>& planes, Workers& workers) {
  const std::size_t size = static_cast<std::size_t>(plan.size);
  const std::size_t batches = size / kFftBatch;
  const std::size_t stride = plane_stride(plan.size);
  planes.resize(std::max(planes.size(), outputs.size() * 2 * size * stride));
  const auto plane = [&](std::size_t transform, std::size_t part) {
    return planes.data() + (2 * transform + part) * size * stride;
  };

  // Along y: 16 columns a batch, straight from their maker into the plane.
  workers.for_each(outputs.size() * batches, [&](std::size_t index, int) {
    const std::size_t transform = index / batches, column0 = index % batches * kFftBatch;
    Batch batch;
    if (fill(static_cast<int>(transform), static_cast<int>(column0), batch.re, batch.im)) {
      inverse_fft_batch(plan, batch.re, batch.im);
    } else {
      std::fill_n(batch.re, size * kFftBatch, 0.0f);
      std::fill_n(batch.im, size * kFftBatch, 0.0f);
    }
    store_columns(plan.size, batch.re, plane(transform, 0) + column0, stride);
    store_columns(plan.size, batch.im, plane(transform, 1) + column0, stride);
  });

  // Along x: 16 rows a batch, turned to columns on the way in and back on the way out.
  workers.for_each(outputs.size() * batches, [&](std::size_t index, int) {
    const std::size_t transform = index / batches, row0 = index % batches * kFftBatch;
    Batch batch;
    load_rows(plan, plane(transform, 0) + row0 * stride, stride, batch.re);
    load_rows(plan, plane(transform, 1) + row0 * stride, stride, batch.im);
    inverse_fft_batch(plan, batch.re, batch.im);
    const FftOutput& out = outputs[transform];
    store_rows(plan.size, batch.re, out.re + row0 * size, size);
    if (out.im != nullptr) store_rows(plan.size, batch.im, out.im + row0 * size, size);
  });
}

}  // namespace swell::ocean
