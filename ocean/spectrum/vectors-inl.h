// The vectors of ocean/'s kernels over single floats: V, as many places or waves as the target
// takes at once, and half as many in double.
#if defined(SWELL_OCEAN_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_OCEAN_VECTORS_INL_H_
#undef SWELL_OCEAN_VECTORS_INL_H_
#else
#define SWELL_OCEAN_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

using DHalf = hn::Half<D>;
using DHalfInt = hn::RebindToSigned<DHalf>;
using DDouble = hn::Rebind<double, DHalf>;
using VDouble = hn::Vec<DDouble>;

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
