// Foam of one patch's waves.
#if defined(SWELL_RENDER_MATERIALS_FOAM_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_FOAM_MAP_INL_H_
#undef SWELL_RENDER_MATERIALS_FOAM_MAP_INL_H_
#else
#define SWELL_RENDER_MATERIALS_FOAM_MAP_INL_H_
#endif

#include "render/materials/whitecaps.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Levels of the map at which foam begins to be its mean, and is.
constexpr float kFirstFoamLost = 3.0f, kAllFoamLost = 5.0f;

// How much of the foam's place in the map is lost in pixels of that size, in [0, 1].
HWY_INLINE V FoamLost(const FoamMap& foam, V level_m) {
  const V past_first = hn::Add(level_m, Constant(foam.log2_texels_per_m - kFirstFoamLost));
  return Clamp(hn::Mul(past_first, Constant(1.0f / (kAllFoamLost - kFirstFoamLost))), 0.0f, 1.0f);
}

HWY_INLINE VI NearestFoamLevel(const FoamMap& foam, V level_m) {
  return TruncateToInt(
      Clamp(hn::Add(level_m, Constant(foam.log2_texels_per_m + 0.5f)), 0.0f, kAllFoamLost));
}

HWY_INLINE V FoamAt(const FoamMap& foam, VI x_fx8, VI y_fx8, VI level) {
  const V code = texture::HWY_NAMESPACE::SampleLevel(D(), *foam.map, x_fx8, y_fx8, level);
  return hn::MulAdd(code, Constant(0.5f), Constant(0.5f));
}

// The mean to the bit where all is lost, whatever the lanes beside show.
HWY_INLINE V BlendFoam(const FoamMap& foam, V found, V lost) {
  const V mean = Constant(foam.mean);
  return hn::IfThenElse(hn::Ge(lost, Constant(1.0f)), mean, Lerp(found, mean, lost));
}

// The foam of a map that repeats.
HWY_INLINE V FoamOfMap(const FoamMap& foam, V3 p, V level_m) {
  const V lost = FoamLost(foam, level_m);
  if (hn::AllTrue(D(), hn::Ge(lost, Constant(1.0f)))) return Constant(foam.mean);
  const LayerPlace place = PlaceIn(foam, p.x, p.y);
  const V found = FoamAt(foam, RoundToInt(place.x_fx8), RoundToInt(place.y_fx8),
                         NearestFoamLevel(foam, level_m));
  return BlendFoam(foam, found, lost);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
