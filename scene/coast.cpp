#include "scene/coast.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ocean/open_sea/sea_state.h"
#include "terrain/boundary.h"
#include "terrain/described_samples.h"
#include "terrain/terrain.h"

namespace swell::scene {
namespace {

constexpr int kDefaultCells = 256;
constexpr double kLeastSpacing_m = 0.5, kMostSpacing_m = 100.0;
constexpr double kSlowWork = 5e6;  // cells times trains in a second, less on a slow core

// Cells a side, as a double: there may be more than an integer holds.
double cells_a_side(const Coast& coast, double terrain_size_m) {
  if (coast.grid_spacing_m == 0.0) return kDefaultCells;
  return std::max(1.0, std::ceil(terrain_size_m / coast.grid_spacing_m));
}

double most_cells(int trains) {
  const double work = static_cast<double>(kMaxCoastWork) / std::max(trains, 1);
  return std::min<double>(kMaxCoastCells, std::floor(std::sqrt(work)));
}

// The least spacing of two decimals that the bounds allow; infinity if there is none.
double least_spacing_m(Coast coast, double terrain_size_m) {
  const double most = most_cells(coast.trains);
  const double least_cm = std::ceil(100.0 * terrain_size_m / most);
  if (!(least_cm < 1e12)) return HUGE_VAL;
  for (int n = 0;; ++n) {
    coast.grid_spacing_m = std::max(kLeastSpacing_m, (least_cm + n) / 100.0);
    if (cells_a_side(coast, terrain_size_m) <= most) return coast.grid_spacing_m;
  }
}

double variance_of(const ocean::WaveSystem& system) {
  return ocean::variance_below(system, HUGE_VAL);
}

terrain::HeightGrid sea_floor_of(const terrain::HeightGrid& terrain, int cells) {
  const terrain::Grid& land = terrain.grid;
  return resample(terrain, {land.min_world, land.size_m() / cells, cells + 1, cells + 1});
}

// By train, at the floor's samples; empty without a shore.
std::vector<std::vector<float>> shelter_trains(const terrain::ShoreMap* shore,
                                               std::span<const ocean::WaveTrain> trains,
                                               const terrain::HeightGrid& floor, Workers& workers) {
  if (!shore || !shore->has_line()) return {};
  const ocean::LandMask mask = ocean::make_land_mask(*shore);
  std::vector<std::vector<float>> kept(trains.size());
  workers.for_each(trains.size(), [&](std::size_t i, int) {
    kept[i] = ocean::shelter_train(mask, trains[i], floor.grid);
  });
  return kept;
}

}  // namespace

std::optional<SceneFault> fault_of_coast_grid(const Coast& coast, double terrain_size_m) {
  if (!has_trains(coast.model) || coast.grid_spacing_m == 0.0) return std::nullopt;
  // NaN fails.
  if (coast.grid_spacing_m > 0.0 && cells_a_side(coast, terrain_size_m) <= most_cells(coast.trains))
    return std::nullopt;
  const double least_m = least_spacing_m(coast, terrain_size_m);
  const std::string range =
      least_m <= kMostSpacing_m ? fmt::format("0 or {} to {} m", least_m, kMostSpacing_m) : "0";
  return SceneFault{"coast.grid_spacing_m", fmt::format("{}", coast.grid_spacing_m),
                    fmt::format("{} with trains = {} over {:.6g} m of terrain", range, coast.trains,
                                terrain_size_m)};
}

double coast_cells_at_most(const Scene& scene) {
  const terrain::TerrainDescription& terrain = *scene.terrain;
  const double size_m = described_size_m(terrain).value_or(terrain::samples_at_most(terrain) *
                                                           terrain.metres_per_pixel);
  return std::min(cells_a_side(scene.coast, size_m), most_cells(scene.coast.trains));
}

std::string slow_coast_text(const Scene& scene) {
  const Coast& coast = scene.coast;
  if (!has_trains(coast.model) || !scene.terrain || ocean::wave_systems(scene.sea).empty())
    return {};
  const std::optional<double> size_m = described_size_m(*scene.terrain);
  const double cells = coast_cells_at_most(scene);
  if (cells * cells * coast.trains < kSlowWork) return {};
  return size_m ? fmt::format("making {0} wave trains on {1} x {1} points", coast.trains, cells + 1)
                : fmt::format("making {} wave trains on points {} m apart", coast.trains,
                              coast.grid_spacing_m);
}

std::optional<ocean::CoastSea> build_coast(const Scene& scene, const terrain::HeightGrid* terrain,
                                           const terrain::ShoreMap* shore, Workers& workers) {
  const Coast& coast = scene.coast;
  const ocean::SeaDescription& sea = scene.sea;
  if (!has_trains(coast.model) || !terrain) return std::nullopt;
  if (const auto fault = fault_of_coast_grid(coast, terrain->grid.size_m())) refuse(scene, *fault);
  std::vector<ocean::WaveSystem> systems = ocean::wave_systems(sea);
  if (systems.empty()) return std::nullopt;
  std::ranges::stable_sort(systems, std::greater{}, variance_of);
  systems.resize(std::min(systems.size(), static_cast<std::size_t>(coast.trains)));
  std::vector<ocean::WaveTrain> trains = ocean::make_trains(systems, coast.trains, coast.seed);
  for (ocean::WaveTrain& train : trains) train.amplitude_m *= sea.amplitude_scale;
  const terrain::HeightGrid floor =
      sea_floor_of(*terrain, static_cast<int>(cells_a_side(coast, terrain->grid.size_m())));
  ocean::CoastSea made = ocean::make_coast_sea(
      floor, systems.front(), trains,
      coast.eikonal ? ocean::PhaseMethod::kEikonal : ocean::PhaseMethod::kStraight,
      coast.model == CoastModel::kBlend, workers, shelter_trains(shore, trains, floor, workers));
  made.surf_width = coast.surf_width;
  // In a sea that loops trains keep their form and change their speed, as all waves do.
  if (sea.loop_s != 0.0)
    for (double& period_s : made.trains.period_s)
      period_s = 1.0 / ocean::looping_frequency(1.0 / period_s, sea.loop_s);
  return made;
}

std::optional<terrain::ShoreMap> build_shore(const Scene& scene, const terrain::HeightGrid* terrain,
                                             int threads) {
  if (!terrain) return std::nullopt;
  if (const std::filesystem::path& file = scene.terrain->boundary; !file.empty()) try {
      return terrain::read_boundary(file, *terrain);
    } catch (const terrain::TerrainError& error) {
      refuse(scene, error);
    }
  Workers workers(threads);
  return terrain::ShoreMap(*terrain, workers);
}

std::optional<ocean::SurfFronts> build_surf_fronts(const Scene& scene, const ocean::Sea& sea,
                                                   const terrain::HeightGrid* terrain,
                                                   const terrain::ShoreMap* shore,
                                                   const ocean::Shelter* shelter,
                                                   Workers& workers) {
  if (scene.coast.model != CoastModel::kFronts || !terrain || !shore || !shelter)
    return std::nullopt;
  return ocean::make_surf_fronts(*shore, terrain->grid, sea, *shelter, scene.coast.surf_width,
                                 workers);
}

std::optional<ocean::Shelter> build_shelter(const Scene& scene, const terrain::ShoreMap* shore,
                                            Workers& workers) {
  if (!shore || !shore->has_line()) return std::nullopt;
  const std::vector<ocean::Beam> beams = ocean::make_beams(scene.sea);
  if (beams.empty()) return std::nullopt;
  return ocean::make_shelter(*shore, beams, workers);
}

}  // namespace swell::scene
