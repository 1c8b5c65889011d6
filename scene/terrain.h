// The land and sea floor of a scene, and the water that lies on it.
#pragma once

#include <optional>

#include "math/parallel.h"
#include "ocean/inland/inland_water.h"
#include "ocean/inland/lake_fill.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"

namespace swell::scene {

// Builds the scene's terrain with the beds of its rivers and lakes; nothing for scenes without one.
// What terrain::build_terrain() throws as TerrainError and ocean as RiverError, it throws as
// SceneError, with the place that the scene's file has for its key before the text.
std::optional<terrain::HeightGrid> build_terrain(const Scene& scene);

// The terrain likewise, and which cells of it lakes fill.
struct Ground {
  terrain::HeightGrid terrain;
  ocean::LakeFill lakes;
};
std::optional<Ground> build_ground(const Scene& scene, Workers& workers);

// The scene's rivers and lakes on its ground, which part before what stands in them
// (scene/obstacles.h): 0.1 to 1 s of one core. Nothing for scenes without any.
std::optional<ocean::InlandWater> build_inland_water(const Scene& scene,
                                                     const ocean::LakeFill& lakes,
                                                     const terrain::HeightGrid& terrain,
                                                     Workers& workers);

}  // namespace swell::scene
