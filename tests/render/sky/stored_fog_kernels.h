// Stored fog at pixels (render/tile/stored_fog-inl.h) on arrays, on the SIMD target selected now.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/packets/view_rays.h"
#include "render/tile/stored_fog.h"

namespace swell::render {

struct FogSeen {
  glm::vec3 passes, added;
};

// Interpolated where rays from the eye meet primitives; `own` where there is no triangle.
std::vector<FogSeen> interpolate_fog(const StoredFog& stored, std::span<const glm::vec3> ray,
                                     std::span<const std::uint32_t> primitive, const FogSeen& own);

// By depth.
std::vector<FogSeen> look_up_fog(const StoredFog& stored, std::span<const float> z);

}  // namespace swell::render
