// The land of a world as maps.
#pragma once

#include <tuple>

#include "math/parallel.h"
#include "render/world/ground_cover.h"
#include "terrain/height_grid.h"
#include "texture/packed_map.h"

namespace swell::render {

// Over the terrain's square, and coarser over the square with its apron.
struct TerrainMaps {
  texture::PackedMap2 slopes, slopes_around;
  texture::RgbaImage albedo, albedo_around;  // sqrt-encoded reflectance
  CoverMaps ground, ground_around;

  auto fields() {
    return std::tie(slopes, slopes_around, albedo, albedo_around, ground, ground_around);
  }
};

// Cells a side of what is known of the terrain with its apron: relief and slopes.
inline constexpr int kAroundSize = 512;

// The terrain with its apron, kAroundSize + 1 points a side.
terrain::HeightGrid sample_around(const terrain::HeightGrid& terrain, Workers& workers);
// The same bits with any workers.
TerrainMaps build_terrain_maps(const terrain::HeightGrid& terrain,
                               const terrain::HeightGrid& around,
                               const terrain::TerrainDescription& description, Workers& workers);

}  // namespace swell::render
