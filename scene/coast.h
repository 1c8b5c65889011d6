// The coast waves of a scene: trains over its terrain.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "math/parallel.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "scene/check_scene.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"
#include "terrain/shore_map.h"

namespace swell::scene {

// Bounds of the grid that the trains are worked out on: cells a side, and all cells times trains.
// At the second one, a coast takes 0.9 GB to make (0.6 GB to keep) and 3 seconds of one core.
inline constexpr int kMaxCoastCells = 2048;
inline constexpr std::int64_t kMaxCoastWork = std::int64_t{1} << 24;

// What is wrong with coast.grid_spacing_m over a terrain of this size, if anything.
std::optional<SceneFault> fault_of_coast_grid(const Coast& coast, double terrain_size_m);

// So many cells a side, or fewer, the trains of a scene with terrain are worked out on: by the
// first bytes of its image.
double coast_cells_at_most(const Scene& scene);

// For those who wait: 'making 16 wave trains on 1001 x 1001 points' if that takes one core about a
// second or more, else empty. Cheap, as coast_cells_at_most() is.
std::string slow_coast_text(const Scene& scene);

// Works out the phases of the scene's wave trains over its terrain, the same bits with any workers:
// 0.2 microseconds of one core a train and cell, 50 ms to 3 s in all. Nothing for
// scenes without terrain, without wind or with a coast.model without trains. Throws SceneError for
// a grid beyond the bounds. shore: of the terrain; null: land does not shelter the trains.
std::optional<ocean::CoastSea> build_coast(const Scene& scene, const terrain::HeightGrid* terrain,
                                           const terrain::ShoreMap* shore, Workers& workers);

// Where a scene's terrain meets the sea, by its heights or by the file that it names; nothing
// without terrain. Throws SceneError or texture::FileError for such a file.
std::optional<terrain::ShoreMap> build_shore(const Scene& scene, const terrain::HeightGrid* terrain,
                                             int threads = available_cpus());

// The fronts of surf of a scene that lift its water. Nothing but with coast.model = "fronts", a
// shore and its shelter (build_shelter()).
std::optional<ocean::SurfFronts> build_surf_fronts(const Scene& scene, const ocean::Sea& sea,
                                                   const terrain::HeightGrid* terrain,
                                                   const terrain::ShoreMap* shore,
                                                   const ocean::Shelter* shelter, Workers& workers);

// What land leaves of the waves of the scene's open sea, the same bits with any workers. Nothing
// without a shore line or without waves. 0.1 s of one core.
std::optional<ocean::Shelter> build_shelter(const Scene& scene, const terrain::ShoreMap* shore,
                                            Workers& workers);

}  // namespace swell::scene
