// What kernels are made of, over 10^8 inputs of every kind: the same bits on every SIMD target, and
// so on every family of processors (docs/understand/sameness.md).
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bits_hash.h"
#include "each_target.h"
#include "elementary_kernels.h"
#include "math/random.h"

namespace swell {
namespace {

constexpr int kInputBlocks = 1600;
constexpr std::size_t kInputBlock = 1 << 16;

using Inputs = std::span<const float>;
using Floats = std::span<float>;

class TargetBits : public EachTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, TargetBits, each_target(), target_name);

// Each 41st of all floats: every exponent and sign, infinities, NaN and denormals. NaN are quiet,
// as arithmetic makes them: of another and a number, Arm's least is NaN.
void next_inputs(int block, std::vector<float>& x) {
  constexpr std::uint32_t kInfinity = 0x7f800000, kQuiet = 0x00400000;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t number = static_cast<std::size_t>(block) * kInputBlock + i;
    auto bits = static_cast<std::uint32_t>(number * 41);
    if ((bits & 0x7fffffff) > kInfinity) bits |= kQuiet;
    x[i] = std::bit_cast<float>(bits);
  }
}

// What they are combined with: numbers, half of them of any size, half within 7 units of x's last
// place, where differences cancel and quotients are near 1.
void next_partners(int block, Inputs x, std::vector<float>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    auto bits = static_cast<std::uint32_t>(random_bits(static_cast<std::uint64_t>(block), i));
    if (i % 2 == 0) bits = std::bit_cast<std::uint32_t>(x[i]) ^ (bits & 7);
    const float number = std::bit_cast<float>(bits);
    y[i] = number == number && number != 0.0f ? number : 1.0f;
  }
}

template <class T>
struct Row {
  const char* name;
  std::function<void(Inputs, Inputs, std::span<T>)> function;
  std::uint64_t hash;  // of what it makes of all inputs and partners
};

template <class T>
void expect_hashes(const std::vector<Row<T>>& rows) {
  std::vector<float> x(kInputBlock), y(kInputBlock);
  std::vector<T> out(kInputBlock);
  std::vector<BitsHash> hashes(rows.size());
  for (int block = 0; block < kInputBlocks; ++block) {
    next_inputs(block, x);
    next_partners(block, x, y);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      rows[row].function(x, y, out);
      for (const T value : out) hashes[row].add(value);
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row)
    EXPECT_EQ(hashes[row].value(), rows[row].hash)
        << rows[row].name << std::hex << " 0x" << hashes[row].value();
}

auto lanes(LaneOperation operation) {
  return
      [operation](Inputs x, Inputs y, Floats out) { lane_operation_batch(operation, x, y, out); };
}

template <class T>
auto alone(void (*function)(Inputs, std::span<T>)) {
  return [function](Inputs x, Inputs, std::span<T> out) { function(x, out); };
}

TEST_P(TargetBits, OfLaneOperations) {
  using enum LaneOperation;
  expect_hashes<float>({{"MulAdd", lanes(kMulAdd), 0xae013b28f721de60u},
                        {"NegMulAdd", lanes(kNegMulAdd), 0xcf6f758501843fc8u},
                        {"MulSub", lanes(kMulSub), 0x3edbc3c1650c1d8du},
                        {"Min", lanes(kMin), 0x9758dd7dd90ea8dfu},
                        {"Max", lanes(kMax), 0x9c1509b0e6607714u},
                        {"Divide", lanes(kDivide), 0xbf37def9ffbeaf6fu},
                        {"Sqrt", lanes(kSqrt), 0x2c524f84a8dc3062u},
                        {"InverseSqrt", lanes(kInverseSqrt), 0x079ccee64ffc217au},
                        {"Floor", lanes(kFloor), 0xb1a8d628f6cf42aau},
                        {"Less", lanes(kLess), 0x4dc5c1a6bae1c206u},
                        {"FromInt", lanes(kFromInt), 0x8f7e8915dbbe8af8u},
                        {"Entry", lanes(kEntry), 0xa1f4875f0b84cf20u}});
}

TEST_P(TargetBits, OfConversionsToIntegers) {
  expect_hashes<std::int32_t>({{"truncate", alone(truncate_to_int_batch), 0xd1c5bc99cac9aa01u},
                               {"round", alone(round_to_int_batch), 0x9ea8b10c04f68318u}});
}

TEST_P(TargetBits, OfElementaryFunctions) {
  std::vector<float> other(kInputBlock);
  const auto sine = [&](Inputs x, Inputs, Floats out) { sin_cos_turns_batch(x, out, other); };
  const auto cosine = [&](Inputs x, Inputs, Floats out) { sin_cos_turns_batch(x, other, out); };
  expect_hashes<float>({{"sine", sine, 0x11c7d632626836aau},
                        {"cosine", cosine, 0x2b8e994c2f892210u},
                        {"exp2", alone(exp2_batch), 0xf798f92f86070edbu},
                        {"exp", alone(exp_batch), 0x6aca74172ddd7d33u},
                        {"log2", alone(log2_batch), 0xd5c7e8d0d0e6461eu},
                        {"log2_coarse", alone(log2_coarse_batch), 0x31f2283468f882c0u}});
}

}  // namespace
}  // namespace swell
