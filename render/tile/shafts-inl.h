// Shafts of light under water.
#if defined(SWELL_RENDER_TILE_SHAFTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SHAFTS_INL_H_
#undef SWELL_RENDER_TILE_SHAFTS_INL_H_
#else
#define SWELL_RENDER_TILE_SHAFTS_INL_H_
#endif

#include "render/tile/caustics-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/through_water-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A ray from the eye through water: up is its sine.
struct ShaftRay {
  V lost_per_m;  // of light scattered on it, with what its depth has taken
  V reach;       // to where it leaves the water, at most Shafts::reach_m
  V end;         // the same without end but for what is too dim
};

HWY_INLINE ShaftRay FindShaftRay(const Shafts& shafts, V up) {
  const V to_level = shafts.eye_depth_m / Max(up, 1e-4f);
  return {
      NegMulAdd(up, shafts.daylight_lost_per_m, shafts.lost_per_m),
      Min(to_level, shafts.reach_m),
      Min(to_level, 8.0f / shafts.lost_per_m),
  };
}

// What is scattered to the eye on so many metres of a ray, over what one metre at the eye does.
HWY_INLINE V ScatteredOn(const ShaftRay& ray, V length) {
  const V x = ray.lost_per_m * length;
  return length * LossOver(x, Exp(D(), -x));
}

// The sun's part of what is scattered towards the eye along a ray: water scatters forward. Source:
// Henyey and Greenstein, Diffuse radiation in the galaxy, 1941, with g = 1/2, of which 1 is even.
HWY_INLINE V SunScattered(const Shafts& shafts, V3 ray) {
  constexpr float kG = 0.5f;
  const V cosine = Dot(ray, Constant(shafts.to_sun));
  const V under = NegMulAdd(cosine, 2.0f * kG, 1.0f + kG * kG);
  const V phase = (1.0f - kG * kG) / (under * Sqrt(under));
  const V sun = phase * shafts.sun_part;
  return sun / (sun + (1.0f - shafts.sun_part + 1e-6f));
}

// What clouds leave of the sun at a point in the water, over its mean.
HWY_INLINE V SunUnderCloudsInWater(const Shading& s, const CloudShadow& clouds, V3 p) {
  const V level = Constant(s.level_rel_m);
  const V depth = Max(level - p.z, 0.0f);
  return SunUnderClouds(
      clouds,
      {MulAdd(depth, s.sun_shadow.entry.x, p.x), MulAdd(depth, s.sun_shadow.entry.y, p.y), level},
      s.rays.eye_z);
}

// What land and objects leave of the sun at a point in the water.
HWY_INLINE V SunVisibleInWater(const Shading& s, std::span<const std::uint16_t> casters, V3 p) {
  V visible = Constant(1.0f);
  if (!s.sun_shadow.land && casters.empty()) return visible;
  const V3 enters = WhereLightEnters(s, p);
  if (s.sun_shadow.land) visible = SunOverLand(s.sun_shadow, enters, s.rays.eye_z);
  if (casters.empty()) return visible;
  const LitPoint point = {enters, Constant(0.05f), Constant(-1.0f)};
  constexpr PixelSpan kAnywhere = {-1e9f, -1e9f, 1e9f, 1e9f};  // nodes lie outside their tile, too
  return visible * SunOverObjects(s.sun_shadow, casters, kAnywhere, point);
}

constexpr float kMostShaft = 4.0f;  // times the mean
constexpr int kShaftSteps = 28;     // a multiple of 4

// Follows rays, given by where they go. Steps grow with the distance: half of them lie on a quarter
// of the way.
HWY_NOINLINE static VI FollowShafts(const Shading& s, std::span<const std::uint16_t> casters,
                                    const V3& direction) {
  const Shafts& shafts = s.shafts;
  const CloudShadow* const clouds = s.sun_shadow.clouds;
  const V one = Constant(1.0f);
  const ShaftRay ray = FindShaftRay(shafts, direction.z);
  const float node_angle = s.rays.pixel_angle * static_cast<float>(1 << shafts.step_log2);
  // How fast a point of the ray moves over the pattern: along the sun's light it stays the same.
  const V across_x = NegMulAdd(direction.z, s.sun_shadow.entry.x, direction.x);
  const V across_y = NegMulAdd(direction.z, s.sun_shadow.entry.y, direction.y);
  const V across = Sqrt(MulAdd(across_x, across_x, across_y * across_y));
  std::array<V, 2> more = {hn::Zero(D()), hn::Zero(D())};
  V visible = one, under_clouds = one;
  for (int i = 0; i < kShaftSteps; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kShaftSteps;
    const V t = ray.reach * (u * u);
    const V step = ray.reach * (2.0f * u / kShaftSteps);
    const V size = Max(t * node_angle, step * across * 0.45f);
    const V level_m = Log2Coarse(D(), Max(size, 1e-3f));
    const V3 p = direction * t;
    if (i % 2 == 0) visible = SunVisibleInWater(s, casters, p);
    const V more_sun = (GatheredSun<true>(s, p, level_m) - one) * shafts.contrast;
    V sun = MulAdd(more_sun, visible, visible) - one;
    // Sunlight that has been scattered on its way down makes no shafts.
    const V depth = NegMulAdd(t, direction.z, shafts.eye_depth_m);
    const V lost = MulAdd(depth, shafts.diffused_per_m, t * ray.lost_per_m);
    const V weight = step * Exp(D(), -lost);
    V& part = more[2 * i / kShaftSteps];
    if (clouds) {
      // Under clouds it is missing all the same.
      if (i % 2 == 0) under_clouds = SunUnderCloudsInWater(s, *clouds, p);
      sun = sun * under_clouds;
      const V all = step * Exp(D(), -(t * ray.lost_per_m));
      part = MulAdd(under_clouds - one, all, part);
    }
    part = MulAdd(sun, weight, part);
  }
  // Clouds' shadows go on beyond where shafts end.
  if (clouds) {
    const V beyond = ScatteredOn(ray, ray.end) - ScatteredOn(ray, ray.reach);
    more[1] = MulAdd(under_clouds - one, Max(beyond, 0.0f), more[1]);
  }
  const V near = ScatteredOn(ray, ray.reach * 0.25f);
  const V beyond = Max(ScatteredOn(ray, ray.end) - near, 1e-3f);
  const V sun_part = SunScattered(shafts, direction);
  const auto code = [&](V part, V all) HWY_ATTR {
    const V shaft = Clamp(part / all * sun_part, -1.0f, kMostShaft);
    return RoundToInt((shaft + one) * (65535.0f / (1.0f + kMostShaft)));
  };
  return code(more[0], near) | hn::ShiftLeft<16>(code(more[1], beyond));
}

// Nodes along one side of a tile, for so many pixels.
constexpr int shaft_nodes_along(int pixels, int step_log2) {
  return ((pixels - 1) >> step_log2) + 2;
}

// Returns the nodes' codes, or none where there are no shafts.
inline const std::int32_t* FindShafts(const Shading& s, const raster::PixelBox& box,
                                      std::span<const std::uint16_t> casters, ShaftNodes& nodes) {
  if (s.shafts.reach_m <= 0.0f) return nullptr;
  const D d;
  const int step_log2 = s.shafts.step_log2, columns = shaft_nodes_along(box.width_px, step_log2);
  const int count = columns * shaft_nodes_along(box.height_px, step_log2);
  for (int first = 0; first < count; first += static_cast<int>(kLanes)) {
    HWY_ALIGN std::array<float, kLanes> x, y;
    for (int lane = 0; lane < static_cast<int>(kLanes); ++lane) {
      const int node = std::min(first + lane, count - 1);
      x[lane] = static_cast<float>(box.x0_px + (node % columns << step_log2));
      y[lane] = static_cast<float>(box.y0_px + (node / columns << step_log2));
    }
    const V3 ray = RayAt(s.rays, hn::Load(d, x.data()), hn::Load(d, y.data()));
    const V3 direction = ray * InverseSqrt(Dot(ray, ray));
    hn::StoreU(FollowShafts(s, casters, direction), DI(), nodes.code.data() + first);
  }
  return nodes.code.data();
}

// The light that is scattered to the eye on so many metres before the places (x_px, y_px), against
// the mean. Parts of pixels have that of their pixel: of the same nodes in tiles of all sizes.
HWY_INLINE V ShaftsBefore(const Shading& s, const raster::PixelBox& box,
                          const std::int32_t* HWY_RESTRICT codes, V x_px, V y_px, V up, V length) {
  const D d;
  const DI di;
  const V one = Constant(1.0f);
  if (!codes) return one;
  const int step_log2 = s.shafts.step_log2, columns = shaft_nodes_along(box.width_px, step_log2);
  const VI x = RoundToInt(x_px) - box.x0_px;
  const VI y = RoundToInt(y_px) - box.y0_px;
  const VI column = hn::ShiftRightSame(x, step_log2), row = hn::ShiftRightSame(y, step_log2);
  const auto between = [&](VI at) HWY_ATTR {
    const VI rest = at & ((1 << step_log2) - 1);
    return hn::ConvertTo(d, rest) * (1.0f / static_cast<float>(1 << step_log2));
  };
  const V right = between(x), down = between(y);
  const VI first = row * columns + column;
  const auto gather = [&](int offset)
                          HWY_ATTR { return hn::GatherIndex(di, codes + offset, first); };
  const VI at00 = gather(0), at10 = gather(1), at01 = gather(columns), at11 = gather(columns + 1);
  const auto shaft = [&](const auto& part) HWY_ATTR {
    const auto of = [&](VI code) HWY_ATTR { return hn::ConvertTo(d, part(code)); };
    const V mean = Lerp(Lerp(of(at00), of(at10), right), Lerp(of(at01), of(at11), right), down);
    return MulAdd(mean, (1.0f + kMostShaft) / 65535.0f, -1.0f);
  };
  const V near = shaft([&](VI code) HWY_ATTR { return code & 0xffff; });
  const V beyond = shaft([&](VI code) HWY_ATTR { return hn::ShiftRight<16>(code) & 0xffff; });
  const ShaftRay ray = FindShaftRay(s.shafts, up);
  // About the part that is scattered near the eye: t / (1 + q t) for (1 - e^(-q t)) / q.
  const V lost = Max(ray.lost_per_m, 0.0f), end = ray.reach * 0.25f;
  const V way = Max(Min(length, ray.end), end);
  const V near_part = end * MulAdd(lost, way, one) / (way * MulAdd(lost, end, one));
  return Lerp(beyond, near, near_part) + one;
}

// Water as far as the eye sees, where it sees nothing else.
HWY_INLINE V3 OpenWater(const Shading& s, const raster::PixelBox& box, const std::int32_t* codes,
                        V x_px, V y_px) {
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const V up = ray.z * InverseSqrt(Dot(ray, ray));
  const V3 light = EndlessWater(s.media, s.media.daylight_at_eye, Max(-up, 0.0f));
  return light * ShaftsBefore(s, box, codes, x_px, y_px, up, Constant(1e6f));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
