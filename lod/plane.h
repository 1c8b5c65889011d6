// The water of two triangles, flat: all waves are in the shading.
// Source: Ma, Zhu, Gong, 2006.
#pragma once

#include "lod/roam.h"

namespace swell::lod {

// Writes the domain's square as four vertices at its corners and two triangles of level 0.
void write_plane(const Domain& domain, Mesh& mesh);

}  // namespace swell::lod
