// A rectangle in equal cells, each cut into two triangles: what the other triangulations are
// measured against.
#pragma once

#include "lod/roam.h"

namespace swell::lod {

// Writes the grid of at most triangle_budget >= 2 triangles over the world's rectangle from `low`
// to `high`, which lies in the domain; cells are as square as whole numbers allow, vertices on the
// nearest lattice points.
void write_uniform_grid(const Domain& domain, glm::dvec2 low, glm::dvec2 high, int triangle_budget,
                        Mesh& mesh);

}  // namespace swell::lod
