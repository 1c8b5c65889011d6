#include "scene/terrain.h"

#include "ocean/inland/river_bed.h"
#include "scene/check_scene.h"
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

std::optional<Land> build_land(const Scene& scene, Workers& workers) {
  if (!scene.terrain) return std::nullopt;
  return built(scene, [&] {
    Land land{terrain::build_terrain(*scene.terrain), nullptr};
    if (has_inland_water(scene)) {
      const ocean::RiverNetwork network(scene.rivers, scene.lakes);
      const ocean::LakeFill lakes = ocean::fill_lakes(scene.lakes, land.terrain);
      dig(network, land.terrain);
      land.water =
          std::make_unique<const ocean::InlandWater>(network, lakes, land.terrain, workers);
    }
    return std::optional(std::move(land));
  });
}

}  // namespace swell::scene
