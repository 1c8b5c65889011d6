// What stands in the water and by it as triangles, put together in metres at its common size
// (common_object).
#pragma once

#include "shapes/mesh_builder.h"

namespace swell::shapes {

void add_pier(MeshBuilder& to);
void add_lighthouse(MeshBuilder& to);
void add_rock(MeshBuilder& to);

}  // namespace swell::shapes
