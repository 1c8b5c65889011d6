#include "lod/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lod/diamond_oracle.h"
#include "math/random.h"

namespace swell::lod {
namespace {

// The diamonds that a split of d needs: d and all its ancestors that are not split yet.
int missing_with_ancestors(int bits, const oracle::OracleDiamond& d,
                           std::set<oracle::Point>& split) {
  if (!split.insert(d.centre).second) return 0;
  int count = 1;
  for (const oracle::Point& p : d.parents)
    count += missing_with_ancestors(bits, oracle::make_diamond(bits, p.first, p.second), split);
  return count;
}

TEST(Tree, ANewTreeIsTwoTrianglesWithOneSplitToMake) {
  const Roam::Tree tree({{0.0, 0.0}, 1.0, 4}, 100);
  EXPECT_EQ(tree.triangles, 2);
  EXPECT_EQ(tree.split_queue.size(), 1);
  EXPECT_EQ(tree.merge_queue.size(), 0);
  EXPECT_EQ(find_fault(tree), "");
}

TEST(Tree, AMergeUndoesASplit) {
  Roam::Tree tree({{0.0, 0.0}, 1.0, 4}, 100);
  split(tree, Roam::Tree::kRoot);
  EXPECT_EQ(tree.triangles, 4);
  EXPECT_EQ(tree.split_queue.size(), 4);  // the middles of the four sides
  EXPECT_EQ(tree.merge_queue.size(), 1);
  EXPECT_EQ(find_fault(tree), "");
  merge(tree, Roam::Tree::kRoot);
  EXPECT_EQ(tree.triangles, 2);
  EXPECT_EQ(tree.split_queue.size(), 1);
  EXPECT_EQ(tree.merge_queue.size(), 0);
  EXPECT_EQ(find_fault(tree), "");
}

// The paper's figure: one split that makes ten new triangles. Refining around one point leaves ever
// coarser neighbours behind, which have to follow.
TEST(Tree, AForcedSplitTakesTheCoarserNeighboursAlong) {
  const int bits = 6;
  Roam::Tree tree({{0.0, 0.0}, 1.0, bits}, 1000);
  std::set<oracle::Point> split_points;
  const auto missing = [&](int i, std::set<oracle::Point>& split) {
    const glm::ivec2 p = tree.node(i).position;
    return missing_with_ancestors(bits, oracle::make_diamond(bits, p.x, p.y), split);
  };
  for (int level = 0; level < 10; ++level) {
    int nearest = -1;
    const auto distance2 = [&](int i) {
      const glm::ivec2 d = tree.node(i).position - glm::ivec2(23, 41);
      return d.x * d.x + d.y * d.y;
    };
    for (int i = 0; i < tree.node_end; ++i)
      if (tree.node(i).level == level && (nearest < 0 || distance2(i) < distance2(nearest)))
        nearest = i;
    ASSERT_GE(nearest, 0);
    if (tree.node(nearest).split) continue;
    const int expected = missing(nearest, split_points);
    ASSERT_EQ(force_split(tree, nearest), expected);
    ASSERT_EQ(find_fault(tree), "");
  }

  std::set<int> added;
  for (int i = 0; i < tree.node_end; ++i) {
    if (tree.node(i).split) continue;
    Roam::Tree forced = tree;
    std::set<oracle::Point> points = split_points;
    const int expected = missing(i, points);
    ASSERT_EQ(force_split(forced, i), expected);
    ASSERT_EQ(find_fault(forced), "");
    added.insert(forced.triangles - tree.triangles);
  }
  EXPECT_TRUE(added.contains(2));
  EXPECT_TRUE(added.contains(10));
}

TEST(Tree, RandomOperationsKeepEveryInvariant) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const int bits = 2 + static_cast<int>(seed % 4);
    Roam::Tree tree({{0.0, 0.0}, 1.0, bits}, 2 << (2 * bits));
    std::uint64_t counter = 0;
    int forced = 0;
    for (int step = 0; step < 300; ++step) {
      const double kind = random_uniform(seed, counter++);
      const double choice = random_uniform(seed, counter++);
      const int start = static_cast<int>(choice * tree.node_end);
      for (int k = 0; k < tree.node_end; ++k) {
        const int i = (start + k) % tree.node_end;
        const bool mergeable = tree.merge_queue.contains(i);
        if (kind < 0.4 && mergeable) {
          merge(tree, i);
          break;
        }
        const bool half = !mergeable && !tree.node(i).split && !tree.split_queue.contains(i) &&
                          (tree.node(i).parent[0] >= 0 || tree.node(i).parent[1] >= 0);
        // A free node has no parents that list it.
        const int p = half ? std::max(tree.node(i).parent[0], tree.node(i).parent[1]) : -1;
        const bool alive = p >= 0 && std::ranges::count(tree.node(p).child, i) == 1;
        if (kind >= 0.4 && (tree.split_queue.contains(i) || alive)) {
          forced += force_split(tree, i) > 1;
          break;
        }
      }
      ASSERT_EQ(find_fault(tree), "") << "seed " << seed << " step " << step;
    }
    if (bits >= 4) {
      EXPECT_GT(forced, 0) << seed;
    }
  }
}

TEST(Tree, TheFullTreeFitsItsPool) {
  for (int bits = 1; bits <= 5; ++bits) {
    const int full = 2 << (2 * bits);
    Roam::Tree tree({{0.0, 0.0}, 1.0, bits}, full);
    while (const auto member = tree.split_queue.first()) split(tree, member->node);
    EXPECT_EQ(tree.triangles, full);
    EXPECT_EQ(tree.split_count, ((1 << bits) + 1) * ((1 << bits) + 1) - 4);
    EXPECT_EQ(find_fault(tree), "");
    while (const auto member = tree.merge_queue.first()) merge(tree, member->node);
    EXPECT_EQ(tree.triangles, 2);
    EXPECT_EQ(find_fault(tree), "");
  }
}

}  // namespace
}  // namespace swell::lod
