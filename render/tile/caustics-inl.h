// The light that waves gather on what lies under water.
#if defined(SWELL_RENDER_TILE_CAUSTICS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_CAUSTICS_INL_H_
#undef SWELL_RENDER_TILE_CAUSTICS_INL_H_
#else
#define SWELL_RENDER_TILE_CAUSTICS_INL_H_
#endif

#include <algorithm>

#include "render/packets/packet-inl.h"
#include "render/tile/caustics.h"
#include "render/tile/shading.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Levels of the maps at which the pattern begins to fade to its mean, and is gone.
constexpr float kFirstCausticLost = 1.0f, kAllCausticLost = 3.0f;

// How much a depth has of the k-th map. Above the first depth the contrast rises as that of a weak
// lens does, below the last one it falls. From one depth to the next the weights go over to the
// next map, or where kNearest change at once.
template <bool kNearest>
HWY_INLINE V CausticWeight(const Caustics& caustics, std::size_t k, V depth) {
  const auto& at = caustics.depth_m;
  if constexpr (kNearest) {
    const V contrast = k == 0 ? depth * (1.0f / at[k]) : at.back() / Max(depth, at.back());
    const float first = k > 0 ? 0.5f * (at[k - 1] + at[k]) : 0.0f;
    const float end = k + 1 < at.size() ? 0.5f * (at[k] + at[k + 1]) : 1e30f;
    const auto here = (depth >= first) & (depth < end);
    return IfThenElseZero(here, Min(contrast, 1.0f));
  }
  const float before = k > 0 ? at[k - 1] : 0.0f;
  const V rising = (depth - before) * (1.0f / (at[k] - before));
  const V falling = k + 1 < at.size() ? (at[k + 1] - depth) * (1.0f / (at[k + 1] - at[k]))
                                      : at[k] / Max(depth, at[k]);
  return Clamp(Min(rising, falling), 0.0f, 1.0f);
}

// Where a packet lies in a patch's maps, on the nearest level.
struct CausticPlace {
  texture::HWY_NAMESPACE::WordPlace<VI> words;
  V shown;  // of the pattern, in [0, 1]
};

HWY_INLINE CausticPlace PlaceInCaustics(const CausticPatch& patch, V x, V y, V level_m) {
  const LayerPlace place = PlaceIn(patch, x, y);
  const V level = Clamp(level_m + patch.log2_texels_per_m, 0.0f, kAllCausticLost);
  const V shown = (kAllCausticLost - level) * (1.0f / (kAllCausticLost - kFirstCausticLost));
  return {
      texture::HWY_NAMESPACE::PlaceOnLevel(DI(), *patch.map[0], RoundToInt(place.x_fx8),
                                           RoundToInt(place.y_fx8), TruncateToInt(level + 0.5f)),
      Min(shown, 1.0f)};
}

// Intensity by one map.
HWY_INLINE V SampleCaustic(const texture::PackedMap1& map, const CausticPlace& at) {
  const V code = texture::HWY_NAMESPACE::SampleAt(D(), map, at.words);
  const V more = MulAdd(code, 0.5f * CausticMaps::kRange, 0.5f * CausticMaps::kRange - 1.0f);
  return MulAdd(more, at.shown, 1.0f);
}

// T' = T + Cc N, N of the ripples at T. Source: Ma, Zhu, Gong, 2006.
HWY_NOINLINE static void BendLookup(const Caustics& caustics, V level_m, V& x, V& y) {
  const V zero = hn::Zero(D());
  V slope_x = zero, slope_y = zero, unused = zero;
  for (int i = 0; i < caustics.ripples.count; ++i)
    AddSlopes(caustics.ripples.layers[static_cast<std::size_t>(i)], {x, y, zero}, level_m,
              {zero, zero}, slope_x, slope_y, unused);
  const V by = Constant(caustics.bend_m);
  x = NegMulAdd(slope_x, by, x);
  y = NegMulAdd(slope_y, by, y);
}

// The sun's light on points p, `depth` under the water (0 or more), relative to the eye, against
// what flat water would let through: 1 at no depth, and where it is too deep or too far away to see
// a pattern. patches: of the caustics', the shortest ones. By kNearest maps a lookup costs half as
// much: for means along ways.
template <bool kNearest = false>
HWY_NOINLINE static V GatheredSunAt(const Shading& s, std::size_t patches, const V3& p,
                                    const V& depth, V level_m) {
  const D d;
  const Caustics& caustics = s.caustics;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  if (patches == 0 || hn::AllFalse(d, depth > zero)) return one;
  V x = MulAdd(depth, s.sun_shadow.entry.x, p.x);
  V y = MulAdd(depth, s.sun_shadow.entry.y, p.y);
  if (!kNearest && caustics.bend_m > 0.0f) BendLookup(caustics, level_m, x, y);
  std::array<CausticPlace, CausticMaps::kMostPatches> places;
  for (std::size_t i = 0; i < patches; ++i)
    places[i] = PlaceInCaustics(caustics.patch[i], x, y, level_m);
  V more = zero;
  for (std::size_t k = 0; k < CausticMaps::kDepths; ++k) {
    const V weight = CausticWeight<kNearest>(caustics, k, depth);
    if (hn::AllFalse(d, weight > zero)) continue;
    V intensity = one;
    for (std::size_t i = 0; i < patches; ++i)
      if (!hn::AllFalse(d, places[i].shown > zero))
        intensity = intensity * SampleCaustic(*caustics.patch[i].map[k], places[i]);
    more = MulAdd(intensity - one, weight, more);
  }
  // Surf breaks the lenses: the pattern fades from its zone's rim to the shore.
  if (caustics.per_surf_depth > 0.0f) more = more * SmoothBlend(depth * caustics.per_surf_depth);
  return MulAdd(more, caustics.strength, one);
}

// The level [log2 m] of the patterns that a view shows at a packet whose pixels are of level_m.
template <ViewKind kView>
HWY_INLINE V PatternLevel(const RefractionBlur& blur, const Packet& packet, V level_m) {
  if constexpr (kView != ViewKind::kRefraction) return level_m;
  const D d;
  const V at = Clamp(level_m - RefractionBlur::kFirst_m, 0.0f, RefractionBlur::kEntries - 0.01f);
  const VI base = TruncateToInt(at);
  const V levels = MulAdd(EntriesOfEight(d, blur.levels_by_next.data(), base),
                          at - hn::ConvertTo(d, base), EntriesOfEight(d, blur.levels.data(), base));
  const V factor = Clamp(Abs(packet.to_eye.z) * blur.by_sine, blur.least, 1.0f);
  return level_m + Max(levels + Log2Coarse(d, factor), hn::Zero(d));
}

// Returns GatheredSunAt() by all patches, at the depth of p under the water's level.
template <bool kNearest = false>
HWY_INLINE V GatheredSun(const Shading& s, const V3& p, V level_m) {
  const V depth = Max(s.level_rel_m - p.z, 0.0f);
  return GatheredSunAt<kNearest>(s, s.caustics.patches, p, depth, level_m);
}

// Whether pixels of this footprint show any pattern of the shortest patch.
HWY_INLINE hn::Mask<D> ShowsShortCaustics(const Caustics& caustics, V level_m) {
  if (caustics.patches == 0) return hn::MaskFromVec(hn::Zero(D()));
  return level_m < kAllCausticLost - caustics.patch[0].log2_texels_per_m;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
