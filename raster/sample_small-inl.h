// Draws the samples of small triangles side by side, a lane each. The same arithmetic as one by
// one, for the same bits.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_RASTER_SAMPLE_SMALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RASTER_SAMPLE_SMALL_INL_H_
#undef SWELL_RASTER_SAMPLE_SMALL_INL_H_
#else
#define SWELL_RASTER_SAMPLE_SMALL_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "math/lanes-inl.h"
#include "raster/sample_edges.h"
#include "raster/sample_target-inl.h"
#include "raster/small_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Small triangles around which pixels are marked, until a packet is full.
template <int kSamples>
class SmallSampler {
 public:
  explicit SmallSampler(const SampleTarget& target) : target_(target) {}

  // Adds those of a packet that have a marked pixel around them. Draws when there are enough.
  HWY_INLINE void Add(const SmallCorners* HWY_RESTRICT corners,
                      const SmallDepths* HWY_RESTRICT depths, std::size_t count) {
    const DI di;
    const SmallVertices v = LoadVertices(corners);
    const auto low = [](const VI(&c)[3]) HWY_ATTR { return Min(Min(c[0], c[1]), c[2]); };
    const auto high = [](const VI(&c)[3]) HWY_ATTR { return Max(Max(c[0], c[1]), c[2]); };
    // As of sample_rect_in_tile().
    const auto first = [&](const VI(&c)[3], std::int32_t from_px) HWY_ATTR {
      const std::int32_t up = kPixelFx8 - 1 - target_.extent.high_fx8;
      return Max(hn::ShiftRight<kFractionBits>(low(c) + up) - from_px, 0);
    };
    const auto last = [&](const VI(&c)[3], std::int32_t from_px, std::int32_t size_px) HWY_ATTR {
      const VI end = high(c) - target_.extent.low_fx8;
      return Min(hn::ShiftRight<kFractionBits>(end) - from_px, size_px - 1);
    };
    alignas(64) std::array<std::int32_t, kLanes> x0, y0, x1, y1;
    hn::Store(first(v.x, target_.box.x0_px), di, x0.data());
    hn::Store(first(v.y, target_.box.y0_px), di, y0.data());
    hn::Store(last(v.x, target_.box.x0_px, target_.box.width_px), di, x1.data());
    hn::Store(last(v.y, target_.box.y0_px, target_.box.height_px), di, y1.data());
    for (std::size_t i = 0; i < count; ++i)
      AddOne(corners[i], depths[i], {x0[i], y0[i], x1[i], y1[i]});
  }

  // Draws those that wait.
  HWY_INLINE void Draw() {
    if (used_ == 0) return;
    const D d;
    const DI di;
    const SmallVertices v = LoadVertices(corners_.data());
    const SmallPlanes plane = SetUpPlanes(v, depths_.data());
    const SmallEdge edge[3] = {EdgeOf(v, 0), EdgeOf(v, 1), EdgeOf(v, 2)};
    const VI count =
        IfThenElseZero(CountFrom(0) < static_cast<int>(used_), hn::Load(di, pixels_.data()));
    const auto to_px = [&](VI fx8) HWY_ATTR { return hn::ConvertTo(d, fx8) * (1.0f / kPixelFx8); };
    VI covered = hn::Zero(di);
    const int most = hn::GetLane(hn::MaxOfLanes(di, count));
    for (int k = 0; k < most; ++k) {
      const VI px_fx8 = hn::Load(di, &x_fx8_[At(k, 0)]), py_fx8 = hn::Load(di, &y_fx8_[At(k, 0)]);
      const auto is_left = hn::Set(di, k) < count;
      const VI e[3] = {edge[0].At(px_fx8, py_fx8), edge[1].At(px_fx8, py_fx8),
                       edge[2].At(px_fx8, py_fx8)};
      for (int s = 0; s < kSamples; ++s) {
        const SamplePosition p = sample_positions(kSamples)[static_cast<std::size_t>(s)];
        const auto at_sample = [&](int i) HWY_ATTR {
          return e[i] + (edge[i].a * p.x_fx8 + edge[i].b * p.y_fx8);
        };
        const auto inside = ((at_sample(0) | at_sample(1)) | at_sample(2)) > -1;
        const int bit = k * kSamples + s;
        const VI one = hn::Set(di, static_cast<int>(1u << bit));
        covered = covered | IfThenElseZero(inside & is_left, one);
        const V row = MulAdd(plane.dz_dy, to_px(py_fx8 + p.y_fx8 - plane.y_ref), plane.z_min);
        const V z = MulAdd(plane.dz_dx, to_px(px_fx8 + p.x_fx8 - plane.x_ref), row);
        hn::Store(Min(Max(z, plane.z_min), plane.z_max), d, &depth_[At(bit, 0)]);
      }
    }
    Resolve(covered);
    used_ = 0;
    pixels_[0] = 0;
  }

 private:
  static constexpr int kMostPixels = 32 / kSamples;  // a bit a sample

  static std::size_t At(int k, std::size_t lane) {
    return static_cast<std::size_t>(k) * kLanes + lane;
  }

  // `rect` lies in the tile.
  HWY_INLINE void AddOne(const SmallCorners& corners, const SmallDepths& depths,
                         const PixelRect& rect) {
    const std::uint64_t columns = bits_between(rect.x0, rect.x1);
    for (std::int32_t y = rect.y0; y <= rect.y1; ++y) {
      const std::uint64_t row = target_.mask.row(y);
      for (std::uint64_t left = row & columns; left != 0; left &= left - 1) {
        const int x = std::countr_zero(left);
        const std::size_t at = At(pixels_[used_]++, used_);
        x_fx8_[at] = (target_.box.x0_px + x) * kPixelFx8;
        y_fx8_[at] = (target_.box.y0_px + y) * kPixelFx8;
        const auto before = std::popcount(row & ~(~std::uint64_t{0} << x));
        first_sample_[at] =
            (target_.row_begin[static_cast<std::size_t>(y)] + static_cast<std::uint32_t>(before)) *
            kSamples;
        if (pixels_[used_] < kMostPixels) continue;
        // The rest takes another lane.
        TakeLane(corners, depths);
      }
    }
    if (pixels_[used_] > 0) TakeLane(corners, depths);
  }

  HWY_INLINE void TakeLane(const SmallCorners& corners, const SmallDepths& depths) {
    corners_[used_] = corners;
    depths_[used_] = depths;
    if (++used_ == kLanes) Draw();
    pixels_[used_] = 0;
  }

  // Depth tests of what is covered, one lane after the other: triangles may cover each other.
  HWY_INLINE void Resolve(VI covered) {
    alignas(64) std::array<std::uint32_t, kLanes> bits;
    hn::Store(hn::BitCast(DU(), covered), DU(), bits.data());
    for (std::size_t lane = 0; lane < used_; ++lane)
      for (std::uint32_t left = bits[lane]; left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        const std::size_t sample =
            first_sample_[At(bit / kSamples, lane)] + static_cast<std::size_t>(bit % kSamples);
        const float z = depth_[At(bit, lane)];
        if (!(z > target_.depth[sample])) continue;
        target_.depth[sample] = z;
        target_.primitive[sample] = depths_[lane].primitive;
      }
  }

  const SampleTarget& target_;
  std::size_t used_ = 0;  // lanes
  alignas(64) std::array<SmallCorners, kLanes> corners_{};
  alignas(64) std::array<SmallDepths, kLanes> depths_{};
  // Of each lane its marked pixels, at most kMostPixels: how many, and of the k-th at At(k, lane)
  // its corner in the window and its first sample.
  alignas(64) std::array<std::int32_t, kLanes + 1> pixels_{};
  alignas(64) std::array<std::int32_t, kMostPixels * kLanes> x_fx8_{}, y_fx8_{};
  std::array<std::uint32_t, kMostPixels * kLanes> first_sample_{};
  alignas(64) std::array<float, 32 * kLanes> depth_;
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
