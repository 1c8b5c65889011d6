#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "lod/diamond.h"
#include "lod/tree.h"

namespace swell::lod {
namespace {

using Tree = Roam::Tree;

// Every node that the root reaches, each once.
std::vector<int> reachable_nodes(const Tree& tree) {
  std::vector<bool> seen(static_cast<std::size_t>(tree.node_end), false);
  std::vector<int> found{Tree::kRoot};
  seen[Tree::kRoot] = true;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const int c : tree.node(found[i]).child) {
      if (!tree.node(found[i]).split || c < 0 || seen[static_cast<std::size_t>(c)]) continue;
      seen[static_cast<std::size_t>(c)] = true;
      found.push_back(c);
    }
  }
  return found;
}

std::string find_link_fault(const Tree& tree, int i) {
  const int bits = tree.domain.lattice_bits;
  const Node& node = tree.node(i);
  int parents = 0;
  for (const int p : node.parent) {
    if (p < 0) continue;
    ++parents;
    if (!tree.node(p).split) return "a linked parent is not split";
    if (std::ranges::count(tree.node(p).child, i) != 1) return "a parent does not know its child";
  }
  const int lattice_parents = node.level == 0 ? 0 : on_border(bits, node.position) ? 1 : 2;
  if (node.parent_count != lattice_parents) return "wrong count of lattice parents";
  if (node.level > 0 && parents == 0) return "a node without triangles";
  if (node.split && parents != lattice_parents) return "split before its parent";
  const bool deepest = node.level + 1 == level_count(bits);
  for (int slot = 0; slot < 4; ++slot) {
    const int c = node.child[static_cast<std::size_t>(slot)];
    const glm::ivec2 place = node.position + child_offset(bits, node.level, slot);
    const bool expected = node.split && !deepest && in_domain(bits, place);
    if ((c >= 0) != expected) return "a child is missing or too many";
    if (c >= 0 && tree.node(c).position != place) return "a child is out of place";
    const bool child_split = c >= 0 && tree.node(c).split;
    if ((node.split_children >> slot & 1) != child_split) return "wrong bit of a split child";
  }
  return {};
}

std::string find_queue_fault(const Tree& tree, int i, bool keys_may_be_old) {
  const Node& node = tree.node(i);
  const int parents = (node.parent[0] >= 0) + (node.parent[1] >= 0);
  const bool splittable = !node.split && parents == node.parent_count;
  const bool mergeable = node.split && node.split_children == 0;
  if (tree.split_queue.contains(i) != splittable) return "the split queue is wrong";
  if (tree.merge_queue.contains(i) != mergeable) return "the merge queue is wrong";
  if (keys_may_be_old || (!splittable && !mergeable)) return {};
  const PriorityKey key = priority_key(tree.frame, node.position.x, node.position.y, node.level);
  const Queue& queue = splittable ? tree.split_queue : tree.merge_queue;
  return queue.key(i) == key ? "" : "a stored priority is out of date";
}

std::string find_count_fault(const Tree& tree, const std::vector<int>& nodes) {
  int triangles = 2, splits = 0, splittable = 0, mergeable = 0, free = 0;
  for (const int i : nodes) {
    if (tree.node(i).split) triangles += added_triangles(tree, i);
    splits += tree.node(i).split;
    splittable += tree.split_queue.contains(i);
    mergeable += tree.merge_queue.contains(i);
  }
  for (int i = tree.free_node; i >= 0; i = tree.node(i).child[0]) ++free;
  if (triangles != tree.triangles) return "wrong count of triangles";
  if (splits != tree.split_count) return "wrong count of splits";
  if (splittable != tree.split_queue.size()) return "the split queue holds strangers";
  if (mergeable != tree.merge_queue.size()) return "the merge queue holds strangers";
  if (static_cast<int>(nodes.size()) + free != tree.node_end) return "nodes are lost";
  return {};
}

}  // namespace

std::string find_fault(const Tree& tree, bool keys_may_be_old) {
  const std::vector<int> nodes = reachable_nodes(tree);
  for (const int i : nodes) {
    std::string fault = find_link_fault(tree, i);
    if (fault.empty()) fault = find_queue_fault(tree, i, keys_may_be_old);
    const Node& node = tree.node(i);
    if (!fault.empty())
      return fmt::format("{}: level {} at ({}, {})", fault, node.level, node.position.x,
                         node.position.y);
  }
  if (!tree.split_queue.heap_is_consistent()) return "the split queue's heap is wrong";
  if (!tree.merge_queue.heap_is_consistent()) return "the merge queue's heap is wrong";
  return find_count_fault(tree, nodes);
}

}  // namespace swell::lod
