#include "render/sky/cloud_kernels.h"
#include "render/tile/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/cloud_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "render/sky/cloud_field-inl.h"
#include "render/sky/cloud_queue-inl.h"
#include "render/sky/sky_maps.h"
#include "render/tile/cloud_picture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct EvenField {
  V density;

  HWY_INLINE V EmptyUntil(V) const { return hn::Zero(D()); }
  HWY_INLINE V Body(V) const { return density; }
  HWY_INLINE V Form(V, V body) const { return body; }
  HWY_INLINE hn::Mask<D> MayHold(V form) const { return form > 0.0f; }
  HWY_INLINE V Density(V, V form) const { return form; }
  HWY_INLINE void Light(V, V& sun, V& sky) const { sun = sky = Constant(1.0f); }
};

// Element `first` + lane of a list, the last one repeated.
template <class Get>
V LoadSome(std::size_t count, std::size_t first, const Get& get) {
  HWY_ALIGN std::array<float, kLanes> lanes;
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = get(std::min(first + i, count - 1));
  return hn::Load(D(), lanes.data());
}

template <class Put>
void StoreSome(V from, std::size_t count, std::size_t first, const Put& put) {
  HWY_ALIGN std::array<float, kLanes> lanes;
  hn::Store(from, D(), lanes.data());
  for (std::size_t i = 0; i < kLanes && first + i < count; ++i) put(first + i, lanes[i]);
}

void StoreSeen(const CloudLightSeen& from, std::size_t first, std::span<RaySeen> seen) {
  const std::size_t n = seen.size();
  StoreSome(from.opacity, n, first, [&](std::size_t i, float v) { seen[i].opacity = v; });
  StoreSome(from.sun, n, first, [&](std::size_t i, float v) { seen[i].sun = v; });
  StoreSome(from.sky, n, first, [&](std::size_t i, float v) { seen[i].sky = v; });
  StoreSome(from.front, n, first, [&](std::size_t i, float v) { seen[i].front = v; });
  StoreSome(from.back, n, first, [&](std::size_t i, float v) { seen[i].back = v; });
}

void FollowEven(std::span<const EvenCloud> clouds, float step_m, float far_m,
                float extinction_per_m, std::span<RaySeen> seen) {
  const std::size_t n = clouds.size();
  for (std::size_t i = 0; i < n; i += kLanes) {
    const V begin = LoadSome(n, i, [&](std::size_t k) { return clouds[k].begin_m; });
    const V end = LoadSome(n, i, [&](std::size_t k) { return clouds[k].end_m; });
    const EvenField field{LoadSome(n, i, [&](std::size_t k) { return clouds[k].density; })};
    StoreSeen(FollowRays(field, begin, end, {step_m, far_m}, extinction_per_m), i, seen);
  }
}

void See(const VolumeClouds& clouds, std::span<const glm::vec3> directions, float farthest_m,
         std::span<RaySeen> seen) {
  const std::size_t n = directions.size();
  for (std::size_t i = 0; i < n; i += kLanes) {
    const auto axis = [&](int c) {
      return LoadSome(n, i, [&](std::size_t k) { return directions[k][c]; });
    };
    StoreSeen(SeeClouds(clouds, {axis(0), axis(1), axis(2)}, Constant(farthest_m)), i, seen);
  }
}

void SeeQueued(const VolumeClouds& clouds, std::span<const glm::vec3> directions, float farthest_m,
               std::span<RaySeen> seen) {
  const D d;
  const std::size_t n = directions.size();
  const auto end = [&](const LookingRays& rays, const CloudLightSeen& light, hn::Mask<D> mask)
                       HWY_ATTR {
                         std::array<RaySeen, kLanes> packet;
                         StoreSeen(light, 0, packet);
                         HWY_ALIGN std::array<float, kLanes> number, used;
                         hn::Store(rays.number, d, number.data());
                         hn::Store(IfThenElseZero(mask, Constant(1.0f)), d, used.data());
                         for (std::size_t i = 0; i < kLanes; ++i)
                           if (used[i] != 0.0f)
                             seen[static_cast<std::size_t>(number[i])] = packet[i];
                       };
  CloudRayQueue queue(clouds, end);
  for (std::size_t i = 0; i < n; i += kLanes) {
    const auto axis = [&](int c) {
      return LoadSome(n, i, [&](std::size_t k) { return directions[k][c]; });
    };
    const FrameCloudField field(clouds, {axis(0), axis(1), axis(2)});
    const CloudRayEnds ends = EndsAmongClouds(clouds, field, hn::Zero(d), Constant(farthest_m));
    queue.Add(field, hn::ConvertTo(d, CountFrom(static_cast<int>(i))), ends.begin, ends.end,
              hn::FirstN(d, n - i) & (ends.begin < ends.end));
  }
  queue.Finish();
}

void LayEven(const RaySeen& node, glm::vec3 light, std::span<const float> distance_m,
             std::span<glm::vec3> laid) {
  const CloudsSeen seen = {Constant(light), Constant(node.opacity),
                           Constant(node.opacity * node.front), Constant(node.opacity * node.back)};
  const std::size_t n = laid.size();
  for (std::size_t i = 0; i < n; i += kLanes) {
    const V3 result = LayClouds(seen, LoadSome(n, i, [&](std::size_t k) { return distance_m[k]; }),
                                Constant(glm::vec3()));
    StoreSome(result.x, n, i, [&](std::size_t k, float v) { laid[k].x = v; });
    StoreSome(result.y, n, i, [&](std::size_t k, float v) { laid[k].y = v; });
    StoreSome(result.z, n, i, [&](std::size_t k, float v) { laid[k].z = v; });
  }
}

void Phase(std::span<const float> cosine, float part, std::span<float> phase) {
  const std::size_t n = cosine.size();
  for (std::size_t i = 0; i < n; i += kLanes)
    StoreSome(DropletPhase(LoadSome(n, i, [&](std::size_t k) { return cosine[k]; }), part), n, i,
              [&](std::size_t k, float v) { phase[k] = v; });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(FollowEven);
HWY_EXPORT(See);
HWY_EXPORT(SeeQueued);
HWY_EXPORT(LayEven);
HWY_EXPORT(Phase);

void follow_even_clouds(std::span<const EvenCloud> clouds, float step_m, float far_m,
                        float extinction_per_m, std::span<RaySeen> seen) {
  HWY_DYNAMIC_DISPATCH(FollowEven)(clouds, step_m, far_m, extinction_per_m, seen);
}

void see_clouds(const VolumeClouds& clouds, std::span<const glm::vec3> directions, float farthest_m,
                std::span<RaySeen> seen) {
  HWY_DYNAMIC_DISPATCH(See)(clouds, directions, farthest_m, seen);
}

void see_clouds_queued(const VolumeClouds& clouds, std::span<const glm::vec3> directions,
                       float farthest_m, std::span<RaySeen> seen) {
  HWY_DYNAMIC_DISPATCH(SeeQueued)(clouds, directions, farthest_m, seen);
}

void lay_even_cloud(glm::vec3 light, float opacity, float front_m, float back_m,
                    std::span<const float> distance_m, std::span<glm::vec3> laid) {
  HWY_DYNAMIC_DISPATCH(LayEven)
  ({opacity, 0.0f, 0.0f, front_m, back_m}, light, distance_m, laid);
}

void droplet_phase(std::span<const float> cosine, float part, std::span<float> phase) {
  HWY_DYNAMIC_DISPATCH(Phase)(cosine, part, phase);
}

}  // namespace swell::render
#endif  // HWY_ONCE
