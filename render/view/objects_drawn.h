// The objects of a frame: where they are, and their triangles and shadows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/view/implicit_rays.h"
#include "render/view/shadow_casters.h"
#include "render/view/surfaces.h"
#include "scene/objects.h"
#include "shapes/object_mesh.h"

namespace swell::render {

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

// The objects that views of one kind may show, each of as many triangles as the view needs.
struct ObjectDraws {
  std::vector<ObjectInstance> instances;
  std::vector<DrawPart> parts;              // of the same
  std::vector<ObjectPrimitive> primitives;  // per triangle
  std::vector<std::uint32_t> indices;       // 3 per triangle
  std::vector<glm::vec3> p_rel;             // per vertex, relative to the eye
  std::vector<float> waterline_rel_m;       // per vertex: its object's
};

// The objects of a frame.
struct ObjectGeometry {
  std::vector<scene::ObjectPose> poses;           // of all objects of the scene
  std::vector<const shapes::ObjectMesh*> meshes;  // of the same, in the window; null: not in view
  std::array<ObjectDraws, kViewKinds> draws;
  ObjectShadows shadows;                                   // of those that the view may show
  bool draws_implicits = true;                             // Part::kImplicits
  std::vector<PosedImplicit> implicits;                    // at the frame's time
  std::vector<const scene::ImplicitSurface*> implicit_of;  // what they are of; of each shape one

  ObjectDraws& drawn_in(ViewKind kind) { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& drawn_in(ViewKind kind) const { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& in_window() const { return drawn_in(ViewKind::kWindow); }
};

}  // namespace swell::render
