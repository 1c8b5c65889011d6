#include "sky/add_parts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sky/add_parts_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::sky {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Adds to N vectors, which stay in registers; `last`: the lanes of the last one that there are.
template <std::size_t N>
HWY_INLINE void AddTo(std::span<const float> parts, const float* from, std::size_t step, M last,
                      float* to) {
  const D d;
  constexpr std::size_t kLast = (N - 1) * kLanes;
  V sum[N];
  for (std::size_t n = 0; n + 1 < N; ++n) sum[n] = hn::LoadU(d, to + n * kLanes);
  sum[N - 1] = hn::MaskedLoad(last, d, to + kLast);
  for (const float part : parts) {
    for (std::size_t n = 0; n + 1 < N; ++n)
      sum[n] = sum[n] + part * hn::LoadU(d, from + n * kLanes);
    sum[N - 1] = sum[N - 1] + part * hn::MaskedLoad(last, d, from + kLast);
    from += step;
  }
  for (std::size_t n = 0; n + 1 < N; ++n) hn::StoreU(sum[n], d, to + n * kLanes);
  hn::BlendedStore(sum[N - 1], last, d, to + kLast);
}

void AddParts(std::span<const float> parts, const float* from, std::size_t step, std::size_t count,
              float* to) {
  constexpr std::size_t kMost = 4 * kLanes;
  const D d;
  for (; count > kMost; count -= kMost, from += kMost, to += kMost)
    AddTo<4>(parts, from, step, hn::FirstN(d, kLanes), to);
  if (count > 3 * kLanes)
    AddTo<4>(parts, from, step, hn::FirstN(d, count - 3 * kLanes), to);
  else if (count > 2 * kLanes)
    AddTo<3>(parts, from, step, hn::FirstN(d, count - 2 * kLanes), to);
  else if (count > kLanes)
    AddTo<2>(parts, from, step, hn::FirstN(d, count - kLanes), to);
  else
    AddTo<1>(parts, from, step, hn::FirstN(d, count), to);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::sky
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::sky {

HWY_EXPORT(AddParts);

void add_parts(std::span<const float> parts, const float* from, std::size_t step, std::size_t count,
               float* to) {
  HWY_DYNAMIC_DISPATCH(AddParts)(parts, from, step, count, to);
}

}  // namespace swell::sky
#endif  // HWY_ONCE
