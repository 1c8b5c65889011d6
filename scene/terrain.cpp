#include "scene/terrain.h"

#include <utility>

#include "ocean/inland/river_bed.h"
#include "scene/check_scene.h"
#include "scene/obstacles.h"
#include "terrain/apron.h"
#include "terrain/terrain.h"

namespace swell::scene {
namespace {

bool has_inland_water(const Scene& scene) { return !scene.rivers.empty() || !scene.lakes.empty(); }

// What is wrong with terrain or rivers, as a SceneError.
template <class Build>
auto built(const Scene& scene, const Build& build) {
  try {
    return build();
  } catch (const terrain::TerrainError& error) {
    refuse(scene, error);
  } catch (const ocean::RiverError& error) {
    refuse(scene, SceneFault{error.key, error.got, error.allowed});
  }
}

void dig(const ocean::RiverNetwork& network, terrain::HeightGrid& land) {
  ocean::dig_beds(network, land);
  land.apron = terrain::make_apron(land);
}

}  // namespace

std::optional<terrain::HeightGrid> build_terrain(const Scene& scene) {
  if (!scene.terrain) return std::nullopt;
  return built(scene, [&] {
    terrain::HeightGrid land = terrain::build_terrain(*scene.terrain);
    if (has_inland_water(scene)) dig({scene.rivers, scene.lakes}, land);
    return std::optional(std::move(land));
  });
}

std::optional<Ground> build_ground(const Scene& scene, Workers& workers) {
  if (!scene.terrain) return std::nullopt;
  return built(scene, [&] {
    Ground ground{terrain::build_terrain(*scene.terrain, workers), {}};
    if (has_inland_water(scene)) {
      const ocean::RiverNetwork network(scene.rivers, scene.lakes);
      ground.lakes = ocean::fill_lakes(scene.lakes, ground.terrain);
      dig(network, ground.terrain);
    }
    return std::optional(std::move(ground));
  });
}

std::optional<ocean::InlandWater> build_inland_water(const Scene& scene,
                                                     const ocean::LakeFill& lakes,
                                                     const terrain::HeightGrid& terrain,
                                                     Workers& workers) {
  if (!has_inland_water(scene)) return std::nullopt;
  return built(scene, [&] {
    const ocean::RiverNetwork network(scene.rivers, scene.lakes);
    return std::optional<ocean::InlandWater>(std::in_place, network, lakes, terrain,
                                             river_obstacles(scene, network), workers);
  });
}

}  // namespace swell::scene
