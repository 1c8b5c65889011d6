#include "math/box_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "math/random.h"

namespace swell {
namespace {

glm::dvec3 random_point(std::uint64_t seed, std::uint64_t n) {
  return {random_uniform(seed, 3 * n), random_uniform(seed, 3 * n + 1),
          random_uniform(seed, 3 * n + 2)};
}

// Small boxes in a unit cube, some of them without a width.
std::vector<Box> scattered_boxes(std::size_t count) {
  std::vector<Box> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 p = random_point(1, i), size = 0.1 * random_point(2, i);
    boxes[i].include(glm::vec3(p));
    boxes[i].include(glm::vec3(p + (i % 3 == 0 ? glm::dvec3(size.x, size.y, 0.0) : size)));
  }
  return boxes;
}

// By the planes of each of the box's sides: whether a point of one lies in the others' bounds.
bool touches(const Box& box, glm::dvec3 origin, glm::dvec3 along, double farthest) {
  const auto is_inside = [&](glm::dvec3 p, int but) {
    for (int k = 0; k < 3; ++k)
      if (k != but &&
          (p[k] < static_cast<double>(box.low[k]) || p[k] > static_cast<double>(box.high[k])))
        return false;
    return true;
  };
  if (is_inside(origin, -1)) return true;
  for (int k = 0; k < 3; ++k)
    for (const float side : {box.low[k], box.high[k]}) {
      const double s = (static_cast<double>(side) - origin[k]) / along[k];
      if (s >= 0.0 && s <= farthest && is_inside(origin + s * along, k)) return true;
    }
  return false;
}

TEST(BoxTree, VisitsEveryBoxThatARayTouchesAndFewOthers) {
  const std::vector<Box> boxes = scattered_boxes(2000);
  const BoxTree tree(boxes);
  std::size_t visited_count = 0, touched_count = 0;
  for (std::uint64_t n = 0; n < 500; ++n) {
    const glm::dvec3 origin = 3.0 * random_point(3, n) - 1.0;
    const glm::dvec3 along = random_point(4, n) - origin;
    double farthest = 1.5 * random_uniform(5, n);
    std::set<std::uint32_t> visited;
    tree.visit(origin, along, farthest,
               [&](std::uint32_t box) { EXPECT_TRUE(visited.insert(box).second) << box; });
    visited_count += visited.size();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (!touches(boxes[i], origin, along, farthest)) continue;
      ++touched_count;
      EXPECT_TRUE(visited.contains(i)) << "ray " << n << ", box " << i;
    }
  }
  EXPECT_GT(touched_count, 1000u);
  EXPECT_LT(visited_count, 12 * touched_count);  // of a million
}

TEST(BoxTree, AVisitorThatShortensTheRayEndsItThere) {
  const std::vector<Box> boxes = scattered_boxes(2000);
  const BoxTree tree(boxes);
  std::size_t whole = 0, shortened = 0;
  for (std::uint64_t n = 0; n < 100; ++n) {
    const glm::dvec3 origin(-1.0, random_uniform(6, 2 * n), random_uniform(6, 2 * n + 1));
    double farthest = HUGE_VAL;
    tree.visit(origin, {1.0, 0.0, 0.0}, farthest, [&](std::uint32_t) { ++whole; });
    tree.visit(origin, {1.0, 0.0, 0.0}, farthest, [&](std::uint32_t) {
      ++shortened;
      farthest = 0.0;
    });
  }
  EXPECT_LE(shortened, 400u);  // a leaf's boxes each
  EXPECT_GT(whole, 3 * shortened);
}

TEST(BoxTree, OfOneBoxAndOfNoneAnswer) {
  int visits = 0;
  double farthest = HUGE_VAL;
  const auto count = [&](std::uint32_t) { ++visits; };
  BoxTree().visit({0, 0, 0}, {0, 0, 1}, farthest, count);
  BoxTree(std::vector<Box>{}).visit({0, 0, 0}, {0, 0, 1}, farthest, count);
  EXPECT_EQ(visits, 0);
  const BoxTree one(std::vector<Box>{{{-1, -1, 2}, {1, 1, 2}}});
  one.visit({0, 0, 0}, {0, 0, 1}, farthest, count);
  one.visit({0, 0, 0}, {0, 0, -1}, farthest, count);
  one.visit({3, 0, 0}, {0, 0, 1}, farthest, count);
  EXPECT_EQ(visits, 1);
}

}  // namespace
}  // namespace swell
