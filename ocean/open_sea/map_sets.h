// Named sets of layers of one periodic map.
#pragma once

#include <vector>

#include "ocean/open_sea/map_layer.h"
#include "ocean/open_sea/periodic_map.h"

namespace swell::ocean {

inline constexpr std::size_t kMapSetLayers = 7;

// What a set is made of; any but MapSet::kNone. The longest layer has most of the variance, and is
// tiled (ocean/open_sea/patch_tiles.h): in 4 km there are so many periods of each map that some lie
// almost over each other whatever their ratios are, and seven maps of one variance would repeat
// themselves by a half.
MapRecipe recipe_of_set(MapSet set, double wind_from_rad, std::uint64_t seed);
std::vector<MapLayer> layers_of_set(MapSet set, std::uint64_t seed);

// A wind under which the open water looks so, m/s.
double wind_of_set_mps(MapSet set);

}  // namespace swell::ocean
