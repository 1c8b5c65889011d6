#include <algorithm>
#include <array>
#include <cstddef>

#include "math/elementary_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/elementary_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

using Floats = hn::ScalableTag<float>;

// Calls packet(d, x) on whole vectors; the last one is padded with ones.
template <class Packet>
void ForEachVector(std::span<const float> in, const Packet& packet) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < in.size(); i += lanes) {
    std::array<float, 64> x;
    x.fill(1.0f);
    const std::size_t n = std::min(lanes, in.size() - i);
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(i), n, x.begin());
    packet(d, hn::LoadU(d, x.data()), i, n);
  }
}

template <class V, class T>
void StoreSome(V v, std::span<T> out, std::size_t at, std::size_t n) {
  std::array<T, 64> buffer;
  hn::StoreU(v, hn::DFromV<V>(), buffer.data());
  std::copy_n(buffer.begin(), n, out.begin() + static_cast<std::ptrdiff_t>(at));
}

void SinCosTurnsBatch(std::span<const float> in, std::span<float> sin_out,
                      std::span<float> cos_out) {
  ForEachVector(in, [&](Floats d, auto x, std::size_t at, std::size_t n) HWY_ATTR {
    auto s = x, c = x;
    SinCosTurns(d, x, s, c);
    StoreSome(s, sin_out, at, n);
    StoreSome(c, cos_out, at, n);
  });
}

void Exp2Batch(std::span<const float> in, std::span<float> out) {
  ForEachVector(in, [&](Floats d, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(Exp2(d, x), out, at, n); });
}

void ExpBatch(std::span<const float> in, std::span<float> out) {
  ForEachVector(in, [&](Floats d, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(Exp(d, x), out, at, n); });
}

void Log2Batch(std::span<const float> in, std::span<float> out) {
  ForEachVector(in, [&](Floats d, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(Log2(d, x), out, at, n); });
}

void Log2CoarseBatch(std::span<const float> in, std::span<float> out) {
  ForEachVector(in, [&](Floats d, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(Log2Coarse(d, x), out, at, n); });
}

void TruncateToIntBatch(std::span<const float> in, std::span<std::int32_t> out) {
  ForEachVector(in, [&](Floats, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(TruncateToInt(x), out, at, n); });
}

void RoundToIntBatch(std::span<const float> in, std::span<std::int32_t> out) {
  ForEachVector(in, [&](Floats, auto x, std::size_t at, std::size_t n)
                        HWY_ATTR { StoreSome(RoundToInt(x), out, at, n); });
}

constexpr std::array<float, 64> kEntries = {0.0f, 0.1f, -2.5f, 1e30f, -0.0f, 0.3f, 7.0f, 1e-40f};

V Apply(LaneOperation operation, V a, V b) {
  switch (operation) {
    case LaneOperation::kMulAdd:
      return MulAdd(a, b, a);
    case LaneOperation::kNegMulAdd:
      return NegMulAdd(a, b, a);
    case LaneOperation::kMulSub:
      return MulSub(a, b, a);
    case LaneOperation::kMin:
      return Min(a, b);
    case LaneOperation::kMax:
      return Max(a, b);
    case LaneOperation::kDivide:
      return a / b;
    case LaneOperation::kSqrt:
      return Sqrt(a);
    case LaneOperation::kInverseSqrt:
      return InverseSqrt(a);
    case LaneOperation::kFloor:
      return hn::Floor(a);
    case LaneOperation::kLess:
      return hn::VecFromMask(D(), a < b);
    case LaneOperation::kFromInt:
      return hn::ConvertTo(D(), hn::BitCast(DI(), a));
    case LaneOperation::kEntry:
      return EntriesOfEight(D(), kEntries.data(), hn::BitCast(DI(), a) & hn::Set(DI(), 7));
  }
  return a;
}

void LaneOperationBatch(LaneOperation operation, std::span<const float> a, std::span<const float> b,
                        std::span<float> out) {
  ForEachVector(a, [&](Floats d, auto x, std::size_t at, std::size_t n) HWY_ATTR {
    std::array<float, 64> y{};
    std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(at), n, y.begin());
    StoreSome(Apply(operation, x, hn::LoadU(d, y.data())), out, at, n);
  });
}

int FloatLanes() { return static_cast<int>(hn::Lanes(Floats())); }

}  // namespace HWY_NAMESPACE
}  // namespace swell
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {

HWY_EXPORT(SinCosTurnsBatch);
HWY_EXPORT(Exp2Batch);
HWY_EXPORT(ExpBatch);
HWY_EXPORT(Log2Batch);
HWY_EXPORT(Log2CoarseBatch);
HWY_EXPORT(TruncateToIntBatch);
HWY_EXPORT(RoundToIntBatch);
HWY_EXPORT(LaneOperationBatch);
HWY_EXPORT(FloatLanes);

void sin_cos_turns_batch(std::span<const float> in, std::span<float> sin_out,
                         std::span<float> cos_out) {
  HWY_DYNAMIC_DISPATCH(SinCosTurnsBatch)(in, sin_out, cos_out);
}
void exp2_batch(std::span<const float> in, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(Exp2Batch)(in, out);
}
void exp_batch(std::span<const float> in, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(ExpBatch)(in, out);
}
void log2_batch(std::span<const float> in, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(Log2Batch)(in, out);
}

void log2_coarse_batch(std::span<const float> in, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(Log2CoarseBatch)(in, out);
}
void truncate_to_int_batch(std::span<const float> in, std::span<std::int32_t> out) {
  HWY_DYNAMIC_DISPATCH(TruncateToIntBatch)(in, out);
}
void round_to_int_batch(std::span<const float> in, std::span<std::int32_t> out) {
  HWY_DYNAMIC_DISPATCH(RoundToIntBatch)(in, out);
}
void lane_operation_batch(LaneOperation operation, std::span<const float> a,
                          std::span<const float> b, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(LaneOperationBatch)(operation, a, b, out);
}
int float_lanes() { return HWY_DYNAMIC_DISPATCH(FloatLanes)(); }

}  // namespace swell
#endif  // HWY_ONCE
