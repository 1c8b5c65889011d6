// The land and sea floor of a scene.
#pragma once

#include <optional>

#include "scene/scene.h"
#include "terrain/height_grid.h"

namespace swell::scene {

// Builds the scene's terrain; nothing for scenes without one. What terrain::build_terrain() throws
// as TerrainError, it throws as SceneError with the same text.
std::optional<terrain::HeightGrid> build_terrain(const Scene& scene);

}  // namespace swell::scene
