#include "render/sky/stored_fog_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/stored_fog_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "render/tile/stored_fog-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void StoreSome(const FogView& view, std::size_t first, std::span<FogSeen> seen) {
  HWY_ALIGN std::array<std::array<float, kLanes>, 6> lanes;
  const V values[] = {view.passes.x, view.passes.y, view.passes.z,
                      view.added.x,  view.added.y,  view.added.z};
  for (std::size_t c = 0; c < 6; ++c) hn::Store(values[c], D(), lanes[c].data());
  for (std::size_t i = 0; i < kLanes && first + i < seen.size(); ++i)
    seen[first + i] = {{lanes[0][i], lanes[1][i], lanes[2][i]},
                       {lanes[3][i], lanes[4][i], lanes[5][i]}};
}

void Interpolate(const StoredFog& stored, std::span<const glm::vec3> ray,
                 std::span<const std::uint32_t> primitive, const FogSeen& own,
                 std::span<FogSeen> seen) {
  for (std::size_t first = 0; first < seen.size(); first += kLanes) {
    Lanes3 rays;
    std::array<std::uint32_t, kLanes> primitives{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::size_t at = std::min(first + i, seen.size() - 1);
      rays.Set(i, ray[at]);
      primitives[i] = primitive[at];
    }
    const auto their_own = [&]() HWY_ATTR {
      return FogView{Constant(own.passes), Constant(own.added)};
    };
    StoreSome(InterpolateFog(stored, primitives.data(), rays.Load(), their_own), first, seen);
  }
}

void LookUp(const StoredFog& stored, std::span<const float> z, std::span<FogSeen> seen) {
  for (std::size_t first = 0; first < seen.size(); first += kLanes) {
    HWY_ALIGN std::array<float, kLanes> depth;
    for (std::size_t i = 0; i < kLanes; ++i) depth[i] = z[std::min(first + i, z.size() - 1)];
    StoreSome(LookUpFog(stored, hn::Load(D(), depth.data())), first, seen);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(Interpolate);
HWY_EXPORT(LookUp);

std::vector<FogSeen> interpolate_fog(const StoredFog& stored, std::span<const glm::vec3> ray,
                                     std::span<const std::uint32_t> primitive, const FogSeen& own) {
  std::vector<FogSeen> seen(ray.size());
  HWY_DYNAMIC_DISPATCH(Interpolate)(stored, ray, primitive, own, seen);
  return seen;
}

std::vector<FogSeen> look_up_fog(const StoredFog& stored, std::span<const float> z) {
  std::vector<FogSeen> seen(z.size());
  HWY_DYNAMIC_DISPATCH(LookUp)(stored, z, seen);
  return seen;
}

}  // namespace swell::render
#endif  // HWY_ONCE
