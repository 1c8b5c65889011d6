#include "scene/terrain.h"

#include "terrain/terrain.h"

namespace swell::scene {

std::optional<terrain::HeightGrid> build_terrain(const Scene& scene) {
  if (!scene.terrain) return std::nullopt;
  try {
    return terrain::build_terrain(*scene.terrain);
  } catch (const terrain::TerrainError& error) {
    throw SceneError(error.what());
  }
}

}  // namespace swell::scene
