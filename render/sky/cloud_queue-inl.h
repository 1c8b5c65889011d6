// Follows many rays through clouds, with all lanes at work: rays of a packet end, and meet clouds,
// at different places. Those to look ahead of wait in one buffer, those among clouds in another,
// and a packet is taken from either when it is full. What a ray sees does not depend on the others.
#if defined(SWELL_RENDER_SKY_CLOUD_QUEUE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUD_QUEUE_INL_H_
#undef SWELL_RENDER_SKY_CLOUD_QUEUE_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUD_QUEUE_INL_H_
#endif

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "render/packets/packet-inl.h"
#include "render/sky/cloud_field-inl.h"
#include "render/sky/cloud_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Calls f(number, field) for fields, numbered from `first` on.
template <class F, class... Fields>
HWY_INLINE void ForFields(std::size_t first, const F& f, Fields&... fields) {
  (f(first++, fields), ...);
}

// Rays of length 1 that look ahead, by number. `number` is a whole one below 2^24.
struct LookingRays {
  static constexpr std::size_t kFields = 18;
  V3 direction;
  V number, phase0, phase1;
  RaysUnderWay way;
};
template <class Rays, class F>
HWY_INLINE void ForEachField(
    Rays& r, const F& f) requires std::same_as<std::remove_const_t<Rays>, LookingRays> {
  ForFields(0, f, r.direction.x, r.direction.y, r.direction.z, r.number, r.phase0, r.phase1,
            r.way.t, r.way.end, r.way.passes, r.way.weighted, r.way.known, r.way.sun, r.way.sky,
            r.way.seen.sun, r.way.seen.sky, r.way.seen.front, r.way.seen.back, r.way.seen.clear);
}

// Those before a group that may hold a cloud.
struct TakingRays {
  static constexpr std::size_t kFields = LookingRays::kFields + 5;
  LookingRays rays;
  V empty_until, body0, body1, body2, highest;
};
template <class Rays, class F>
HWY_INLINE void ForEachField(
    Rays& r, const F& f) requires std::same_as<std::remove_const_t<Rays>, TakingRays> {
  ForEachField(r.rays, f);
  ForFields(LookingRays::kFields, f, r.empty_until, r.body0, r.body1, r.body2, r.highest);
}

// For TableLookupLanes(): the lanes of the mask, side by side. Compress() takes many times as long
// on AVX2.
HWY_INLINE auto ChosenFirst(hn::Mask<D> mask) {
  const DI di;
  return hn::IndicesFromVec(D(), hn::Compress(hn::Iota(di, 0), hn::RebindMask(di, mask)));
}

// Rays that wait for a full packet.
template <class Rays>
class RayBuffer {
 public:
  std::size_t count() const { return count_; }

  HWY_INLINE void Add(const Rays& rays, hn::Mask<D> mask) {
    const D d;
    float* const HWY_RESTRICT to = lanes_.data() + count_;
    const auto chosen = ChosenFirst(mask);
    ForEachField(rays, [&](std::size_t field, const V& v) HWY_ATTR {
      hn::StoreU(hn::TableLookupLanes(v, chosen), d, to + field * kRoom);
    });
    count_ += hn::CountTrue(d, mask);
  }

  // As many as a packet holds, or all; the mask tells which lanes they are.
  HWY_INLINE void Take(Rays& rays, hn::Mask<D>& mask) {
    const D d;
    const std::size_t taken = std::min(count_, kLanes);
    count_ -= taken;
    mask = hn::FirstN(d, taken);
    const float* const HWY_RESTRICT from = lanes_.data() + count_;
    ForEachField(rays,
                 [&](std::size_t field, V& v) HWY_ATTR { v = hn::LoadU(d, from + field * kRoom); });
  }

 private:
  // Less than a packet that looks, less than two that take, a new one, and what a store passes
  // over.
  static constexpr std::size_t kRoom = 5 * kLanes;
  std::size_t count_ = 0;
  alignas(64) std::array<float, kRoom * Rays::kFields> lanes_{};
};

// Calls end(rays, seen, mask) with packets of rays that have ended, in any order.
template <class End>
class CloudRayQueue {
 public:
  CloudRayQueue(const VolumeClouds& clouds, const End& end) : clouds_(clouds), end_(end) {}

  // Starts rays between begin and end, where begin < end.
  HWY_INLINE void Add(const FrameCloudField& field, V number, V begin, V end, hn::Mask<D> mask) {
    looking_.Add({field.direction, number, field.phase0, field.phase1, BeginRays(begin, end)},
                 mask);
    while (looking_.count() >= kLanes) Step();
  }

  // Follows all rays to their ends.
  HWY_INLINE void Finish() {
    while (looking_.count() > 0 || taking_.count() > 0) Step();
    if (ended_.count() > 0) PassOn();
  }

 private:
  HWY_INLINE void Step() {
    if (taking_.count() >= kLanes || looking_.count() == 0)
      Take();
    else
      Look();
  }

  // Goes on with the same packet while most of it looks on.
  HWY_NOINLINE void Look() {
    const D d;
    LookingRays rays;
    hn::Mask<D> mask;
    looking_.Take(rays, mask);
    const FrameCloudField field(clouds_, rays.direction, rays.phase0, rays.phase1);
    do {
      const GroupAhead ahead = LookAhead(field, rays.way.t, mask, clouds_.steps);
      const BodyLine& line = ahead.line;
      if (!hn::AllFalse(d, ahead.taken)) {
        taking_.Add({rays, ahead.empty_until, line.body0, line.body1, line.body2, line.highest},
                    ahead.taken);
        mask = hn::AndNot(ahead.taken, mask);
      }
      rays.way.t = GoOn(ahead.group, ahead.empty_until, rays.way.end, clouds_.steps);
      mask = EndThose(rays, mask);
    } while (hn::CountTrue(d, mask) >= kEnough && taking_.count() < kLanes);
    if (!hn::AllFalse(d, mask)) looking_.Add(rays, mask);
  }

  HWY_NOINLINE void Take() {
    hn::Mask<D> mask;
    TakingRays taken;
    taking_.Take(taken, mask);
    LookingRays& rays = taken.rays;
    const FrameCloudField field(clouds_, rays.direction, rays.phase0, rays.phase1);
    const StepGroup group = GroupAt(rays.way.t, clouds_.steps);
    const V middle = MulAdd(group.length, 0.5f, group.first);
    TakeAhead(field,
              {group,
               taken.empty_until,
               {middle, taken.body0, taken.body1, taken.body2, taken.highest},
               mask},
              clouds_.steps, clouds_.volume->extinction_per_m, rays.way);
    rays.way.t = GoOn(group, taken.empty_until, rays.way.end, clouds_.steps);
    looking_.Add(rays, EndThose(rays, mask));
  }

  // Those of the mask that have not ended; the others wait to be passed on.
  HWY_INLINE hn::Mask<D> EndThose(const LookingRays& rays, hn::Mask<D> mask) {
    const auto active = AreActive(rays.way);
    const auto ended = hn::AndNot(active, mask);
    if (!hn::AllFalse(D(), ended)) {
      ended_.Add(rays, ended);
      if (ended_.count() >= kLanes) PassOn();
    }
    return mask & active;
  }

  HWY_NOINLINE void PassOn() {
    hn::Mask<D> mask;
    LookingRays rays;
    ended_.Take(rays, mask);
    end_(rays, EndRays(rays.way), mask);
  }

  static constexpr std::size_t kEnough = kLanes * 3 / 4;

  const VolumeClouds& clouds_;
  const End& end_;
  RayBuffer<LookingRays> looking_, ended_;
  RayBuffer<TakingRays> taking_;
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
