#include "render/water/foam.h"

#include <algorithm>

#include "math/elementary.h"
#include "render/world/world_state.h"

namespace swell::render {

Foam make_foam(const MaterialInputs& in, glm::dvec2 eye, double period_m) {
  const float sun = std::max(in.light.sun_direction.z, 0.0f) / static_cast<float>(kPi);
  return {make_layer(*in.world.textures.foam, period_m, 1.0f, eye, {}),
          kFoamAlbedo * in.light.ambient, kFoamAlbedo * sun * in.light.sun_irradiance};
}

}  // namespace swell::render
