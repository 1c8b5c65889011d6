// The steps of inverse_fft_2d that touch memory in SIMD packets (fft_simd.cpp).
#pragma once

#include <cstddef>

#include "ocean/spectrum/fft.h"

namespace swell::ocean {

// Copies a transformed batch (size x 16) to columns [0, 16) of `plane`, rows `stride` floats apart.
void store_columns(int size, const float* batch, float* plane, std::size_t stride);

// Turns 16 rows of `plane` into a batch in slot order: row r becomes column r.
void load_rows(const FftPlan& plan, const float* plane, std::size_t stride, float* batch);

// Turns a transformed batch back into 16 rows, `stride` floats apart.
void store_rows(int size, const float* batch, float* rows, std::size_t stride);

}  // namespace swell::ocean
