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

// What kernels do with one instruction or a few, of lanes a and b.
enum class LaneOperation : std::uint8_t {
  kMulAdd,       // a * b + a, rounded once
  kNegMulAdd,    // a - a * b
  kMulSub,       // a * b - a
  kMin,          // of a NaN and b: b
  kMax,          // the same
  kDivide,       // a / b
  kSqrt,         // of a
  kInverseSqrt,  // of a
  kFloor,        // of a
  kLess,         // all bits, a NaN, where a < b, else 0
  kFromInt,      // the float nearest to a's bits as an integer
  kEntry         // of a table of eight, by a's low bits
};
// out[i] = operation(a[i], b[i]); equal sizes, any length.
void lane_operation_batch(LaneOperation operation, std::span<const float> a,
                          std::span<const float> b, std::span<float> out);

// The number of float lanes the chosen target works on at a time.
int float_lanes();

}  // namespace swell
