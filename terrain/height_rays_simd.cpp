#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/check.h"
#include "terrain/height_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/height_rays_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "terrain/height_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {

using LandTraveller = Traveller<Axis, OneTable>;

LandTraveller traveller_from(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail) {
  const Grid& grid = pyramid.grid;
  const glm::dvec2 from = from_world - grid.min_world;
  return {OneTable{pyramid}, Axis(from.x, grid.spacing_m, grid.samples_x),
          Axis(from.y, grid.spacing_m, grid.samples_y), detail};
}

// Rays [first, ...) of `rays`, a packet at most, at their first blocks.
HWY_INLINE Packet BeginPacket(const LandTraveller& traveller, float per_m, const HeightRays& rays,
                              std::size_t first) {
  const D d;
  Packet p;
  p.goes = p.waits = hn::FirstN(d, 0);
  p.t_hit = hn::Inf(d);
  if (first >= rays.x.size()) return p;
  const auto load = [&](std::span<const float> values) HWY_ATTR { return LoadSome(values, first); };
  Walk& w = p.walk;
  w.x_t = load(rays.x) * per_m;
  w.y_t = load(rays.y) * per_m;
  w.z = load(rays.z), w.z_t = load(rays.z_t), w.z_tt = load(rays.z_tt);
  w.t = load(rays.begin), w.end = load(rays.end);
  p.goes = traveller.Begin(w, hn::Zero(d));  // lanes beyond the last have no way
  return p;
}

void CastRays(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail_m_per_t,
              const HeightRays& rays, std::span<float> t_hit) {
  const std::size_t count = rays.x.size();
  const float per_m = static_cast<float>(1.0 / pyramid.grid.spacing_m);
  const LandTraveller traveller = traveller_from(pyramid, from_world, detail_m_per_t * per_m);
  // Two packets by turns: one's next instructions do not wait for the other's last.
  for (std::size_t n = 0; n < count; n += 2 * kLanes) {
    Packet a = BeginPacket(traveller, per_m, rays, n),
           b = BeginPacket(traveller, per_m, rays, n + kLanes);
    while (a.IsUnderWay() || b.IsUnderWay()) {
      StepPacket(traveller, a);
      StepPacket(traveller, b);
    }
    StoreSome(a.t_hit, n, t_hit);
    if (n + kLanes < count) StoreSome(b.t_hit, n + kLanes, t_hit);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::terrain {

HWY_EXPORT(CastRays);

void cast_rays(const HeightPyramid& pyramid, glm::dvec2 from_world, float detail_m_per_t,
               const HeightRays& rays, std::span<float> t_hit) {
  const std::size_t count = t_hit.size();
  for (const auto& values : {rays.x, rays.y, rays.z, rays.z_t, rays.z_tt, rays.begin, rays.end})
    SWELL_CHECK(values.size() == count, "rays={} values={}", count, values.size());
  HWY_DYNAMIC_DISPATCH(CastRays)(pyramid, from_world, detail_m_per_t, rays, t_hit);
}

}  // namespace swell::terrain
#endif
