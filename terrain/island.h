// An island from noise: hills, a gentle beach, a shallow lagoon, a reef, the deep floor.
#pragma once

#include "terrain/terrain.h"

namespace swell::terrain {

inline constexpr int kIslandSamples = 1025;

// The side of its square in metres.
double island_size_m(const TerrainDescription& description);

// The terrain's heights from island_radius_m, island_height_m, floor_depth_m and seed (the first
// and third over 0). The border is exactly -floor_depth_m. lowest_m and highest_m are not set.
HeightGrid build_island(const TerrainDescription& description);

}  // namespace swell::terrain
