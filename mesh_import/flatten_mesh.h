// From loose triangles to a mesh with common vertices and coarser levels.
#pragma once

#include "mesh_import/asset_file.h"

namespace swell::mesh_import {

// Adds normals where the file has none: those of the triangles, smooth between triangles that meet
// at less than 40 degrees.
void add_normals(LooseMesh& mesh);

// The vertices and the finest level, without triangles that have no area.
void join_vertices(const LooseMesh& mesh, shapes::FlatMesh& flat);

// Levels of a quarter of the triangles each of the one before, down to some hundred.
void add_levels(shapes::FlatMesh& flat);

}  // namespace swell::mesh_import
