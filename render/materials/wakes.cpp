#include "render/materials/wakes.h"

namespace swell::render {

Wakes make_wakes(const MaterialInputs& in, const Whitecaps& whitecaps, glm::dvec2 eye) {
  Wakes wakes;
  wakes.foam = whitecaps;
  wakes.foam.tears = whitecaps.lace;
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
