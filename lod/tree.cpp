#include "lod/tree.h"

#include "lod/diamond.h"
#include "math/check.h"

namespace swell::lod {
namespace {

using Tree = Roam::Tree;

int parents_split(const Node& node) { return (node.parent[0] >= 0) + (node.parent[1] >= 0); }

int make_node(Tree& tree, glm::ivec2 position, int level) {
  int i = tree.free_node;
  if (i >= 0) {
    tree.free_node = tree.node(i).child[0];
  } else {
    SWELL_DCHECK(tree.node_end < static_cast<int>(tree.nodes.size()), "end={}", tree.node_end);
    i = tree.node_end++;
  }
  Node& node = tree.node(i);
  node = Node{};
  node.position = position;
  node.level = static_cast<std::uint8_t>(level);
  if (level > 0) node.parent_count = on_border(tree.domain.lattice_bits, position) ? 1 : 2;
  return i;
}

void free_node(Tree& tree, int i) {
  tree.node(i).child[0] = tree.free_node;
  tree.free_node = i;
}

void enqueue(Tree& tree, Queue& queue, int i) {
  const Node& node = tree.node(i);
  queue.insert(tree.frame, i, node.position.x, node.position.y, node.level);
}

// The slot of `child` among the children of `parent`.
int slot_of(const Node& parent, int child) {
  for (int slot = 0; slot < 4; ++slot)
    if (parent.child[static_cast<std::size_t>(slot)] == child) return slot;
  check_failed(__FILE__, __LINE__, "the parent knows its child", fmt::format("child={}", child));
}

// The other parent of the child of split node i in `slot`: the mirror image of i in that child.
// -1 if that lies outside the domain. It exists, split or not, because the two mirror images
// share a parent, which is split as i is.
int other_parent(const Tree& tree, int i, int slot) {
  const int bits = tree.domain.lattice_bits;
  const Node& node = tree.node(i);
  const glm::ivec2 mirrored = node.position + 2 * child_offset(bits, node.level, slot);
  if (!in_domain(bits, mirrored)) return -1;
  for (const int p : node.parent) {
    if (p < 0) continue;
    const Node& parent = tree.node(p);
    for (int k = 0; k < 4; ++k)
      if (parent.position + child_offset(bits, parent.level, k) == mirrored)
        return parent.child[static_cast<std::size_t>(k)];
  }
  check_failed(__FILE__, __LINE__, "mirror images share a parent", fmt::format("node={}", i));
}

// Links the child of split node i in `slot`, which the other parent may have made already.
void attach_child(Tree& tree, int i, int slot) {
  const int bits = tree.domain.lattice_bits;
  const Node& node = tree.node(i);
  const glm::ivec2 position = node.position + child_offset(bits, node.level, slot);
  if (!in_domain(bits, position)) return;

  const int other = other_parent(tree, i, slot);
  const bool exists = other >= 0 && tree.node(other).split;
  const int c = exists ? tree.node(other).child[static_cast<std::size_t>(slot ^ 2)]
                       : make_node(tree, position, node.level + 1);
  tree.node(i).child[static_cast<std::size_t>(slot)] = c;
  Node& child = tree.node(c);
  child.parent[child.parent[0] < 0 ? 0 : 1] = i;
  if (parents_split(child) == child.parent_count) enqueue(tree, tree.split_queue, c);
}

// The reverse: the child loses a triangle, and vanishes with its last one.
void detach_child(Tree& tree, int i, int slot) {
  const int c = tree.node(i).child[static_cast<std::size_t>(slot)];
  if (c < 0) return;
  tree.node(i).child[static_cast<std::size_t>(slot)] = -1;
  if (tree.split_queue.contains(c)) tree.split_queue.erase(c);
  Node& child = tree.node(c);
  child.parent[child.parent[0] == i ? 0 : 1] = -1;
  if (parents_split(child) == 0) free_node(tree, c);
}

}  // namespace

Roam::Tree::Tree(const Domain& d, int max)
    : domain(d),
      max_triangles(max),
      nodes(static_cast<std::size_t>(max) * 2),
      split_queue(Queue::Order::kHighestPriorityFirst, max, 2 * max),
      merge_queue(Queue::Order::kLowestPriorityFirst, max, 2 * max),
      vertex_of_node(nodes.size()) {
  frame.lattice_bits = domain.lattice_bits;
  reset_tree(*this);
}

void reset_tree(Tree& tree) {
  tree.split_queue.clear();
  tree.merge_queue.clear();
  tree.node_end = 0;
  tree.free_node = -1;
  tree.triangles = 2;
  tree.split_count = 0;
  ++tree.revision;
  const int middle = half_size(tree.domain.lattice_bits, 0);
  const int root = make_node(tree, {middle, middle}, 0);
  enqueue(tree, tree.split_queue, root);
}

void set_priorities(Tree& tree, const PriorityFrame& frame, int groups) {
  tree.frame = frame;
  tree.split_queue.update_keys(frame, groups);
  tree.merge_queue.update_keys(frame, groups);
}

int added_triangles(const Tree& tree, int node) {
  return on_border(tree.domain.lattice_bits, tree.node(node).position) ? 1 : 2;
}

void split(Tree& tree, int i) {
  SWELL_DCHECK(tree.split_queue.contains(i), "node={}", i);
  tree.split_queue.erase(i);
  tree.node(i).split = true;
  tree.triangles += added_triangles(tree, i);
  ++tree.split_count;
  ++tree.revision;

  // The parents cannot be merged any more.
  for (const int p : tree.node(i).parent) {
    if (p < 0) continue;
    Node& parent = tree.node(p);
    if (parent.split_children == 0) tree.merge_queue.erase(p);
    parent.split_children |= static_cast<std::uint8_t>(1 << slot_of(parent, i));
  }
  enqueue(tree, tree.merge_queue, i);

  if (tree.node(i).level + 1 < level_count(tree.domain.lattice_bits))
    for (int slot = 0; slot < 4; ++slot) attach_child(tree, i, slot);
}

int force_split(Tree& tree, int i) {
  SWELL_DCHECK(!tree.node(i).split, "node={}", i);
  int splits = 0;
  if (parents_split(tree.node(i)) < tree.node(i).parent_count) {
    const int p = tree.node(i).parent[tree.node(i).parent[0] >= 0 ? 0 : 1];
    splits = force_split(tree, other_parent(tree, p, slot_of(tree.node(p), i)));
  }
  split(tree, i);
  return splits + 1;
}

void merge(Tree& tree, int i) {
  SWELL_DCHECK(tree.merge_queue.contains(i), "node={}", i);
  for (int slot = 0; slot < 4; ++slot) detach_child(tree, i, slot);

  tree.merge_queue.erase(i);
  for (const int p : tree.node(i).parent) {
    if (p < 0) continue;
    Node& parent = tree.node(p);
    parent.split_children &= static_cast<std::uint8_t>(~(1 << slot_of(parent, i)));
    if (parent.split_children == 0) enqueue(tree, tree.merge_queue, p);
  }

  tree.node(i).split = false;
  tree.triangles -= added_triangles(tree, i);
  --tree.split_count;
  ++tree.revision;
  enqueue(tree, tree.split_queue, i);
}

}  // namespace swell::lod
