// Objects: what their per-pixel code (object-inl.h) reads.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "render/frame/parts.h"
#include "render/tile/inputs.h"

namespace swell::render {

struct Object {
  static constexpr SurfaceKind kSurface = SurfaceKind::kObjects;

  std::span<const ObjectPrimitive> primitives;  // of the surface's n-th triangle
  bool has_textures = true;                     // false: their mean colours
  glm::vec3 sea_light{0.0f};                    // mean radiance of the sea, seen from above
};

inline void fill(const MaterialInputs& in, const RenderView& view, Object& object) {
  object.primitives = in.objects.drawn_in(view.kind).primitives;
  object.has_textures = !in.without.has(Part::kTextures);
  // Besides its own light the sea mirrors some of the sky.
  object.sea_light = in.media.body + 0.15f * in.light.ambient;
}

}  // namespace swell::render
