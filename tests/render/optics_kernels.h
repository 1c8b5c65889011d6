// The shaders' optics on arrays, on the SIMD target selected now.
#pragma once

#include <span>

namespace swell::render {

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance);

}  // namespace swell::render
