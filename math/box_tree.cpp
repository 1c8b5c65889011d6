#include "math/box_tree.h"

#include <numeric>

#include "math/check.h"

namespace swell {

BoxTree::BoxTree(std::span<const Box> boxes) : things_(boxes.size()) {
  SWELL_CHECK(boxes.size() < std::size_t{1} << 31, "{} boxes", boxes.size());
  if (boxes.empty()) return;
  std::iota(things_.begin(), things_.end(), 0u);
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size())});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node, boxes);
}

// Gives a node that has all its things its box, and two children if these are many.
void BoxTree::split(std::uint32_t node, std::span<const Box> boxes) {
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
  const auto things = std::span(things_).subspan(first, count);
  Box all, middles;
  for (const std::uint32_t thing : things) {
    all.include(boxes[thing]);
    middles.include(0.5f * (boxes[thing].low + boxes[thing].high));
  }
  nodes_[node].box = all;
  if (count <= kMostInLeaf) return;
  const glm::vec3 size = middles.high - middles.low;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const auto place = [&](std::uint32_t thing) {
    return std::pair(boxes[thing].low[axis] + boxes[thing].high[axis], thing);
  };
  const std::uint32_t half = count / 2;
  std::ranges::nth_element(things, things.begin() + half, {}, place);
  // Which half a thing is in is known; its order there would be the library's own.
  std::ranges::sort(things.first(half));
  std::ranges::sort(things.subspan(half));
  nodes_[node] = {all, static_cast<std::uint32_t>(nodes_.size()), 0};
  nodes_.push_back({{}, first, half});
  nodes_.push_back({{}, first + half, count - half});
}

}  // namespace swell
