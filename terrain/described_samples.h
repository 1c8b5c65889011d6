// How many heights a described terrain has, before it is built.
#pragma once

#include "terrain/terrain.h"

namespace swell::terrain {

// So many samples a side build_terrain() makes, or fewer, by the first bytes of an image.
int samples_at_most(const TerrainDescription& description);

}  // namespace swell::terrain
