// The ground above the sea: sand, soil, grass, dry growth and rock, with detail down to
// millimetres. Maps say what part of a place each of them covers; patterns of thresholds say where
// in it. Where a pixel shows too much of a pattern, the parts are left: the mean colour is the same
// from any distance.
#if defined(SWELL_RENDER_MATERIALS_LAND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_LAND_INL_H_
#undef SWELL_RENDER_MATERIALS_LAND_INL_H_
#else
#define SWELL_RENDER_MATERIALS_LAND_INL_H_
#endif

#include <array>
#include <tuple>
#include <utility>

#include "render/materials/ground-inl.h"
#include "render/materials/land.h"
#include "render/world/ground_cover.h"
#include "texture/cover_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a place of the cover maps holds: parts of covers, and of the sky that it sees.
struct LandCover {
  std::array<V, 4 * std::tuple_size_v<CoverMaps>> channels;
};

HWY_INLINE LandCover SampleCover(const CoverMaps& maps, const SlopeLayer& square, V3 p, V level_m) {
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  const V level = Clamp(level_m + (square.log2_texels_per_m + 0.5f), 0.0f, square.coarsest);
  LandCover cover;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const auto [r, g, b, a] = texture::HWY_NAMESPACE::SampleCover(
        D(), maps[n], RoundToInt(place.x_fx8), RoundToInt(place.y_fx8), TruncateToInt(level));
    cover.channels[4 * n] = r, cover.channels[4 * n + 1] = g;
    cover.channels[4 * n + 2] = b, cover.channels[4 * n + 3] = a;
  }
  return cover;
}

HWY_INLINE LandCover FindCover(const Terrain& terrain, V on_map, V3 p, V level_m) {
  const Land& land = terrain.land;
  return BlendOnMap(
      on_map, [&]() HWY_ATTR { return SampleCover(*land.ground, terrain.slopes, p, level_m); },
      [&]()
          HWY_ATTR { return SampleCover(*land.ground_around, terrain.slopes_around, p, level_m); },
      [&](const LandCover& map, const LandCover& around, auto blend) HWY_ATTR {
        LandCover cover;
        for (std::size_t n = 0; n <= kSkySeenChannel; ++n)
          cover.channels[n] = blend(map.channels[n], around.channels[n]);
        return cover;
      });
}

// The pattern at a place: a threshold in [0, 1], a shade in [-1, 1], and what part of both a pixel
// does not show.
struct Pattern {
  V threshold, shade, lost;
};

HWY_INLINE Pattern SamplePattern(const PatternLayer& pattern, V3 p, V level_m) {
  const V zero = hn::Zero(D());
  V code = zero, shade = zero, variance = zero;
  const V cosine = Constant(pattern.turn.x), sine = Constant(pattern.turn.y);
  const V3 turned = {MulSub(p.x, cosine, p.y * sine), MulAdd(p.x, sine, p.y * cosine), p.z};
  AddSlopes(pattern.layer, turned, level_m, {zero, zero}, code, shade, variance);
  // Beyond the coarsest level there is nothing, whatever the lanes beside show.
  const auto shown = level_m + pattern.layer.log2_texels_per_m < pattern.layer.coarsest;
  code = IfThenElseZero(shown, code);
  shade = IfThenElseZero(shown, shade);
  // Thresholds stay inside: what covers nothing, or all, does so everywhere.
  const V threshold = Clamp(MulAdd(code, 0.498f, 0.5f), 0.002f, 0.998f);
  return {threshold, shade, variance * pattern.lost_per_variance};
}

// Whether a part of a place is there, blended over `width` of thresholds. Its mean over thresholds
// is the part; it grows with it. What the pixel does not show of the pattern stays a part.
HWY_INLINE V Sharpen(V part, const Pattern& pattern, float width) {
  const V half = Constant(0.5f);
  const V room = Min(part, 1.0f - part) * 2.0f;
  const V ramp = Clamp(room, 1e-6f, width);
  const V there = Clamp((part - pattern.threshold) / ramp + half, 0.0f, 1.0f);
  return Lerp(there, part, Min(pattern.lost * 2.2f, 1.0f));
}

// Parts of a pixel that mapped covers have, and what they leave.
struct Parts {
  std::array<V, kMappedCovers> of;
  V bare;
};

HWY_INLINE Parts SharpenCover(const LandCover& cover, const Pattern& wide, const Pattern& near) {
  const V one = Constant(1.0f);
  // One threshold for all: the first cover up to its part, the second up to the sum of both.
  const auto sharpen = [&](V part) HWY_ATTR {
    return Sharpen(Sharpen(Min(part, one), wide, 0.8f), near, 0.45f);
  };
  Parts parts;
  V sum = cover.channels[0], below = sharpen(sum);
  parts.of[0] = below;
  for (std::size_t n = 1; n < kMappedCovers; ++n) {
    sum = sum + cover.channels[n];
    const V up_to = sharpen(sum);
    parts.of[n] = up_to - below;
    below = up_to;
  }
  parts.bare = one - below;
  return parts;
}

// Adds a material that covers `part` of a pixel whose pattern has a shade.
HWY_INLINE void AddMaterial(const MaterialColour& colour, V part, V shade, V3& albedo, V& relief) {
  albedo =
      MulAdd(Constant(colour.mean), part, MulAdd(Constant(colour.variation), part * shade, albedo));
  relief = MulAdd(part, colour.relief, relief);
}

// Layers of rock, as a shade.
HWY_INLINE V StrataShade(const Land& land, V3 p, V height_m, V level_m) {
  const V along = MulAdd(p.x, land.strata_along.x, p.y * land.strata_along.y);
  return SamplePattern(land.strata, {along, height_m, height_m}, level_m).shade;
}

// Ground above the sea. slope_x, slope_y: its own, to which those of its relief are added, and
// what they lose to `variance`.
struct LandLook {
  V slope_x, slope_y, variance, sky_seen;
  V3 albedo;
};

HWY_INLINE LandLook FindLand(const Terrain& terrain, const ViewRays& rays, const Packet& packet,
                             V on_map, V level_m, V slope_x, V slope_y) {
  const Land& land = terrain.land;
  const V zero = hn::Zero(D());
  const V3 p = packet.p;
  const V height_m = p.z + rays.eye_z;
  const LandCover cover = FindCover(terrain, on_map, p, level_m);

  const Pattern wide = SamplePattern(land.wide, p, level_m);
  Pattern near = SamplePattern(land.near, p, level_m);
  V shade = MulAdd(wide.shade, 0.5f, near.shade * 0.55f);
  if (ShowsDetail(land.fine.layer, level_m)) {
    const Pattern fine = SamplePattern(land.fine, p, level_m);
    shade = MulAdd(fine.shade, 0.8f, shade);
    // Edges are ragged from near by.
    const V ragged = MulAdd(fine.threshold, 0.3f, -0.15f);
    near.threshold = Clamp(near.threshold + ragged, 0.002f, 0.998f);
  }
  const Parts parts = SharpenCover(cover, wide, near);

  LandLook look = {slope_x, slope_y, zero, cover.channels[kSkySeenChannel], {zero, zero, zero}};
  V relief = zero;
  const auto add_mapped = [&]<std::size_t... n>(std::index_sequence<n...>) HWY_ATTR {
    const auto add = [&]<Cover kOf>(V part) HWY_ATTR {
      V part_shade = shade;
      if constexpr (kCoverTraits[kOf].has_strata) {
        if (!hn::AllFalse(D(), part > zero))
          part_shade = StrataShade(land, p, height_m, level_m) + shade * 0.7f;
        part = IfThenElseZero(part > zero, part);
      }
      AddMaterial(land.covers[kOf], part, part_shade, look.albedo, relief);
    };
    (add.template operator()<static_cast<Cover>(n)>(parts.of[n]), ...);
  };
  add_mapped(std::make_index_sequence<kMappedCovers>());
  const auto part_up = [&](float from_m, float to_m) HWY_ATTR {
    return SmoothBlend((height_m - from_m) * (1.0f / (to_m - from_m)));
  };
  const V soil = parts.bare * part_up(land.soil_begin_m, land.soil_begin_m + kSandToSoil_m);
  const V dry_sand =
      Lerp(Constant(kWetSand), Constant(1.0f), part_up(kWetSandEnd_m, kWetSandBegin_m));
  AddMaterial(land.covers[Cover::kSoil], soil, shade, look.albedo, relief);
  V3 sand = {zero, zero, zero};
  AddMaterial(land.covers[Cover::kSand], parts.bare - soil, shade, sand, relief);
  look.albedo = MulAdd(sand, dry_sand, look.albedo);

  V bump_x = zero, bump_y = zero, lost = zero;
  AddSlopes(terrain.detail, p, level_m, {zero, zero}, bump_x, bump_y, lost);
  look.slope_x = MulAdd(bump_x, relief, look.slope_x);
  look.slope_y = MulAdd(bump_y, relief, look.slope_y);
  look.variance = lost * (relief * relief);
  return look;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
