// Waves too short for the wave patches, as layers of slopes: two of a still map that drift across
// each other, or the frame of a sequence of bump images.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/packets/slope_layer.h"

namespace swell::scene {
struct Scene;
}

namespace swell::render {

struct MaterialInputs;

struct Ripples {
  std::array<SlopeLayer, 2> layers;
  int count = 0;
  TintLayer detail;  // of a sequence in the paper's lighting, or none
};

Ripples make_ripples(const MaterialInputs& in, glm::dvec2 eye);

// Slope variance, both axes together, of what is too fine for any map.
float base_variance(const scene::Scene& scene);

}  // namespace swell::render
