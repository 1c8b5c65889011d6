// Boats as triangles, put together in metres at their common size (common_object).
#pragma once

#include "shapes/mesh_builder.h"

namespace swell::shapes {

void add_boat(MeshBuilder& to);
void add_sailboat(MeshBuilder& to);

}  // namespace swell::shapes
