// Boats as triangles, put together in metres at their common size (common_object).
#pragma once

#include "scene/mesh_builder.h"

namespace swell::scene {

void add_boat(MeshBuilder& to);
void add_sailboat(MeshBuilder& to);

}  // namespace swell::scene
