// Wakes at a packet of water.
#if defined(SWELL_RENDER_WATER_WAKES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_WAKES_INL_H_
#undef SWELL_RENDER_WATER_WAKES_INL_H_
#else
#define SWELL_RENDER_WATER_WAKES_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/water/foam_map-inl.h"
#include "render/water/wakes.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What all windows together add: slopes, the variance of those too fine for a pixel, and foam but
// for its lace.
struct WakesAt {
  V slope_x, slope_y, variance, foam;
  bool is_near;  // any lane in a window
};

inline HWY_NOINLINE WakesAt SampleWakes(const Wakes& wakes, const V3& p, const V& level_m) {
  const D d;
  const V zero = hn::Zero(d);
  WakesAt at = {zero, zero, zero, zero, false};
  for (int n = 0; n < wakes.count; ++n) {
    const WakeLayer& layer = wakes.layers[static_cast<std::size_t>(n)];
    const LayerPlace place = PlaceIn(layer.slopes, p.x, p.y);
    const V high = Constant((ocean::kWakeSamples - 1.0f) * 256.0f);
    const auto inside = ((place.x_fx8 > zero) & (place.y_fx8 > zero)) &
                        ((place.x_fx8 < high) & (place.y_fx8 < high));
    if (hn::AllFalse(d, inside)) continue;
    at.is_near = true;
    V x = zero, y = zero, lost = zero;
    AddSlopes(layer.slopes, p, level_m, {zero, zero}, x, y, lost);
    at.slope_x = at.slope_x + IfThenElseZero(inside, x);
    at.slope_y = at.slope_y + IfThenElseZero(inside, y);
    at.variance = at.variance + IfThenElseZero(inside, lost);
    const V found = FoamAt(layer.foam, RoundToInt(place.x_fx8), RoundToInt(place.y_fx8),
                           NearestFoamLevel(layer.foam, level_m));
    at.foam = Max(at.foam, IfThenElseZero(inside, found));
  }
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
