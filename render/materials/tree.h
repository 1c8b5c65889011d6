// Trees: what their per-pixel code (tree-inl.h) reads.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "render/packets/slope_layer.h"
#include "render/tile/inputs.h"
#include "terrain/trees.h"

namespace swell::render {

struct DrawnTree;
struct TreePrimitive;

// A species, for all of its trees.
struct TreeSurface {
  glm::vec3 bark{0.08f};  // reflectance
  float translucency = 0.3f;
  glm::vec2 rise{0.0f};  // TreeLook
  float taper = 0.0f;
};

struct Tree {
  static constexpr SurfaceKind kSurface = SurfaceKind::kTrees;

  std::span<const TreePrimitive> primitives;  // of the surface's n-th triangle
  std::span<const DrawnTree> drawn;
  std::array<TreeSurface, terrain::kTreeSpecies> species;
  SlopeLayer foliage;  // laid on crowns, from each tree's foot on
};

void fill(const MaterialInputs& in, const RenderView& view, Tree& tree);

}  // namespace swell::render
