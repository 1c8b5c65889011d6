#include "math/check.h"
#include "ocean/open_sea/whitecap_steps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/open_sea/age_foam_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// As many codes as lanes of d.
template <class D>
HWY_INLINE void AgeCodes(D d, const float* breaking, float threshold, int decay,
                         std::uint8_t* codes) {
  constexpr float kCodesPerDeviation = static_cast<float>(kFullCode / kFullExcess);
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> d8;
  const auto excess = (hn::LoadU(d, breaking) - threshold) * kCodesPerDeviation;
  const auto born = hn::ConvertTo(di, Min(Max(excess, 0.0f), static_cast<float>(kFullCode)));
  const auto left = hn::PromoteTo(di, hn::LoadU(d8, codes)) - hn::Set(di, decay);
  hn::StoreU(hn::DemoteTo(d8, hn::Max(born, left)), d8, codes);
}

void AgeFoam(const float* breaking, float threshold, int decay, std::size_t count,
             std::uint8_t* codes) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) AgeCodes(D(), breaking + i, threshold, decay, codes + i);
  for (; i < count; ++i)
    AgeCodes(hn::CappedTag<float, 1>(), breaking + i, threshold, decay, codes + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(AgeFoam);

void age_foam(std::span<const float> breaking, float threshold, int decay,
              std::span<std::uint8_t> codes) {
  SWELL_DCHECK(breaking.size() == codes.size(), "{} values, {} codes", breaking.size(),
               codes.size());
  HWY_DYNAMIC_DISPATCH(AgeFoam)(breaking.data(), threshold, decay, codes.size(), codes.data());
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
