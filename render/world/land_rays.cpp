#include "render/world/land_rays.h"

#include <cmath>

namespace swell::render {

LandRays build_land_rays(const terrain::HeightGrid& land, const terrain::HeightGrid& around,
                         const terrain::TerrainDescription& description, Workers& workers) {
  const double begin_m = land.grid.min_world.x - around.grid.min_world.x;
  const auto cells = [&](double m) { return m / around.grid.spacing_m; };
  const terrain::CellSquare hole{static_cast<int>(std::ceil(cells(begin_m) - 1e-6)),
                                 static_cast<int>(cells(begin_m + land.grid.size_m()) + 1e-6)};
  LandRays rays = {terrain::make_height_pyramid(land, {}, workers),
                   terrain::make_height_pyramid(around, hole, workers),
                   {}};
  if (description.outline_m) rays.outline_m = static_cast<float>(*description.outline_m);
  return rays;
}

}  // namespace swell::render
