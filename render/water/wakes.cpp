#include "render/water/wakes.h"

#include <cmath>

#include "render/sea/sea_maps.h"

namespace swell::render {
namespace {

// Returns the pattern with cells a third as large.
FoamLace finer(FoamLace lace) {
  constexpr float kTimes = 3.0f, kLog2Times = 1.5849625f;
  const float map_fx8 = 256.0f * static_cast<float>(lace.map->size);
  lace.x_fx8_per_m *= kTimes;
  lace.y_fx8_per_m *= kTimes;
  lace.x_eye_fx8 = std::fmod(kTimes * lace.x_eye_fx8, map_fx8);
  lace.y_eye_fx8 = std::fmod(kTimes * lace.y_eye_fx8, map_fx8);
  lace.log2_texels_per_m += kLog2Times;
  return lace;
}

}  // namespace

Wakes make_wakes(const MaterialInputs& in, const Whitecaps& whitecaps, glm::dvec2 eye) {
  Wakes wakes;
  wakes.foam = whitecaps;
  wakes.foam.tears = whitecaps.lace;
  wakes.foam.lace = finer(whitecaps.lace);
  wakes.foam.least = 0.01f;
  for (const ocean::WakeWindow& window : in.sea.frame.wakes.shown()) {
    const auto n = static_cast<std::size_t>(wakes.count++);
    WakeLayer& layer = wakes.layers[n];
    layer.slopes = make_square_layer(in.sea.wake_slopes[n], window.length_m, eye - window.corner_m);
    layer.foam.map = &in.sea.wake_foam[n];
    layer.foam.log2_texels_per_m = layer.slopes.log2_texels_per_m;
  }
  return wakes;
}

}  // namespace swell::render
