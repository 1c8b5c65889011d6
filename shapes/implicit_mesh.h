// Triangles that stand for an implicit surface where its exact shape does not show: in shadows,
// outlines before the sun, waterlines and picks.
#pragma once

#include "scene/implicit_surface.h"
#include "shapes/mesh_file.h"

namespace swell::shapes {

// An implicit surface as a frame's tables of objects know it: eight corners of its box, and for
// each part a triangle without area, which holds its paint. Its pixels are found by rays.
struct DrawnImplicit {
  scene::ImplicitSurface implicit;
  ObjectMesh mesh;
};

// The implicit surface, with a level of 192 triangles a part in its place; parts that turn have
// none.
MeshOfFile with_meshes(scene::ImplicitSurface implicit);

}  // namespace swell::shapes
