#include "render/water/foam.h"

#include "math/elementary.h"
#include "render/sky/light.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr float kFoamAlbedo = 0.8f;
// Light that bubbles send back has come through so much water, and loses half besides.
constexpr float kBubblesDeep_m = 2.0f, kBubblesAlbedo = 0.5f;

}  // namespace

FoamLight make_foam_light(const MaterialInputs& in) {
  FoamLight light;
  light.sky = kFoamAlbedo * in.light.ambient;
  light.sun = (kFoamAlbedo / static_cast<float>(kPi)) * in.light.sun_irradiance;
  for (int c = 0; c < 3; ++c)
    light.bubbles[c] = kBubblesAlbedo * static_cast<float>(exp(static_cast<double>(
                                            -kBubblesDeep_m * in.media.absorption_per_m[c])));
  return light;
}

SlopeLayer make_foam_lace(const MaterialInputs& in, glm::dvec2 eye, double period_m) {
  return make_layer(*in.world.textures.foam, period_m, 1.0f, eye, {});
}

}  // namespace swell::render
