// An object of a frame as its pixels read it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render/view/implicit_rays.h"
#include "shapes/object_mesh.h"

namespace swell::render {

struct SunDepth;

// A floating object in a frame. Its axes are divided by its sizes: a point p_rel has the mesh's
// coordinates (right, ahead, up) . (p_rel - bottom_rel), and a normal (x, y, z) of the mesh is
// x right + y ahead + z up in the world, but for its length.
struct ObjectInstance {
  glm::vec3 right{1, 0, 0}, ahead{0, 1, 0}, up{0, 0, 1};
  glm::vec3 bottom_rel{0.0f};
  float waterline_rel_m = 0.0f;  // height of its waterline above the eye
  glm::vec3 colour{0.0f};
  float roughness = 0.42f, metalness = 0.0f;  // of its paint
  float squares_per_m = 0.0f;                 // of its checkers; 0: it has none
  glm::vec3 squares_per_unit{0.0f};           // the same along the mesh's axes
  const shapes::ObjectMesh* mesh = nullptr;
  const SunDepth* self_shadow = nullptr;    // none: it does not shade itself
  float log2_units_per_m = 0.0f;            // of the mesh's lengths, in the mean over its axes
  std::uint32_t object = 0;                 // its index in the scene
  const PosedImplicit* implicit = nullptr;  // none: it is drawn as its triangles
  glm::vec3 implicit_size{1.0f},
      implicit_base{0.0f};  // an implicit surface's point is base + size (mesh coordinates)
};

// Which triangle of which object a primitive is.
struct ObjectPrimitive {
  const shapes::ObjectTriangle* triangle = nullptr;
  const ObjectInstance* object = nullptr;
};

}  // namespace swell::render
