// A tree of boxes: which of many things a ray may meet, nearest first, without looking at the rest.
//
//   const BoxTree tree(boxes);  // one a thing
//   tree.visit(origin, along, farthest, [&](std::uint32_t thing) {
//     if (const auto s = meet(thing); s < farthest) farthest = s;  // shortens the ray
//   });
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace swell {

struct Box {
  glm::vec3 low{HUGE_VALF}, high{-HUGE_VALF};  // empty

  void include(glm::vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
  void include(const Box& box) { low = glm::min(low, box.low), high = glm::max(high, box.high); }
};

// Never changed once it is made; any number of threads may visit it.
class BoxTree {
 public:
  BoxTree() = default;
  // Splits at the median along the widest axis. The same tree for the same boxes, fewer than 2^31
  // finite ones; 0.5 us a box.
  explicit BoxTree(std::span<const Box> boxes);

  bool empty() const { return nodes_.empty(); }

  // Calls meet(thing) for every thing whose box origin + s along, 0 <= s <= farthest, touches, and
  // maybe for others: nearer boxes about first. meet() may lower `farthest`. `along` is not 0.
  template <class Meet>
  void visit(glm::dvec3 origin, glm::dvec3 along, double& farthest, const Meet& meet) const;

 private:
  static constexpr std::uint32_t kMostInLeaf = 4;

  struct Node {
    Box box;
    std::uint32_t first;  // of the things, or the first of two children
    std::uint32_t count;  // of things; 0: has children
  };

  // Where a ray enters a box; NaN: it does not, up to `farthest`.
  struct LineThrough {
    glm::dvec3 origin, along, inverse;
  };
  static double entry(const LineThrough& line, const Box& box, double farthest);

  void split(std::uint32_t node, std::span<const Box> boxes);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> things_;
};

inline double BoxTree::entry(const LineThrough& line, const Box& box, double farthest) {
  constexpr double kRounding = 1e-12, kMiss = std::numeric_limits<double>::quiet_NaN();
  double from = 0.0, to = farthest;
  for (int k = 0; k < 3; ++k) {
    const auto low = static_cast<double>(box.low[k]), high = static_cast<double>(box.high[k]);
    if (line.along[k] == 0.0) {
      if (line.origin[k] < low || line.origin[k] > high) return kMiss;
      continue;
    }
    const double a = (low - line.origin[k]) * line.inverse[k];
    const double b = (high - line.origin[k]) * line.inverse[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to + kRounding * (from + std::abs(to)) ? from : kMiss;
}

template <class Meet>
void BoxTree::visit(glm::dvec3 origin, glm::dvec3 along, double& farthest, const Meet& meet) const {
  if (nodes_.empty()) return;
  const LineThrough line{origin, along, 1.0 / along};
  struct Waiting {
    std::uint32_t node;
    double entry;
  };
  std::array<Waiting, 64> waiting;  // a median split is no deeper than 32
  std::size_t count = 0;
  waiting[count++] = {0, entry(line, nodes_[0].box, farthest)};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (!(next.entry <= farthest)) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = 0; i < node.count; ++i) meet(things_[node.first + i]);
    if (node.count > 0) continue;
    Waiting near = {node.first, entry(line, nodes_[node.first].box, farthest)};
    Waiting far = {node.first + 1, entry(line, nodes_[node.first + 1].box, farthest)};
    if (far.entry < near.entry) std::swap(near, far);
    if (far.entry <= farthest) waiting[count++] = far;
    if (near.entry <= farthest) waiting[count++] = near;
  }
}

}  // namespace swell
