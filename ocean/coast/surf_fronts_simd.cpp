#include <cstddef>

#include "math/check.h"
#include "ocean/coast/surf_fronts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/coast/surf_fronts_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ocean/coast/front_function-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

void SampleFrontFunction(const FrontClock& clock, FrontSamples& samples) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  static_assert(kPointChunk % hn::MaxLanes(D()) == 0);  // the last vector may be more than is meant
  for (std::size_t i = 0; i < samples.count; i += lanes) {
    const V part = Max(hn::LoadU(d, &samples.part[i]), 0.0f);
    const Fronts fronts =
        FindFronts(clock, hn::LoadU(d, &samples.x[i]), hn::LoadU(d, &samples.y[i]), part);
    const FrontShape shape = LiftOfFronts(fronts, part);
    hn::StoreU(shape.value, d, &samples.lift[i]);
    hn::StoreU(shape.by_turns, d, &samples.rate[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(SampleFrontFunction);

void sample_front_function(const FrontClock& clock, FrontSamples& samples) {
  SWELL_CHECK(samples.count <= kPointChunk, "count={}", samples.count);
  HWY_DYNAMIC_DISPATCH(SampleFrontFunction)(clock, samples);
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
