// Digging the beds of rivers and lakes into the ground.
#pragma once

#include "ocean/inland/river_network.h"
#include "terrain/height_grid.h"

namespace swell::ocean {

// Lowers the ground under rivers and dug lakes to their beds, by half a cell more on each side than
// they are wide, so that the bed lies below the surface between samples, too; beside them it lies
// above the surface, and passes into the land as it is. The sea's floor and what is lower than it
// needs to be stay. lowest_m and highest_m are set. Throws RiverError for a river that ends on dry
// land, or lies beyond the map.
void dig_beds(const RiverNetwork& network, terrain::HeightGrid& land);

}  // namespace swell::ocean
