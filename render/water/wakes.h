// Waves and foam of what disturbs the water (ocean/wakes/wakes.h), as the water's shader reads
// them.
#pragma once

#include <array>

#include "ocean/spectrum/limits.h"
#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"
#include "render/water/whitecaps.h"

namespace swell::render {

// One window: a square of the sea.
struct WakeLayer {
  SlopeLayer slopes;
  FoamMap foam;  // over the same square, with as many samples
};

struct Wakes {
  int count = 0;
  Whitecaps foam;  // how foam is torn: more finely than the sea's
  std::array<WakeLayer, ocean::kMostWakeWindows> layers;
};

// whitecaps: the sea's, in the same view.
Wakes make_wakes(const MaterialInputs& in, const Whitecaps& whitecaps, glm::dvec2 eye);

}  // namespace swell::render
