// What trees look like: triangles turned to the eye, in an order of which each beginning is a
// coarser tree. Fewer triangles are larger ones, so that a tree covers as much of a picture however
// many it is drawn with, and it may be drawn with any number of them, also a broken one.
// Source: Cook, Halstead, Planck, Ryu, Stochastic Simplification of Aggregate Detail, 2007 (a part
// of the elements, made larger).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "terrain/trees.h"

namespace swell::shapes {

// A triangle of leaves, twigs or a blade. The crown is a box: right and ahead in radii from the
// trunk, up in parts of the crown's height from where it begins.
struct TreeLeaf {
  glm::vec3 middle{0.0f};
  float size = 1.0f;                // over that of the others; large ones lie deeper inside
  std::array<glm::vec2, 3> corner;  // across the view, of size 1, in radii and crown heights
  glm::vec2 flutter{0.0f, 1.0f};    // sine and cosine of when it moves in the wind
  static constexpr bool kPlainBytes = true;
};

struct TreeShape {
  float crown_begin = 0.0f;  // part of the height
  float gathers_up = 0.5f;   // at which part of the crown's height large leaves gather
  float flatness = 1.0f;     // height of small leaves over what it is of large ones
  bool is_blades = false;    // its leaves keep their heights
  float fewest_leaves = 1;   // that look like its crown
  float trunk = 0.0f;        // half its width over the height; 0: none
  std::vector<TreeLeaf> leaves = {};
  std::vector<float> size = {};  // of leaves when 0, 1/4, 1/2, ... are drawn

  auto fields() {
    return std::tie(crown_begin, gathers_up, flatness, is_blades, fewest_leaves, trunk, leaves,
                    size);
  }
};

// The shape of a species, kMixed excepted. A constant; 30 ms.
TreeShape make_tree_shape(terrain::TreeSpecies species);

// Size of leaves when so many are drawn, in [1, all of them].
float leaf_size(const TreeShape& shape, float leaves);

// Where a leaf's middle lies in the crown's box, and its corners from there across the view, when
// leaves have this size; `grown` in [0, 1]: the root of the part of the last one.
glm::vec3 leaf_middle(const TreeShape& shape, const TreeLeaf& leaf, float size);
glm::vec2 leaf_corner(const TreeShape& shape, glm::vec2 corner, float size, float grown);

// The part of the crown's box, seen from the side, that so many leaves cover.
float crown_cover(const TreeShape& shape, int leaves, float size);

}  // namespace swell::shapes
