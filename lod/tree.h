// The triangulation: a pool of diamonds, linked to parents and children, with the two queues.
//
// A node exists for every diamond of which at least one triangle exists. It is
//   split                      its centre is a vertex of the mesh
//   splittable                 both triangles are leaves (all parents are split): in split_queue
//   half                       one parent is not split, one triangle is missing: in no queue
// and split nodes without split children are in merge_queue.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lod/priority.h"
#include "lod/queue.h"
#include "lod/roam.h"

namespace swell::lod {

struct Node {
  glm::ivec2 position{0};                             // on the lattice
  std::array<std::int32_t, 2> parent{-1, -1};         // the split ones
  std::array<std::int32_t, 4> child{-1, -1, -1, -1};  // by slot of child_offset(), if split
  std::uint8_t level = 0;
  std::uint8_t parent_count = 0;    // in the lattice
  std::uint8_t split_children = 0;  // bit per slot
  bool split = false;
};

struct Roam::Tree {
  Tree(const Domain& domain, int max_triangles);

  static constexpr int kRoot = 0;
  const Node& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
  Node& node(int i) { return nodes[static_cast<std::size_t>(i)]; }

  Domain domain;
  int max_triangles;
  int triangles = 2;  // leaves
  int split_count = 0;
  std::uint64_t revision = 0;       // counts resets, splits and merges: from 1
  PriorityFrame frame;              // of the last request: what the keys in the queues mean
  PriorityKey border = kCulledKey;  // of the first diamond that it left whole

  // 2 max_triangles nodes always suffice: at most one node that is not split per leaf, and fewer
  // split ones than leaves, for each split adds a leaf.
  std::vector<Node> nodes;
  int node_end = 0;    // nodes from here on were never used
  int free_node = -1;  // a list through child[0]

  Queue split_queue, merge_queue;
  std::vector<std::uint32_t> vertex_of_node;  // scratch of extract_mesh
};

// Back to the two root triangles.
void reset_tree(Roam::Tree& tree);

// New keys for one of `groups` groups of each queue's members, in turn; 1: for all.
void set_priorities(Roam::Tree& tree, const PriorityFrame& frame, int groups = 1);

// The number of triangles that splitting the node adds.
int added_triangles(const Roam::Tree& tree, int node);

// Splits a splittable node: both its triangles at once.
void split(Roam::Tree& tree, int node);

// The paper's forced split of a node that is not split: splits missing parents first, recursively
// (at most two per level), and returns the number of splits. The caller has room for them.
int force_split(Roam::Tree& tree, int node);

// Undoes the split of a node without split children.
void merge(Roam::Tree& tree, int node);

// Says which invariant of the tree or its queues is broken, or nothing. Keys may be old if
// priorities are worked out in groups. Slow; for tests.
std::string find_fault(const Roam::Tree& tree, bool keys_may_be_old = false);

}  // namespace swell::lod
