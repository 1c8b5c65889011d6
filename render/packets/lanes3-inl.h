// What pixels beside each other hold, one by one.
#if defined(SWELL_RENDER_PACKETS_LANES3_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_PACKETS_LANES3_INL_H_
#undef SWELL_RENDER_PACKETS_LANES3_INL_H_
#else
#define SWELL_RENDER_PACKETS_LANES3_INL_H_
#endif

#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A vector a lane, filled one by one: objects and trees cover few pixels, and what their triangles
// hold is too much for gathers to be quick.
struct Lanes3 {
  static constexpr std::size_t kCount = hn::MaxLanes(D());
  HWY_ALIGN float x[kCount];
  HWY_ALIGN float y[kCount];
  HWY_ALIGN float z[kCount];

  void Set(std::size_t lane, glm::vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
  V3 Load() const { return {hn::Load(D(), x), hn::Load(D(), y), hn::Load(D(), z)}; }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
