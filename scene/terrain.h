// The land and sea floor of a scene, and the water that lies on it.
#pragma once

#include <memory>
#include <optional>

#include "math/parallel.h"
#include "ocean/inland/inland_water.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"

namespace swell::scene {

// Builds the scene's terrain with the beds of its rivers and lakes; nothing for scenes without one.
// What terrain::build_terrain() throws as TerrainError and ocean as RiverError, it throws as
// SceneError, with the place that the scene's file has for its key before the text.
std::optional<terrain::HeightGrid> build_terrain(const Scene& scene);

struct Land {
  terrain::HeightGrid terrain;
  std::unique_ptr<const ocean::InlandWater> water;  // null: no rivers, no lakes
};

// Builds the terrain likewise, and the rivers and lakes: 0.1 to 1 s of one core.
std::optional<Land> build_land(const Scene& scene, Workers& workers);

}  // namespace swell::scene
