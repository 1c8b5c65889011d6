// Inverse complex FFT in two dimensions, 16 columns at a time, one column a SIMD lane: lanes never
// meet, so every SIMD target gives the same bits.
//
// X[u] = sum_x x[u] e^(+2 pi i x u / n) on both axes, not scaled. Relative rms error against exact
// arithmetic below 3e-7 sqrt(log2 n^2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/parallel.h"

namespace swell::ocean {

inline constexpr int kFftBatch = 16;  // columns side by side
inline constexpr int kMinFftSize = 16;
inline constexpr int kMaxFftSize = 512;

// Tables for one size. A batch of columns is two arrays of size x 16 floats (real, imaginary
// parts), 64-byte aligned. Its input rows are permuted: row x of the data lies at row slot[x].
struct FftPlan {
  int size = 0;
  std::vector<std::uint16_t> slot;
  std::vector<float> twiddles;  // stage by stage, cos and sin of the three turned inputs
};

// size: a power of two in [16, 512].
FftPlan make_fft_plan(int size);

// Transforms a batch of columns in place: input in slot order, output in natural order.
void inverse_fft_batch(const FftPlan& plan, float* re, float* im);

// Fills columns [column0, column0 + 16) of transform `transform`'s input, as a batch in slot
// order. Returns false, with nothing written, if they are all zero. Called from many threads.
using FillBatch = FunctionRef<bool(int transform, int column0, float* re, float* im)>;

// Where the real and the imaginary part of one result go: size x size floats, row-major. im may be
// null: not wanted.
struct FftOutput {
  float* re = nullptr;
  float* im = nullptr;
};

// Runs outputs.size() transforms of size x size side by side. planes is working storage, grown to
// 2 size (size + 16) floats a transform and kept.
// Source: Cooley, Tukey 1965, mixed radix 4 and 2, decimation in time.
void inverse_fft_2d(const FftPlan& plan, FillBatch fill, std::span<const FftOutput> outputs,
                    std::vector<float>& planes, Workers& workers);

}  // namespace swell::ocean
