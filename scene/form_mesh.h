// Triangles that stand for a form where its exact shape does not show: in shadows, outlines before
// the sun, waterlines and picks.
#pragma once

#include "scene/form.h"
#include "scene/mesh_file.h"

namespace swell::scene {

// A form as a frame's tables of objects know it: eight corners of its box, and for each part a
// triangle without area, which holds its paint. Its pixels are found by rays.
struct DrawnForm {
  Form form;
  ObjectMesh mesh;
};

// The form, with a level of 192 triangles a part in its place; parts that turn have none.
MeshOfFile with_meshes(Form form);

}  // namespace swell::scene
