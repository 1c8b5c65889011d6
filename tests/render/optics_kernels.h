// The shaders' optics on arrays, on the SIMD target selected now.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/tile/shade_tile.h"

namespace swell::render {

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance);

// The water's slopes at p_rel (relative to the eye, seen from straight above) and the variance of
// those too fine to see, as the shader finds them. water.has_coast chooses its form.
struct SeenSlopes {
  glm::vec2 slope{0.0f};
  float variance = 0.0f;
};
SeenSlopes sample_water(const Water& water, glm::vec3 p_rel);

}  // namespace swell::render
