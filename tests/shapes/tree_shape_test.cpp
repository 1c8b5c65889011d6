// What trees look like.
#include "shapes/tree_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swell::shapes {
namespace {

using terrain::TreeSpecies;

class TreeShapes : public testing::TestWithParam<TreeSpecies> {
 protected:
  TreeShape shape = make_tree_shape(GetParam());
  int all = static_cast<int>(shape.leaves.size());
};
INSTANTIATE_TEST_SUITE_P(Species, TreeShapes,
                         testing::Values(TreeSpecies::kConifer, TreeSpecies::kBroadleaf,
                                         TreeSpecies::kReed),
                         [](const auto& test) {
                           const auto at = static_cast<std::size_t>(test.param);
                           return std::string(terrain::kTreeSpeciesNames[at]);
                         });

// Points of the crown's box, seen from the side at a turn, that leaves cover: an oracle of its own,
// by half-planes at points of a finer grid than the one that sizes were found with.
double cover_from(const TreeShape& shape, float leaves, double turns) {
  constexpr int kSide = 150;
  const float size = leaf_size(shape, leaves);
  const glm::vec2 right(std::cos(turns * 2.0 * 3.14159265358979),
                        std::sin(turns * 2.0 * 3.14159265358979));
  std::vector<bool> covered(static_cast<std::size_t>(kSide) * kSide, false);
  for (int n = 0; n < static_cast<int>(std::ceil(leaves)); ++n) {
    const TreeLeaf& leaf = shape.leaves[static_cast<std::size_t>(n)];
    const glm::vec3 middle = leaf_middle(shape, leaf, size);
    const float grown = std::sqrt(std::min(leaves - static_cast<float>(n), 1.0f));
    std::array<glm::dvec2, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = glm::dvec2(glm::dot(glm::vec2(middle), right), middle.z) +
             glm::dvec2(leaf_corner(shape, leaf.corner[k], size, grown));
    // From -1.5 to 1.5 radii, from -0.25 to 1.25 heights.
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int j = std::max(0, static_cast<int>((y0 + 0.25) * 100.0) - 1);
         j < std::min(kSide, static_cast<int>((y1 + 0.25) * 100.0) + 2); ++j)
      for (int i = 0; i < kSide; ++i) {
        const glm::dvec2 q(-1.5 + (i + 0.5) * 0.02, -0.25 + (j + 0.5) * 0.01);
        int left = 0;
        for (int k = 0; k < 3; ++k) {
          const glm::dvec2 a = p[(k + 1) % 3] - p[k], b = q - p[k];
          left += a.x * b.y - a.y * b.x >= 0.0;
        }
        if (left == 0 || left == 3) covered[static_cast<std::size_t>(j) * kSide + i] = true;
      }
  }
  return static_cast<double>(std::ranges::count(covered, true)) * 0.02 * 0.01 / 2.0;
}

double mean_cover(const TreeShape& shape, float leaves) {
  double sum = 0.0;
  for (const double turns : {0.0, 0.13, 0.31, 0.42}) sum += 0.25 * cover_from(shape, leaves, turns);
  return sum;
}

// A tree of 12 m is drawn with all of its leaves 20 m away and with one or two at 2 km.
TEST_P(TreeShapes, CoverAsMuchWithAnyNumberOfLeaves) {
  const double whole = mean_cover(shape, static_cast<float>(all));
  for (const float part : {0.7f, 0.3f, 0.1f, 0.03f, 0.01f}) {
    const float leaves = std::max(1.0f, std::round(part * static_cast<float>(all)));
    EXPECT_NEAR(mean_cover(shape, leaves) / whole, 1.0, 0.05) << leaves;
  }
  EXPECT_NEAR(mean_cover(shape, 1.0f) / whole, 1.0, 0.05);
  EXPECT_NEAR(mean_cover(shape, 2.0f) / whole, 1.0, 0.05);
}

// No step where a leaf comes in.
TEST_P(TreeShapes, LeavesGrowFromNothing) {
  for (const int n : {1, 2, 5, 17, all / 2}) {
    EXPECT_NEAR(leaf_size(shape, static_cast<float>(n) + 1e-4f),
                leaf_size(shape, static_cast<float>(n)), 1e-3f);
    const TreeLeaf& next = shape.leaves[static_cast<std::size_t>(n)];
    const float size = leaf_size(shape, static_cast<float>(n));
    for (const glm::vec2& corner : next.corner) {
      const glm::vec2 c = leaf_corner(shape, corner, size, 1e-4f);
      EXPECT_LT(shape.is_blades ? std::abs(c.y) : glm::length(c), 1e-3f);
    }
  }
}

TEST_P(TreeShapes, StayAboutTheirBoxes) {
  for (const int n : {1, 2, 3, 10, 100, all}) {
    const int count = std::min(n, all);
    const float size = leaf_size(shape, static_cast<float>(count));
    float lowest = 1.0f, highest = 0.0f, widest = 0.0f;
    for (int k = 0; k < count; ++k) {
      const TreeLeaf& leaf = shape.leaves[static_cast<std::size_t>(k)];
      const glm::vec3 middle = leaf_middle(shape, leaf, size);
      for (const glm::vec2& corner : leaf.corner) {
        const glm::vec2 c = leaf_corner(shape, corner, size, 1.0f);
        lowest = std::min(lowest, middle.z + c.y);
        highest = std::max(highest, middle.z + c.y);
        widest = std::max(widest, glm::length(glm::vec2(middle)) + std::abs(c.x));
      }
    }
    EXPECT_GT(lowest, -0.2f) << count;
    EXPECT_LT(highest, 1.2f) << count;
    EXPECT_GT(highest, 0.75f) << count;
    EXPECT_LT(widest, 1.7f) << count;
  }
}

}  // namespace
}  // namespace swell::shapes
