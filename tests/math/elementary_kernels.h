// The vector functions of math/elementary-inl.h over spans, for tests. Each runs on the target
// chosen with select_simd_target.
#pragma once

#include <cstdint>
#include <span>

namespace swell {

// out[i] = f(in[i]); equal sizes, any length, no overlap.
void sin_cos_turns_batch(std::span<const float> in, std::span<float> sin_out,
                         std::span<float> cos_out);
void exp2_batch(std::span<const float> in, std::span<float> out);
void exp_batch(std::span<const float> in, std::span<float> out);
void log2_batch(std::span<const float> in, std::span<float> out);
void log2_coarse_batch(std::span<const float> in, std::span<float> out);
void truncate_to_int_batch(std::span<const float> in, std::span<std::int32_t> out);
void round_to_int_batch(std::span<const float> in, std::span<std::int32_t> out);

// The number of float lanes the chosen target works on at a time.
int float_lanes();

}  // namespace swell
