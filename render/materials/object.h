// Objects: what their per-pixel code (object-inl.h) reads.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/tile/inputs.h"

namespace swell::render {

struct ObjectPrimitive;

struct Object {
  static constexpr SurfaceKind kSurface = SurfaceKind::kObjects;

  std::span<const ObjectPrimitive> primitives;  // of the surface's n-th triangle
  bool has_textures = true;                     // false: their mean colours
  glm::vec3 sea_light{0.0f};                    // mean radiance of the sea, seen from above
};

void fill(const MaterialInputs& in, const RenderView& view, Object& object);

}  // namespace swell::render
