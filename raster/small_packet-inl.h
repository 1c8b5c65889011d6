// Small triangles of a tile, a lane each.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_RASTER_SMALL_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RASTER_SMALL_PACKET_INL_H_
#undef SWELL_RASTER_SMALL_PACKET_INL_H_
#else
#define SWELL_RASTER_SMALL_PACKET_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "math/lanes-inl.h"
#include "raster/pass_state.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Small triangles that wait for their turn, in submission order, and are fetched meanwhile.
class SmallQueue {
 public:
  // Adds one if `counts`; there is room.
  HWY_INLINE void Add(const Chunk& chunk, std::uint32_t place, bool counts) {
    corners_[count_] = &chunk.corners[place];
    depths_[count_] = &chunk.depths[place];
    hwy::Prefetch(corners_[count_]);
    count_ += counts;
  }
  HWY_INLINE bool IsFull() const { return count_ == kRoom; }

  // Calls draw(corners, depths, count) with whole packets, of which `count` are used, and ends
  // empty.
  template <class Draw>
  HWY_INLINE void DrawAll(const Draw& draw) {
    alignas(64) std::array<SmallCorners, kLanes> corners{};
    alignas(64) std::array<SmallDepths, kLanes> depths{};
    for (std::size_t first = 0; first < count_; first += kLanes) {
      const std::size_t count = std::min(kLanes, count_ - first);
      for (std::size_t i = 0; i < count; ++i) {
        corners[i] = *corners_[first + i];
        depths[i] = *depths_[first + i];
      }
      draw(corners.data(), depths.data(), count);
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t kRoom = 64;
  std::size_t count_ = 0;
  std::array<const SmallCorners*, kRoom + 1> corners_;
  std::array<const SmallDepths*, kRoom + 1> depths_;
};

// Corners in the window, [1/256 px].
struct SmallVertices {
  VI x[3], y[3];
};

HWY_INLINE SmallVertices LoadVertices(const SmallCorners* HWY_RESTRICT corners) {
  SmallVertices v;
  VI second, third;
  hn::LoadInterleaved4(DI(), &corners->x_fx8, v.x[0], v.y[0], second, third);
  const auto low = [](VI both) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(both)); };
  v.x[1] = v.x[0] + low(second), v.y[1] = v.y[0] + hn::ShiftRight<16>(second);
  v.x[2] = v.x[0] + low(third), v.y[2] = v.y[0] + hn::ShiftRight<16>(third);
  return v;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
