#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <span>

#include "math/check.h"
#include "raster/vertices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertices_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Flag where the mask holds, else 0.
template <class Mask>
HWY_INLINE VI FlagIf(Mask mask, std::uint32_t flag) {
  const DI di;
  return IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, static_cast<int>(flag)));
}

// Clip distances of one packet.
struct User {
  V first, second;
};

// The flags of one packet, before kNotFinite.
HWY_INLINE VI OutsideFlags(V x, V y, V z, V w, const User& user, V guard_x, V guard_y) {
  const D d;
  const V zero = hn::Zero(d);
  // Frustum and user planes.
  const V minus_w = -w;
  VI flags = FlagIf(x < minus_w, kOutsideLeft);
  flags = flags | FlagIf(x > w, kOutsideRight);
  flags = flags | FlagIf(y > w, kOutsideTop);
  flags = flags | FlagIf(y < minus_w, kOutsideBottom);
  flags = flags | FlagIf(z > w, kOutsideNear);
  flags = flags | FlagIf(z < zero, kOutsideFar);
  flags = flags | FlagIf(w < kMinW, kOutsideW);
  flags = flags | FlagIf(user.first < zero, kOutsideUser);
  flags = flags | FlagIf(user.second < zero, kOutsideUser2);
  // The fused k w - |x| has the sign of the exact value, as the clipper's double has.
  const auto out_x = MulSub(guard_x, w, Abs(x)) < zero;
  const auto out_y = MulSub(guard_y, w, Abs(y)) < zero;
  return flags | FlagIf(out_x | out_y, kOutsideGuard);
}

// One packet: lanes from p_clip (4 floats a vertex) and user to out.
HWY_INLINE void ProjectPacket(const float* HWY_RESTRICT p_clip, const User& user, Viewport viewport,
                              std::int32_t* HWY_RESTRICT out) {
  const D d;
  const DI di;
  V x, y, z, w;
  hn::LoadInterleaved4(d, p_clip, x, y, z, w);
  const auto width = static_cast<float>(viewport.width_px);
  const auto height = static_cast<float>(viewport.height_px);

  // Flags.
  const V guard_x = hn::Set(d, 2.0f * kGuardPx / width - 1.0f);
  const V guard_y = hn::Set(d, 2.0f * kGuardPx / height - 1.0f);
  const auto finite = ((hn::IsFinite(x) & hn::IsFinite(y)) & (hn::IsFinite(z) & hn::IsFinite(w))) &
                      (hn::IsFinite(user.first) & hn::IsFinite(user.second));
  const VI outside = OutsideFlags(x, y, z, w, user, guard_x, guard_y);
  const VI flags =
      IfThenElse(hn::RebindMask(di, finite), outside, hn::Set(di, static_cast<int>(kNotFinite)));

  // Only vertices that need no clipping are divided; the others become the origin.
  const VI unusable = flags & static_cast<int>(kClipFlags | kNotFinite);
  const auto usable = hn::RebindMask(d, unusable == hn::Zero(di));
  const V divisor = IfThenElse(usable, w, 1.0f);
  const V x_ndc = IfThenElseZero(usable, x) / divisor;
  const V y_ndc = IfThenElseZero(usable, y) / divisor;
  const V depth = IfThenElseZero(usable, z) / divisor;

  // x_px = (x_ndc + 1) width / 2, y_px = (1 - y_ndc) height / 2, times 256, to nearest even.
  const V half_x = hn::Set(d, 0.5f * kPixelFx8 * width);
  const V half_y = hn::Set(d, 0.5f * kPixelFx8 * height);
  const VI x_fx8 = hn::NearestInt(MulAdd(x_ndc, half_x, half_x));
  const VI y_fx8 = hn::NearestInt(NegMulAdd(y_ndc, half_y, half_y));
  hn::StoreInterleaved4(x_fx8, y_fx8, hn::BitCast(di, depth), flags, di, out);
}

void ProjectVertices(std::span<const glm::vec4> p_clip, const ClipDistances& clip_distance,
                     Viewport viewport, std::span<WindowVertex> out) {
  const D d;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  const auto user_at = [&](std::span<const float> distance, std::size_t at) HWY_ATTR {
    return distance.empty() ? hn::Zero(d) : hn::LoadU(d, &distance[at]);
  };
  std::size_t i = 0;
  for (; i + kLanes <= p_clip.size(); i += kLanes) {
    const User user = {user_at(clip_distance[0], i), user_at(clip_distance[1], i)};
    ProjectPacket(&p_clip[i].x, user, viewport, &out[i].x_fx8);
  }
  if (i == p_clip.size()) return;

  // The tail goes through padded copies.
  std::array<float, 4 * kLanes> tail_in{};
  std::array<std::array<float, kLanes>, kClipDistances> tail_user{};
  std::array<std::int32_t, 4 * kLanes> tail_out;
  const std::size_t count = p_clip.size() - i;
  std::copy_n(&p_clip[i].x, 4 * count, tail_in.data());
  for (std::size_t k = 0; k < kClipDistances; ++k)
    if (!clip_distance[k].empty())
      std::memcpy(tail_user[k].data(), &clip_distance[k][i], count * sizeof(float));
  const User user = {hn::LoadU(d, tail_user[0].data()), hn::LoadU(d, tail_user[1].data())};
  ProjectPacket(tail_in.data(), user, viewport, tail_out.data());
  std::memcpy(&out[i], tail_out.data(), count * sizeof(WindowVertex));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::raster {

HWY_EXPORT(ProjectVertices);

void project_vertices(std::span<const glm::vec4> p_clip, const ClipDistances& clip_distance,
                      Viewport viewport, std::span<WindowVertex> out) {
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float) && sizeof(WindowVertex) == 16);
  SWELL_CHECK(out.size() == p_clip.size(), "out={} p_clip={}", out.size(), p_clip.size());
  for (const std::span<const float> distance : clip_distance)
    SWELL_CHECK(distance.empty() || distance.size() == p_clip.size(), "clip_distance={} p_clip={}",
                distance.size(), p_clip.size());
  HWY_DYNAMIC_DISPATCH(ProjectVertices)(p_clip, clip_distance, viewport, out);
}

}  // namespace swell::raster
#endif
