// The land as rays find it (scene::TerrainMethod::kRays).
#pragma once

#include "math/parallel.h"
#include "terrain/height_pyramid.h"
#include "terrain/terrain.h"

namespace swell::render {

// The terrain's square with every sample that it has, and the square with its apron, coarser, with
// a hole where the terrain is.
struct LandRays {
  terrain::HeightPyramid map, around;
  std::optional<float> outline_m;  // land lower than this is not there

  const terrain::HeightPyramid& at(glm::dvec2 p_world) const {
    return map.grid.holds(p_world) ? map : around;
  }
};

// land: as it is drawn; around: sample_around(land).
LandRays build_land_rays(const terrain::HeightGrid& land, const terrain::HeightGrid& around,
                         const terrain::TerrainDescription& description, Workers& workers);

}  // namespace swell::render
