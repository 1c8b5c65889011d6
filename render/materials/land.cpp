#include "render/materials/land.h"

#include <algorithm>

#include "render/frame/parts.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kNear_m = 8.3, kFine_m = 0.61, kStrata_m = 13.0;
// The wide pattern goes on where the cover map ends: its largest patches are five texels wide.
constexpr double kWideTexels = 40.0, kLeastWide_m = 29.0;
constexpr glm::dvec2 kStrataAlong{0.13, -0.09};

// turn: cosine and sine of the angle between the pattern's lattice and the world's axes.
PatternLayer make_pattern(const texture::PackedMap2& pattern, double length_m, glm::dvec2 eye,
                          glm::dvec2 turn = {1.0, 0.0}) {
  const glm::dvec2 turned(turn.x * eye.x - turn.y * eye.y, turn.y * eye.x + turn.x * eye.y);
  return {make_layer(pattern, length_m, 1.0f, turned, {}), 1.0f / pattern.lost_variance.back(),
          turn};
}

}  // namespace

void fill(const MaterialInputs& in, glm::dvec2 eye, double texel_m, Land& land) {
  land.on = !in.without.has(Part::kLandDetail);
  if (!land.on) return;
  const TerrainMaps& maps = *in.world.terrain_maps;
  land.ground = &maps.ground;
  land.ground_around = &maps.ground_around;
  const texture::PackedMap2& pattern = *in.world.textures.ground;
  const double wide_m = std::max(kWideTexels * texel_m, kLeastWide_m);
  land.wide = make_pattern(pattern, wide_m, eye, {0.96, 0.28});
  land.near = make_pattern(pattern, kNear_m, eye, {0.8, -0.6});
  land.fine = make_pattern(pattern, kFine_m, eye, {0.28, 0.96});
  land.strata = make_pattern(pattern, kStrata_m, {glm::dot(kStrataAlong, eye), 0.0});
  land.strata_along = kStrataAlong;
  const terrain::GroundMaterials& materials = in.world.scene.terrain->ground;
  for (const Cover cover : all_enumerators<Cover>()) {
    const CoverTraits& traits = kCoverTraits[cover];
    const glm::vec3 mean = traits.mean(materials);
    land.covers[cover] = {mean, mean * traits.variation, traits.relief};
  }
  land.soil_begin_m = static_cast<float>(materials.grass_from_m);
}

}  // namespace swell::render
