#include <algorithm>
#include <array>

#include "render/tile/stored_fog.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/stored_fog_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/packets/lanes3-inl.h"
#include "render/sky/fog-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void SeeFogAt(const Fog& fog, std::span<FogAtPlace> places) {
  const D d;
  HWY_ALIGN std::array<float, kLanes> height{};
  Lanes3 p{}, passes, added;
  const auto store = [d](V3 v, Lanes3& lanes) HWY_ATTR {
    hn::Store(v.x, d, lanes.x);
    hn::Store(v.y, d, lanes.y);
    hn::Store(v.z, d, lanes.z);
  };
  for (std::size_t n = 0; n < places.size(); n += kLanes) {
    const auto packet = places.subspan(n, std::min(kLanes, places.size() - n));
    for (std::size_t i = 0; i < packet.size(); ++i) {
      p.Set(i, packet[i].p_seen);
      height[i] = packet[i].height_m;
    }
    const V3 seen = p.Load();
    const V distance = Max(Sqrt(Dot(seen, seen)), 1e-3f);
    const FogRay ray = {
        {seen * (1.0f / distance), distance, hn::Load(d, height.data()), fog.at_eye.height_m},
        fog.at_eye};
    const FogView view = SeeFog(fog, ray, PathTo(fog, ray));
    store(view.passes, passes);
    store(view.added, added);
    for (std::size_t i = 0; i < packet.size(); ++i) {
      packet[i].passes = {passes.x[i], passes.y[i], passes.z[i]};
      packet[i].added = {added.x[i], added.y[i], added.z[i]};
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(SeeFogAt);

void see_fog_at(const Fog& fog, std::span<FogAtPlace> places) {
  HWY_DYNAMIC_DISPATCH(SeeFogAt)(fog, places);
}

}  // namespace swell::render
#endif  // HWY_ONCE
