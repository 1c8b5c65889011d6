// The sky as the eye sees it.
#if defined(SWELL_RENDER_TILE_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SKY_INL_H_
#undef SWELL_RENDER_TILE_SKY_INL_H_
#else
#define SWELL_RENDER_TILE_SKY_INL_H_
#endif

#include "render/materials/clouds-inl.h"
#include "render/tile/packet-inl.h"
#include "texture/smooth_image-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The clear sky's radiance in a direction of length 1 that does not point down.
HWY_INLINE V3 ClearSky(const texture::SmoothImage& map, V3 direction) {
  const V one = Constant(1.0f);
  const V across =
      hn::Sqrt(hn::MulAdd(direction.x, direction.x, hn::Mul(direction.y, direction.y)));
  const V r = hn::Min(hn::Div(across, hn::Add(one, direction.z)), one);
  const V warped = hn::Sub(one, hn::Sqrt(hn::Sub(one, r)));
  const float half = 0.5f * static_cast<float>(map.size);
  const V scale = hn::Div(hn::Mul(warped, Constant(half)), hn::Max(across, Constant(1e-6f)));
  const V middle = Constant(half - 0.5f);
  V3 light;
  texture::HWY_NAMESPACE::SampleSmooth(D(), map, hn::MulAdd(direction.x, scale, middle),
                                       hn::MulAdd(direction.y, scale, middle), light.x, light.y,
                                       light.z);
  return light;
}

constexpr float kDiscRadius = 0.004654f;  // of the sun and the moon

// The part of a pixel that the disc of the sun or the moon fills, by the direction's distance from
// its middle; half a degree across.
HWY_INLINE V DiscPart(const Light& light, V3 direction, float pixel_angle) {
  const V3 to_light = Constant(light.sun_direction);
  const V3 apart = {hn::Sub(direction.x, to_light.x), hn::Sub(direction.y, to_light.y),
                    hn::Sub(direction.z, to_light.z)};
  const float rim = std::max(pixel_angle, 0.02f * kDiscRadius);
  const V inside = hn::Sub(Constant(kDiscRadius), hn::Sqrt(Dot(apart, apart)));
  return Clamp(hn::MulAdd(inside, Constant(1.0f / rim), Constant(0.5f)), 0.0f, 1.0f);
}

// What of the sky changes slowly from pixel to pixel.
struct SkyView {
  V3 clear;
  CloudView clouds;  // if there are any
};

HWY_INLINE SkyView ViewSky(const Shading& s, V3 ray) {
  const D d;
  // Below the horizon (beyond the sea's last triangle) the horizon's colour goes on.
  const V3 level = {ray.x, ray.y, hn::Max(ray.z, hn::Zero(d))};
  const V3 above = Scale(level, InverseSqrt(hn::Max(Dot(level, level), Constant(1e-12f))));
  SkyView view = {ClearSky(*s.light.sky_clear, above), {}};
  if (s.light.clouds.any)
    view.clouds = ViewClouds(s.light.clouds, above, Log2Coarse(d, Constant(s.rays.pixel_angle)));
  return view;
}

// The sky's light in a ray's direction; the disc is looked for where `sees_disc`.
HWY_INLINE V3 SkyLight(const Shading& s, const SkyView& view, V3 ray, bool sees_disc) {
  V3 light = view.clear;
  V passes = Constant(1.0f);
  if (s.light.clouds.any) light = AddClouds(s.light.clouds, view.clouds, light, passes);
  if (!sees_disc) return light;
  const V3 direction = Scale(ray, InverseSqrt(Dot(ray, ray)));
  const V disc = DiscPart(s.light, direction, s.rays.pixel_angle);
  const V shown = hn::IfThenElseZero(hn::Gt(ray.z, hn::Zero(D())), hn::Mul(disc, passes));
  return ScaleAdd(Constant(s.light.disc_radiance), shown, light);
}

HWY_INLINE V3 ShadeSky(const Shading& s, V x_px, V y_px) {
  const V3 ray = RayAt(s.rays, x_px, y_px);
  return SkyLight(s, ViewSky(s, ray), ray, true);
}

// What changes slowly is found on every fourth pixel of every fourth row, and lies on straight
// lines between them: within 1/255 of what it is.
struct SkyLattice {
  ShadeScratch::SkyNodes& nodes;
  bool sees_disc;
};

HWY_INLINE void StoreView(const SkyView& view, bool clouds, std::size_t at,
                          ShadeScratch::SkyNodes& nodes) {
  const D d;
  std::size_t channel = 0;
  const auto store = [&](V value) HWY_ATTR { hn::StoreU(value, d, &nodes[channel++][at]); };
  store(view.clear.x), store(view.clear.y), store(view.clear.z);
  if (!clouds) return;
  const CloudView& c = view.clouds;
  store(c.x), store(c.y), store(c.level), store(c.shown), store(c.forward), store(c.overcast);
}

// The lattice over a tile.
inline SkyLattice MakeSkyLattice(const Shading& s, const raster::PixelBox& box,
                                 ShadeScratch& scratch) {
  const D d;
  const int rows = (box.height_px - 1) / kSkyStep + 2, columns = (box.width_px - 1) / kSkyStep + 2;
  const float step = static_cast<float>(kSkyStep);
  V nearest = Constant(-4.0f);
  for (int row = 0; row < rows; ++row) {
    const V y_px = Constant(static_cast<float>(box.y0_px + row * kSkyStep));
    for (int column = 0; column < columns; column += static_cast<int>(kLanes)) {
      const V x_px = hn::MulAdd(hn::ConvertTo(d, CountFrom(column)), Constant(step),
                                Constant(static_cast<float>(box.x0_px)));
      const V3 ray = RayAt(s.rays, x_px, y_px);
      const auto at = static_cast<std::size_t>(row) * kSkyNodeStride + column;
      StoreView(ViewSky(s, ray), s.light.clouds.any, at, scratch.sky);
      const V3 direction = Scale(ray, InverseSqrt(Dot(ray, ray)));
      nearest = hn::Max(nearest, Dot(direction, Constant(s.light.sun_direction)));
    }
  }
  // No pixel is further from a node than a step's diagonal, no direction turns by more than
  // pixel_angle a pixel, and cos(a) is over 1 - a^2 / 2.
  const float reach = 1.02f * kDiscRadius + (1.5f * step + 1.0f) * s.rays.pixel_angle;
  const bool sees_disc =
      !hn::AllTrue(d, hn::Lt(nearest, Constant(1.0f - 0.5f * reach * reach - 1e-6f)));
  return {scratch.sky, sees_disc};
}

// The sky's light in the kLanes pixels from (x, y) of a tile on; x a multiple of kLanes.
HWY_INLINE V3 SkyOnLattice(const Shading& s, const raster::PixelBox& box, const SkyLattice& lattice,
                           int x, int y) {
  const D d;
  const DI di;
  const auto at = static_cast<std::size_t>(y / kSkyStep) * kSkyNodeStride + x / kSkyStep;
  constexpr float kPerStep = 1.0f / kSkyStep;
  const V below = Constant(static_cast<float>(y % kSkyStep) * kPerStep);
  const VI lane = hn::Iota(di, 0);
  const VI node = hn::ShiftRight<kSkyStepLog2>(lane);
  const auto left = hn::IndicesFromVec(d, node);
  const auto next = hn::IndicesFromVec(d, hn::Add(node, hn::Set(di, 1)));
  const V right =
      hn::Mul(hn::ConvertTo(d, hn::And(lane, hn::Set(di, kSkyStep - 1))), Constant(kPerStep));
  std::size_t channel = 0;
  const auto read = [&]() HWY_ATTR {
    const float* const upper = &lattice.nodes[channel++][at];
    const V nodes = Lerp(hn::LoadU(d, upper), hn::LoadU(d, upper + kSkyNodeStride), below);
    return Lerp(hn::TableLookupLanes(nodes, left), hn::TableLookupLanes(nodes, next), right);
  };
  SkyView view;
  view.clear.x = read(), view.clear.y = read(), view.clear.z = read();
  if (s.light.clouds.any) {
    CloudView& c = view.clouds;
    c.x = read(), c.y = read(), c.level = read();
    c.shown = read(), c.forward = read(), c.overcast = read();
  }
  V3 ray;
  if (lattice.sees_disc)
    ray = RayAt(s.rays, hn::ConvertTo(d, CountFrom(box.x0_px + x)),
                Constant(static_cast<float>(box.y0_px + y)));
  return SkyLight(s, view, ray, lattice.sees_disc);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
