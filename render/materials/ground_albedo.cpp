#include "render/materials/ground_albedo.h"

#include "render/packets/slope_layer.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/apron.h"

namespace swell::render {
namespace {

AlbedoLayer make_albedo_layer(const texture::RgbaImage& albedo, const terrain::Grid& square,
                              glm::dvec2 eye) {
  const glm::dvec2 from_corner = eye - square.min_world;
  const double texels_per_m = albedo.width / square.size_m();
  // Texel centres lie at +0.5, the terrain's samples on the lattice.
  return {&albedo, static_cast<float>(texels_per_m),
          static_cast<float>(from_corner.x * texels_per_m + 0.5),
          static_cast<float>(from_corner.y * texels_per_m + 0.5)};
}

}  // namespace

GroundAlbedo make_ground_albedo(const WorldState& world, glm::dvec2 eye) {
  GroundAlbedo ground;
  if (!world.terrain) return ground;
  const terrain::HeightGrid& land = *world.terrain;
  const TerrainMaps& maps = *world.terrain_maps;
  ground.map = make_albedo_layer(maps.albedo, land.grid, eye);
  ground.around = make_albedo_layer(maps.albedo_around, terrain::square_with_apron(land), eye);
  const SlopeLayer square =
      make_square_layer(maps.slopes, land.grid.size_m(), eye - land.grid.min_world);
  ground.texels_fx8_per_m = square.texels_fx8_per_m;
  ground.x_eye_fx8 = square.x_eye_fx8;
  ground.y_eye_fx8 = square.y_eye_fx8;
  ground.side_fx8 = 256.0f * static_cast<float>(maps.slopes.size);
  return ground;
}

}  // namespace swell::render
