#include "render/measure/lidar_ground.h"

#include <algorithm>
#include <cmath>

#include "math/smoothstep.h"
#include "render/materials/checker.h"
#include "render/measure/lidar_echo.h"
#include "render/world/ground_cover.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/apron.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr float kStrawReflectance = 0.4f, kWetPart = 0.5f;

float red_of(Cover cover, const terrain::GroundMaterials& materials) {
  return kCoverTraits[cover].mean(materials).r;
}

float mapped_reflectance(Cover cover, const terrain::GroundMaterials& materials) {
  const float red = red_of(cover, materials);
  if (cover == Cover::kGrass) return std::max(static_cast<float>(kLeafReflectance), red);
  if (cover == Cover::kDry) return std::max(kStrawReflectance, red);
  return red;
}

// As bare_ground(), with the water's part of this light.
float bare_reflectance(float height_m, const terrain::GroundMaterials& materials) {
  const auto soil_m = static_cast<float>(materials.grass_from_m);
  const float dry = glm::mix(red_of(Cover::kSand, materials), red_of(Cover::kSoil, materials),
                             smoothstep(soil_m, soil_m + kSandToSoil_m, height_m));
  return dry * glm::mix(kWetPart, 1.0f, smoothstep(kWetSandEnd_m, kWetSandBegin_m, height_m));
}

GroundCover cover_over(const CoverMaps& maps, const terrain::Grid& square, glm::dvec2 p) {
  const glm::dvec2 place = (p - square.min_world) * (maps.front().size / square.size_m());
  GroundCover cover;
  glm::vec4 channels;
  for (std::size_t n = 0; n < kMappedCovers; ++n) {
    if (n % 4 == 0) channels = texture::cover_at(maps[n / 4], place);
    cover[static_cast<Cover>(n)] = channels[static_cast<glm::length_t>(n % 4)];
  }
  return cover;
}

float squares_reflectance(double side_m, glm::dvec2 p) {
  const glm::dvec2 square = glm::floor(p / side_m);
  return std::fmod(std::abs(square.x + square.y), 2.0) == 0.0 ? kLightSquare : kDarkSquare;
}

}  // namespace

double ground_reflectance(const WorldState& world, glm::dvec3 p_world) {
  const glm::dvec2 p(p_world);
  const terrain::TerrainDescription& land = *world.scene.terrain;
  if (land.checker_m > 0.0) return static_cast<double>(squares_reflectance(land.checker_m, p));
  const TerrainMaps& maps = *world.terrain_maps;
  const GroundCover cover =
      world.terrain->grid.holds(p)
          ? cover_over(maps.ground, world.terrain->grid, p)
          : cover_over(maps.ground_around, terrain::square_with_apron(*world.terrain), p);
  float bare = 1.0f, mapped = 0.0f;
  for (std::size_t n = 0; n < kMappedCovers; ++n) {
    const auto of = static_cast<Cover>(n);
    mapped += cover[of] * mapped_reflectance(of, land.ground);
    bare -= cover[of];
  }
  const float all =
      mapped + std::max(bare, 0.0f) * bare_reflectance(static_cast<float>(p_world.z), land.ground);
  return std::clamp(static_cast<double>(all), 0.0, 1.0);
}

}  // namespace swell::render
