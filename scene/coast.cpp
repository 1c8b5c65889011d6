#include "scene/coast.h"

#include <algorithm>
#include <cmath>

namespace swell::scene {
namespace {

constexpr int kDefaultCells = 256, kMaxCells = 2048;

ocean::SeaFloor sea_floor_of(const Terrain& terrain, double spacing_m) {
  const int cells =
      std::clamp(static_cast<int>(std::ceil(terrain.size_m() / spacing_m)), 1, kMaxCells);
  const ocean::FloorGrid grid{terrain.min_world, terrain.size_m() / cells, cells + 1, cells + 1};
  std::vector<glm::dvec2> p;
  p.reserve(grid.size());
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) p.push_back(grid.point(i, j));
  std::vector<float> height(grid.size());
  sample_heights(terrain, p, height);
  return ocean::make_sea_floor_from_heights(grid, height);
}

}  // namespace

std::optional<ocean::CoastSea> build_coast(const Scene& scene, const Terrain* terrain,
                                           int threads) {
  const Coast& coast = scene.coast;
  const ocean::SeaDescription& sea = scene.sea;
  if (coast.model == CoastModel::kNone || !terrain || sea.wind_speed_mps <= 0.0)
    return std::nullopt;
  const double spacing =
      coast.grid_spacing_m > 0.0 ? coast.grid_spacing_m : terrain->size_m() / kDefaultCells;
  Workers workers(threads);
  return ocean::make_coast_sea(
      sea_floor_of(*terrain, spacing),
      ocean::make_wind_sea(sea.wind_speed_mps, sea.wind_from_rad, sea.gravity_mps2), coast.trains,
      coast.seed, coast.eikonal ? ocean::PhaseMethod::kEikonal : ocean::PhaseMethod::kStraight,
      coast.model == CoastModel::kBlend, workers);
}

}  // namespace swell::scene
