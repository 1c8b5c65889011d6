#include <algorithm>

#include "math/check.h"
#include "render/view/land_paths.h"
#include "render/view/refracted_image.h"
#include "render/world/land_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/view/land_paths_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/packets/packet-inl.h"
#include "render/world/world_state.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct Paths {
  V z, z_t, z_tt, begin, end;
};

struct Crossings {
  V t;
  M any;
};

// Where z + z_t t + z_tt t^2 is 0 for the first time after t = 0.
HWY_INLINE Crossings FirstCrossings(V z, V z_t, V z_tt) {
  const V zero = hn::Zero(D());
  const V root2 = z_t * z_t - 4.0f * z_tt * z;
  const V root = Sqrt(Max(root2, zero));
  const V under = IfThenElse(z > zero, z_t - root, z_t + root);
  const V t = -2.0f * z / under;
  const M crosses = (root2 >= zero) & (z != zero);
  return {t, crosses & ((under != zero) & (t > zero))};
}

HWY_INLINE Paths Straight(const RenderView& view, V3 direction, V sag) {
  return {Constant(static_cast<float>(view.camera.eye_world.z)), direction.z, sag,
          Constant(view.camera.near_m), Constant(kFarthestLand)};
}

// No way at all where a mask is false.
HWY_INLINE Paths Where(M mask, const Paths& p) {
  return {IfThenElseZero(mask, p.z), IfThenElseZero(mask, p.z_t), IfThenElseZero(mask, p.z_tt),
          IfThenElse(mask, p.begin, 1.0f), IfThenElseZero(mask, p.end)};
}

HWY_INLINE Paths Mirrored(const RenderView& view, float above_m, V3 direction, V sag, V begin) {
  return {Constant(view.level_m - above_m), -direction.z, -sag, Max(begin, view.camera.near_m),
          Constant(kFarthestLand)};
}

// How far rays that meet the level at `at` with the slope z_t fall a t, on the chord from there to
// `towards`.
HWY_NOINLINE V FallByThePaper(const RenderView& view, V h2, V z_t, V at, V towards) {
  HWY_ALIGN float h2_of[kLanes], fall[kLanes], t0[kLanes], t1[kLanes];
  hn::Store(h2, D(), h2_of), hn::Store(-z_t, D(), fall);
  hn::Store(at, D(), t0), hn::Store(towards, D(), t1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (!(fall[i] > 0.0f && t0[i] > 0.0f && t0[i] < kFarthestLand)) continue;
    const float image_m = fall[i] * std::clamp(t1[i] - t0[i], 0.0f, kFarthestLand);
    fall[i] /= paper_depth_ratio_seen(fall[i] * t0[i], image_m, std::sqrt(h2_of[i]) / fall[i],
                                      view.refraction_index);
  }
  return hn::Load(D(), fall);
}

// On from where they meet the level at t.
HWY_INLINE Paths Refracted(const RenderView& view, V3 direction, V h2, V sag, const Crossings& at,
                           V towards) {
  const V zero = hn::Zero(D());
  const V z_t = direction.z + (sag + sag) * at.t;
  const float n = view.eye.submerged ? 1.0f / view.refraction_index : view.refraction_index;
  const V down2 = n * n * (h2 + z_t * z_t) - h2;
  const V down = view.paper_refraction && !view.eye.submerged
                     ? FallByThePaper(view, h2, z_t, at.t, towards)
                     : Sqrt(Max(down2, zero));
  const V before = view.clip_margin_m / down;
  const V slope = view.eye.submerged ? down : -down;
  const Paths paths = {view.level_m - at.t * slope, slope, zero,
                       Max(at.t - before, view.camera.near_m), Constant(kFarthestLand)};
  return Where(at.any & (down2 > zero), paths);  // or mirrored wholly
}

HWY_INLINE Paths PathsOf(const RenderView& view, V3 direction, V towards) {
  const V h2 = direction.x * direction.x + direction.y * direction.y;
  const V sag = view.drop_per_m2 * h2;
  const Paths straight = Straight(view, direction, sag);
  if (view.kind == ViewKind::kWindow) return straight;

  const float above_m = static_cast<float>(view.camera.eye_world.z) - view.level_m;
  // The eye may be on the other side already.
  const bool beyond = view.eye.submerged == (above_m > 0.0f);
  const bool mirrors = view.kind == ViewKind::kReflection;
  if (beyond) return mirrors ? Mirrored(view, above_m, direction, sag, straight.begin) : straight;
  const Crossings level = FirstCrossings(Constant(above_m), direction.z, sag);
  return mirrors ? Where(level.any, Mirrored(view, above_m, direction, sag, level.t))
                 : Refracted(view, direction, h2, sag, level, towards);
}

// The part of paths where a height over something, which has this value and slope where they begin
// and this half curvature, is at least 0: from where they come to it, to where they leave it.
HWY_INLINE void KeepAbove(V above, V rise, V half_curve, Paths& p) {
  const Crossings way = FirstCrossings(above, rise, half_curve);
  const V there = p.begin + way.t;
  const M is_above = above >= 0.0f;
  p.begin = IfThenElse(is_above, p.begin, IfThenElse(way.any, there, p.end));
  p.end = IfThenElse(is_above & way.any, Min(p.end, there), p.end);
}

HWY_INLINE void ClipToOutline(float outline_m, Paths& p) {
  const V slope = p.z_t + p.begin * p.z_tt;
  const V above = p.z + p.begin * slope - outline_m;
  const V rise = p.z_t + 2.0f * p.z_tt * p.begin;
  KeepAbove(above, rise, p.z_tt, p);
}

// plane: of points relative to the eye along the mean level, and their heights over it.
HWY_INLINE void ClipToPlane(glm::vec4 plane, V3 direction, Paths& p) {
  const V level_t = plane.x * direction.x + plane.y * direction.y;
  const V slope = p.z_t + p.begin * p.z_tt;
  const V above = plane.z * (p.z + p.begin * slope) + (level_t * p.begin + plane.w);
  const V rise = plane.z * (p.z_t + 2.0f * p.z_tt * p.begin) + level_t;
  KeepAbove(above, rise, plane.z * p.z_tt, p);
}

// ray + y ray_dy + x ray_dx.
HWY_INLINE V DirectionOf(float ray, float ray_dx, float ray_dy, V x_px, V y_px) {
  return ray + y_px * ray_dy + x_px * ray_dx;
}

void SetLandRays(const RenderView& view, const ViewRays& rays, const LandRaysThrough& through) {
  const D d;
  const std::size_t count = through.x.size();
  const glm::dvec3 eye_on_level(glm::dvec2(view.camera.eye_world), 0.0);
  const glm::vec4 plane = relative_plane(view.clip_plane.value_or(glm::dvec4(0.0)), eye_on_level);
  for (std::size_t n = 0; n < count; n += kLanes) {
    const std::size_t some = std::min(kLanes, count - n);
    const auto load = [&](std::span<const float> values) HWY_ATTR {
      if (some == kLanes) return hn::LoadU(d, values.data() + n);
      HWY_ALIGN float lane[kLanes] = {};
      std::copy_n(values.data() + n, some, lane);
      return hn::Load(d, lane);
    };
    const auto store = [&](V values, std::span<float> to) HWY_ATTR {
      if (some == kLanes) return hn::StoreU(values, d, to.data() + n);
      HWY_ALIGN float lane[kLanes];
      hn::Store(values, d, lane);
      std::copy_n(lane, some, to.data() + n);
    };
    const V x_px = load(through.x_px), y_px = load(through.y_px), depth = load(through.depth);
    const V3 direction = {DirectionOf(rays.ray.x, rays.ray_dx.x, rays.ray_dy.x, x_px, y_px),
                          DirectionOf(rays.ray.y, rays.ray_dx.y, rays.ray_dy.y, x_px, y_px),
                          DirectionOf(rays.ray.z, rays.ray_dx.z, rays.ray_dy.z, x_px, y_px)};
    Paths paths = PathsOf(view, direction, load(through.towards));
    if (view.land->outline_m) ClipToOutline(*view.land->outline_m, paths);
    if (view.clip_plane) ClipToPlane(plane, direction, paths);
    const V there = Min(paths.end, rays.near_m / depth);
    paths.end = IfThenElse(depth > 0.0f, there, paths.end);
    store(direction.x, through.x), store(direction.y, through.y);
    store(paths.z, through.z), store(paths.z_t, through.z_t), store(paths.z_tt, through.z_tt);
    const auto begin = [&](std::span<const float> free)
                           HWY_ATTR { return Min(Max(paths.begin, load(free)), kFarthestLand); };
    store(begin(through.free), through.begin);
    store(begin(through.free_around), through.begin_around);
    store(paths.end, through.end);
  }
}

void OneLandPath(const RenderView& view, glm::vec3 direction, float towards, LandPath* path) {
  const Paths p = PathsOf(view, Constant(direction), Constant(towards));
  *path = {hn::GetLane(p.z), hn::GetLane(p.z_t), hn::GetLane(p.z_tt), hn::GetLane(p.begin),
           hn::GetLane(p.end)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(SetLandRays);
HWY_EXPORT(OneLandPath);

LandPath land_path(const RenderView& view, glm::vec3 direction, float towards) {
  LandPath path;
  HWY_DYNAMIC_DISPATCH(OneLandPath)(view, direction, towards, &path);
  return path;
}

void set_land_rays(const RenderView& view, const ViewRays& rays, const LandRaysThrough& through) {
  const std::size_t count = through.x.size();
  for (const std::span<const float> values : {through.x_px, through.y_px, through.depth,
                                              through.free, through.free_around, through.towards})
    SWELL_CHECK(values.size() == count, "rays={} values={}", count, values.size());
  for (const std::span<float> values : {through.y, through.z, through.z_t, through.z_tt,
                                        through.begin, through.begin_around, through.end})
    SWELL_CHECK(values.size() == count, "rays={} values={}", count, values.size());
  HWY_DYNAMIC_DISPATCH(SetLandRays)(view, rays, through);
}

}  // namespace swell::render
#endif
