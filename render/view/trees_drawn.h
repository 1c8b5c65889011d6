// The trees of a frame: those that views of a kind may show, each of as many triangles as it takes
// there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lod/envelope.h"
#include "render/view/surfaces.h"

namespace swell::render {

// A tree as views of a kind show it.
struct DrawnTree {
  glm::vec3 foot_rel{0.0f};  // relative to the eye
  float height_m = 0.0f, radius_m = 0.0f;
  float leaves = 0.0f;     // triangles of its crown, the last one in part
  float leaf_size = 1.0f;  // of the crown
  float trunk_m = 0.0f;    // half its width; 0: none
  float sways = 0.0f;      // how far, from 0 to 1
  std::uint32_t tree = 0;  // its number in the world
  std::uint32_t triangles = 0;
  std::uint32_t looks = 0;  // TreeColumns::looks
  std::uint32_t species = 0;
  // For its pixels.
  float crown_begin_m = 0.0f, inverse_crown_m = 1.0f, inverse_radius_m = 1.0f;
  float crowding = 0.0f;   // Forest::crowding
  bool like_land = false;  // small in the picture, and in a wood
  glm::vec2 aside{1, 0};   // across the view of it, of length 1
  glm::vec3 leaves_albedo{0.0f};
};

// What a triangle is of.
struct TreePrimitive {
  std::uint32_t tree = 0;  // its place in TreeDraws::trees
  std::uint32_t leaf = 0;  // of its shape, or kTrunkLeaf
};
inline constexpr std::uint32_t kTrunkLeaf = ~std::uint32_t{0};

// A cell of the forest that a view may show.
struct DrawnCell {
  std::uint32_t cell = 0;
  float distance_m = 0.0f;  // of its nearest point
  std::uint32_t trees = 0;  // that are drawn
  std::uint32_t first_triangle = 0, triangles = 0;
};

// The trees that views of one kind may show, nearest cells first.
struct TreeDraws {
  std::vector<DrawnCell> cells;
  // Each cell in `cells` has its drawn trees here, from its first tree's index in the world on.
  std::vector<DrawnTree> trees;
  std::vector<std::uint32_t> chosen;      // storage, likewise
  std::vector<TreePrimitive> primitives;  // per triangle
  std::vector<std::uint8_t> like_land;    // per triangle: 1 if its tree is a small one of a wood
  std::vector<std::uint32_t> indices;     // 3 per triangle
  std::vector<glm::vec3> p_rel;           // per vertex, relative to the eye

  const DrawnTree& tree_of(std::size_t triangle) const { return trees[primitives[triangle].tree]; }
  void clear() {
    cells.clear(), primitives.clear(), like_land.clear(), indices.clear(), p_rel.clear();
  }
};

struct TreeGeometry {
  std::array<TreeDraws, kViewKinds> draws;
  // How far trees stand on the ground that is drawn in place of the true one: from 0 to 1; and the
  // former's envelopes, if that is over 0.
  float on_drawn_ground = 0.0f;
  lod::Envelopes ground;

  TreeDraws& drawn_in(ViewKind kind) { return draws[static_cast<std::size_t>(kind)]; }
  const TreeDraws& drawn_in(ViewKind kind) const { return draws[static_cast<std::size_t>(kind)]; }
};

}  // namespace swell::render
