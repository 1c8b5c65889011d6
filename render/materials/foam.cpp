#include "render/materials/foam.h"

#include <algorithm>

#include "math/elementary.h"

namespace swell::render {
namespace {

constexpr double kPeriod_m = 9.0;
constexpr float kAlbedo = 0.8f;

}  // namespace

Foam make_foam(const MaterialInputs& in, glm::dvec2 eye) {
  const float sun = std::max(in.light.sun_direction.z, 0.0f) / static_cast<float>(kPi);
  return {make_layer(*in.world.foam_pattern, kPeriod_m, 1.0f, eye, {}),
          kAlbedo * (in.light.ambient + in.light.sun_irradiance * sun)};
}

}  // namespace swell::render
