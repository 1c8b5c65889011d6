// The objects of a frame: where they are, and their triangles and shadows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/view/implicit_rays.h"
#include "render/view/object_instance.h"
#include "render/view/shadow_casters.h"
#include "render/view/surfaces.h"
#include "scene/objects.h"
#include "shapes/object_mesh.h"

namespace swell::render {

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
  std::vector<shapes::ObjectMesh> stand_ins;  // of those that have parts which move, at that time

  ObjectDraws& drawn_in(ViewKind kind) { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& drawn_in(ViewKind kind) const { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& in_window() const { return drawn_in(ViewKind::kWindow); }
};

}  // namespace swell::render
