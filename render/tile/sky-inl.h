// The sky as the eye sees it.
#if defined(SWELL_RENDER_TILE_SKY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SKY_INL_H_
#undef SWELL_RENDER_TILE_SKY_INL_H_
#else
#define SWELL_RENDER_TILE_SKY_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/clouds-inl.h"
#include "render/sky/sky_map-inl.h"
#include "render/sky/stars-inl.h"
#include "render/tile/air-inl.h"
#include "render/tile/cloud_deck-inl.h"
#include "render/tile/lattice-inl.h"
#include "render/tile/resolve-inl.h"
#include "render/tile/shafts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr float kDiscRadius = 0.004654f;  // of the sun and the moon

// The part of a pixel that the disc of the sun or the moon fills, by the direction's distance from
// its middle; half a degree across.
HWY_INLINE V DiscPart(const Light& light, V3 direction, float pixel_angle) {
  const V3 apart = direction - Constant(light.to_disc);
  const float rim = std::max(pixel_angle, 0.02f * kDiscRadius);
  const V away2 = Dot(apart, apart);
  const V inside = kDiscRadius - Sqrt(away2);
  const V disc = Clamp(MulAdd(inside, 1.0f / rim, 0.5f), 0.0f, 1.0f);
  if (!light.moon_has_phase) return disc;
  // The side of a sphere that the sun shines on.
  const V depth = Sqrt(Max(kDiscRadius * kDiscRadius - away2, 0.0f));
  const V lit = NegMulAdd(depth, glm::dot(light.disc_lit_from, light.to_disc),
                          Dot(apart, Constant(light.disc_lit_from)));
  return disc * Clamp(MulAdd(lit, 1.0f / rim, 0.5f), 0.0f, 1.0f);
}

// What of the sky changes slowly from pixel to pixel.
struct SkyView {
  V3 clear;
  CloudView clouds;  // if there are any
};

HWY_INLINE SkyView ViewSky(const Shading& s, V3 ray) {
  V3 direction = ray * InverseSqrt(Dot(ray, ray));
  // Below the horizon (beyond the sea's last triangle) the horizon's colour goes on.
  direction.z = Max(direction.z, s.light.horizon_sine);
  SkyView view = {ClearSky(SkyOfEye(s.light), direction), {}};
  if (s.light.clouds.any)
    view.clouds =
        ViewClouds(s.light.clouds, direction, Log2Coarse(D(), Constant(s.rays.pixel_angle)));
  return view;
}

HWY_INLINE V3 AddStars(const Shading& s, V3 ray, V3 light) {
  const V3 direction = ray * InverseSqrt(Dot(ray, ray));
  const V spot = Constant(std::clamp(1.5f * s.rays.pixel_angle, 1e-6f, 0.99f * kWidestStar));
  return light + StarLight(s.light.stars, direction, spot);
}

// The sky's light in a ray's direction before fog; the disc is looked for where `sees_disc`.
HWY_INLINE V3 SkyLight(const Shading& s, const SkyView& view, const CloudNoise& noise, V3 ray,
                       bool sees_disc) {
  V3 light = view.clear;
  V passes = Constant(1.0f);
  if (s.light.stars.on) light = AddStars(s, ray, light);
  if (s.light.clouds.any) light = AddClouds(s.light.clouds, view.clouds, noise, light, passes);
  if (!sees_disc && !s.light.clouds.is_below) return light;
  const V3 direction = ray * InverseSqrt(Dot(ray, ray));
  if (sees_disc) {
    const V disc = DiscPart(s.light, direction, s.rays.pixel_angle);
    const auto is_sky = direction.z > s.light.horizon_sine;
    const V shown = IfThenElseZero(is_sky, disc * passes);
    light = MulAdd(Constant(s.light.disc_radiance), shown, light);
  }
  if (!s.light.clouds.is_below) return light;
  return AddCloudDeck(s, direction, Constant(kNothingNear_m), light);
}

HWY_INLINE V3 BehindFog(const Shading& s, V3 ray, V3 light) {
  if (!s.media.fog.on) return light;
  const V3 direction = ray * InverseSqrt(Dot(ray, ray));
  return SkyThroughAir(s, direction, light);
}

// The sky's light at places of the window, found for each alone.
static HWY_NOINLINE V3 ShadeSky(const Shading& s, const raster::PixelBox& box,
                                const std::int32_t* shafts, V x_px, V y_px) {
  if (s.media.submerged) return OpenWater(s, box, shafts, x_px, y_px);
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const SkyView view = ViewSky(s, ray);
  CloudNoise noise;
  if (s.light.clouds.any)
    noise = SampleClouds(s.light.clouds, view.clouds.x, view.clouds.y, view.clouds.level);
  return BehindFog(s, ray, SkyLight(s, view, noise, ray, true));
}

template <class StoreNodes>
HWY_INLINE void StoreView(const SkyView& view, bool clouds, const StoreNodes& store_nodes,
                          SkyNodes& nodes) {
  std::size_t channel = 0;
  const auto store = [&](V value) HWY_ATTR { store_nodes(value, nodes.view[channel++].data()); };
  store(view.clear.x), store(view.clear.y), store(view.clear.z);
  if (!clouds) return;
  const CloudView& c = view.clouds;
  store(c.shown), store(c.forward), store(c.overcast), store(c.x), store(c.y), store(c.level);
}

template <class Read>
HWY_INLINE SkyView ReadView(const SkyNodes& nodes, bool clouds, const Read& read_channel) {
  SkyView view;
  std::size_t channel = 0;
  const auto read = [&]() HWY_ATTR { return read_channel(nodes.view[channel++].data()); };
  view.clear.x = read(), view.clear.y = read(), view.clear.z = read();
  if (!clouds) return view;
  view.clouds.shown = read(), view.clouds.forward = read(), view.clouds.overcast = read();
  return view;
}

// Whether fog before the sky does. exp(-t / sin) bends most where it is between 0 and 1, which for
// a layer of depth t is over an angle of about t.
inline bool IsFogOnLattice(const Shading& s) {
  const Fog& fog = s.media.fog;
  const float thinnest = std::min({fog.per_m.x, fog.per_m.y, fog.per_m.z});
  return fog.on && IsAirOnLattice(s) &&
         fog.at_eye.above_m * thinnest > 10.0f * kStep * s.rays.pixel_angle;
}

template <class StoreNodes>
HWY_INLINE void StoreFog(const FogView& view, const StoreNodes& store, SkyNodes& nodes) {
  store(view.added.x, nodes.air[0].data());
  store(view.added.y, nodes.air[1].data());
  store(view.added.z, nodes.air[2].data());
  store(view.passes.x, nodes.air[3].data());
  store(view.passes.y, nodes.air[4].data());
  store(view.passes.z, nodes.air[5].data());
}

template <class Read>
HWY_INLINE FogView ReadFog(const SkyNodes& nodes, bool is_grey, const Read& read) {
  FogView view;
  view.added = {read(nodes.air[0].data()), read(nodes.air[1].data()), read(nodes.air[2].data())};
  view.passes.x = view.passes.y = view.passes.z = read(nodes.air[3].data());
  if (is_grey) return view;
  view.passes.y = read(nodes.air[4].data()), view.passes.z = read(nodes.air[5].data());
  return view;
}

// Fills the first `rows` rows of the lattice of what changes slowly, and says whether any pixel
// there may see the disc.
inline bool FindView(const Shading& s, const raster::PixelBox& box, int rows, SkyNodes& nodes) {
  const D d;
  V nearest = Constant(-4.0f);
  const bool has_fog = IsFogOnLattice(s);
  ForEachNodes(box, rows, [&](V x_px, V y_px, const auto& store) HWY_ATTR {
    const V3 ray = RayAt(s.rays, x_px, y_px);
    StoreView(ViewSky(s, ray), s.light.clouds.any, store, nodes);
    const V3 direction = ray * InverseSqrt(Dot(ray, ray));
    nearest = Max(nearest, Dot(direction, Constant(s.light.to_disc)));
    if (has_fog)
      StoreFog(SkyFog(s.media.fog, s.media.fog.at_eye, direction, kPlacesBeforeSky), store, nodes);
  });
  // No pixel is further from a node than a step's diagonal, no direction turns by more than
  // pixel_angle a pixel, and cos(a) is over 1 - a^2 / 2.
  const float reach = 1.02f * kDiscRadius + (1.5f * kStep + 1.0f) * s.rays.pixel_angle;
  return !hn::AllTrue(d, nearest < 1.0f - 0.5f * reach * reach - 1e-6f);
}

// The clouds' noise at places that `read` finds in the view's channels.
template <class Read>
HWY_INLINE CloudNoise NoiseAt(const Clouds& clouds, const SkyNodes& nodes, const Read& read) {
  constexpr std::size_t kPlace = SkyNodes::kViewChannels - 3;
  return SampleClouds(clouds, read(nodes.view[kPlace].data()), read(nodes.view[kPlace + 1].data()),
                      read(nodes.view[kPlace + 2].data()));
}

// The noise at one column of nodes: as in rows, to the bit.
inline void FindNoiseDown(const Clouds& clouds, int column, int rows, SkyNodes& nodes) {
  const D d;
  const DI di;
  constexpr int kStride = static_cast<int>(SkyNodes::kStride);
  for (int first = 0; first < rows; first += static_cast<int>(kLanes)) {
    const VI row = Min(CountFrom(first), hn::Set(di, rows - 1));
    const VI at = hn::ShiftRight<kStepLog2>(row) * kStride + column;
    const V below = hn::ConvertTo(d, row & (kStep - 1)) * (1.0f / static_cast<float>(kStep));
    const CloudNoise found = NoiseAt(clouds, nodes, [&](const float* upper) HWY_ATTR {
      return Lerp(hn::GatherIndex(d, upper, at), hn::GatherIndex(d, upper + kStride, at), below);
    });
    HWY_ALIGN std::array<std::array<float, kLanes>, SkyNodes::kNoiseChannels> values;
    hn::Store(found.noise, d, values[0].data());
    hn::Store(found.side, d, values[1].data());
    hn::Store(found.lost, d, values[2].data());
    const int count = std::min(rows - first, static_cast<int>(kLanes));
    for (std::size_t channel = 0; channel < values.size(); ++channel)
      for (int i = 0; i < count; ++i)
        nodes.noise[channel][static_cast<std::size_t>(first + i) * SkyNodes::kStride +
                             static_cast<std::size_t>(column)] = values[channel][i];
  }
}

// Fills so many rows of the clouds' noise from the view.
inline void FindNoise(const Clouds& clouds, int columns, int rows, SkyNodes& nodes) {
  const D d;
  // A tile has a column more than fills whole packets: that one goes down.
  const bool one_more = columns % static_cast<int>(kLanes) == 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns - (one_more ? 1 : 0);
         column += static_cast<int>(kLanes)) {
      const BetweenRows between(row);
      const auto first = static_cast<std::size_t>(column);
      const CloudNoise found = NoiseAt(
          clouds, nodes, [&](const float* channel) HWY_ATTR { return between(channel, first); });
      const auto at = static_cast<std::size_t>(row) * SkyNodes::kStride + first;
      hn::StoreU(found.noise, d, &nodes.noise[0][at]);
      hn::StoreU(found.side, d, &nodes.noise[1][at]);
      hn::StoreU(found.lost, d, &nodes.noise[2][at]);
    }
  if (one_more) FindNoiseDown(clouds, columns - 1, rows, nodes);
}

// The sky in the first rows of a tile; not `on` in windows of large pixels and under water.
struct SkyLattice {
  const SkyNodes& nodes;
  bool on, sees_disc;
  const std::int32_t* shafts;  // of nodes under water
};

inline SkyLattice MakeSkyLattice(const Shading& s, const raster::PixelBox& box, int rows_px,
                                 const std::int32_t* shafts, SkyNodes& nodes) {
  if (s.media.submerged || s.rays.pixel_angle > kMostStepAngle / kStep)
    return {nodes, false, true, shafts};
  const bool sees_disc = FindView(s, box, nodes_along(rows_px), nodes);
  if (s.light.clouds.any) FindNoise(s.light.clouds, nodes_along(box.width_px), rows_px, nodes);
  return {nodes, true, sees_disc, shafts};
}

// The sky's light in the kLanes pixels from (x, y) of a tile on; x a multiple of kLanes.
HWY_INLINE V3 SkyOfPacket(const Shading& s, const raster::PixelBox& box, const SkyLattice& lattice,
                          int x, int y) {
  const D d;
  const SkyNodes& nodes = lattice.nodes;
  const V x_px = hn::ConvertTo(d, CountFrom(box.x0_px + x));
  const V y_px = Constant(static_cast<float>(box.y0_px + y));
  if (!lattice.on) return ShadeSky(s, box, lattice.shafts, x_px, y_px);
  const auto column = static_cast<std::size_t>(x / kStep);
  const BetweenRows between(y);
  const SkyView view = ReadView(nodes, s.light.clouds.any, [&](const float* channel) HWY_ATTR {
    return ToPixels(between(channel, column));
  });
  CloudNoise noise;
  if (s.light.clouds.any) {
    const std::size_t at = static_cast<std::size_t>(y) * SkyNodes::kStride + column;
    const auto read = [&](std::size_t channel)
                          HWY_ATTR { return ToPixels(hn::LoadU(d, &nodes.noise[channel][at])); };
    noise = {read(0), read(1), read(2)};
  }
  const V3 ray = RayAt(s.rays, x_px, y_px);
  const V3 light = SkyLight(s, view, noise, ray, lattice.sees_disc);
  if (!IsFogOnLattice(s)) return BehindFog(s, ray, light);
  const auto read = [&](const float* channel)
                        HWY_ATTR { return ToPixels(between(channel, column)); };
  return ThroughFog(ReadFog(nodes, s.media.fog.is_grey, read), light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
