// The trees of a world: where they stand, what they look like, and what they do to the colour and
// the light of the land.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "ocean/inland/inland_water.h"
#include "scene/scene.h"
#include "shapes/tree_shape.h"
#include "terrain/trees.h"
#include "texture/packed_map.h"

namespace swell::render {

// What a species looks like besides its shape.
struct TreeLook {
  glm::vec3 albedo{0.05f};  // of leaves, linear RGB
  glm::vec3 bark{0.09f, 0.07f, 0.05f};
  float translucency = 0.3f;  // of the sun's light on leaves, what comes through them
  // Normals of the crown's hull at a place in its box: up is rise.x + rise.y z; and how much the
  // crown narrows to its top.
  glm::vec2 rise{0.3f, 0.0f};
  float taper = 0.0f;
};
TreeLook tree_look(terrain::TreeSpecies species);

// Trees of less height in the picture are thinned out [px]: those that stand alone, and those of a
// closed wood, of which nobody sees single ones.
inline constexpr float kThinnedTree_px = 5.0f, kThinnedWood_px = 18.0f;

// The columns hold what says of each tree whether it is drawn, one value a tree. They are
// kTreeLanes longer than the list of trees.
inline constexpr std::size_t kTreeLanes = 16;
struct TreeColumns {
  std::vector<float> x_m, y_m, z_m;  // of the foot, from Trees::origin
  std::vector<float> height_m, radius_m, rank;
  std::vector<std::uint32_t> looks;  // Tree::random, and its species << 24
  std::vector<float> thinned_px;     // between kThinnedTree_px and kThinnedWood_px

  auto fields() { return std::tie(x_m, y_m, z_m, height_m, radius_m, rank, looks, thinned_px); }
};

struct Forest {
  terrain::Trees trees;
  TreeColumns columns;
  std::vector<float> crowding;  // by tree: part of the ground around that crowns cover
  std::array<shapes::TreeShape, terrain::kTreeSpecies> shapes;
  // Over the terrain's square, as 2 x - 1: the part of the ground that crowns cover, and the part
  // of the sun's light that they leave to the ground and the water under it.
  texture::PackedMap1 cover, sun_left;
  // The box in the square that holds all their shade on the sea [m from the square's corner].
  glm::vec2 sea_shade_low{0.0f}, sea_shade_high{0.0f};
  glm::vec3 canopy_albedo{0.03f};  // of crowns from afar, with the shade between them
  float mean_height_m = 10.0f;

  auto fields() {
    return std::tie(trees, columns, crowding, shapes, cover, sun_left, sea_shade_low,
                    sea_shade_high, canopy_albedo, mean_height_m);
  }
};

// Texels a side.
inline constexpr int kCoverSize = 1024, kSunLeftSize = 2048;

// Trees and canopy over a terrain; inland: of the same scene, null without rivers and lakes;
// to_light: of length 1, with z <= 0 for a light that is down. Nothing if no tree stands. Throws
// SceneError as plant_trees() throws.
Forest grow_forest(const scene::Scene& scene, const terrain::HeightGrid& terrain,
                   const ocean::InlandWater* inland, glm::vec3 to_light, Workers& workers);

}  // namespace swell::render
