// The leaves of the tree as an indexed mesh, in the order of a Sierpinski curve: each triangle
// shares an edge with the one before it, which keeps vertex caches warm.
#include <hwy/cache_control.h>

#include <algorithm>
#include <limits>

#include "lod/diamond.h"
#include "lod/roam.h"
#include "lod/tree.h"

namespace swell::lod {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

// A triangle's vertices, counter-clockwise; the base runs from `last` to `first`.
struct Corners {
  std::uint32_t first, apex, last;
};

struct MeshWriter {
  const Node* nodes;
  std::uint32_t* vertex_of_node;
  glm::ivec2* lattice;
  std::uint32_t* indices;
  std::uint8_t* levels;
  std::uint32_t vertices, triangles;

  void write_leaf(Corners c, int level) {
    std::uint32_t* out = indices + 3 * static_cast<std::size_t>(triangles);
    out[0] = c.first;
    out[1] = c.apex;
    out[2] = c.last;
    levels[triangles++] = static_cast<std::uint8_t>(level);
  }

  std::uint32_t vertex(std::int32_t node) {
    std::uint32_t& v = vertex_of_node[node];
    if (v == kNoVertex) {
      v = vertices++;
      lattice[v] = nodes[node].position;
    }
    return v;
  }

  // A child triangle: its base's middle lies in `direction` from the split vertex.
  void write_child(const Node& parent, int direction, Corners c) {
    const int slot = direction >> 1;
    if ((parent.split_children >> slot & 1) != 0)
      write_split(parent.child[static_cast<std::size_t>(slot)], (direction + 4) & 7, c);
    else
      write_leaf(c, parent.level + 1);
  }

  // The leaves below the triangle `c` of a split node. `direction`: from the middle of the base
  // to the apex, in eighths of a turn from east.
  void write_split(std::int32_t i, int direction, Corners c) {
    const Node& node = nodes[i];
    // Nodes lie anywhere, and waiting for them is most of the work.
    for (const std::int32_t child : node.child) hwy::Prefetch(nodes + std::max(child, 0));
    const std::uint32_t middle = vertex(i);
    const auto first_half = [&] {
      write_child(node, (direction + 7) & 7, {c.apex, middle, c.first});
    };
    const auto last_half = [&] {
      write_child(node, (direction + 1) & 7, {c.last, middle, c.apex});
    };
    // Halves run against their parent's sense, so the curve's sense alternates.
    if (node.level % 2 == 0) {
      first_half();
      last_half();
    } else {
      last_half();
      first_half();
    }
  }
};

}  // namespace

void Roam::extract_mesh(Mesh& mesh) const {
  const Tree& tree = *tree_;
  mesh.lattice.resize(4 + static_cast<std::size_t>(tree.split_count));
  mesh.indices.resize(3 * static_cast<std::size_t>(tree.triangles));
  mesh.level.resize(static_cast<std::size_t>(tree.triangles));
  std::fill_n(tree_->vertex_of_node.begin(), tree.node_end, kNoVertex);

  const int n = 1 << tree.domain.lattice_bits;
  mesh.lattice[0] = {0, 0};
  mesh.lattice[1] = {n, 0};
  mesh.lattice[2] = {n, n};
  mesh.lattice[3] = {0, n};
  MeshWriter writer{.nodes = tree.nodes.data(),
                    .vertex_of_node = tree_->vertex_of_node.data(),
                    .lattice = mesh.lattice.data(),
                    .indices = mesh.indices.data(),
                    .levels = mesh.level.data(),
                    .vertices = 4,
                    .triangles = 0};
  const Corners south_east{0, 1, 2}, north_west{2, 3, 0};
  if (!tree.node(Tree::kRoot).split) {
    writer.write_leaf(south_east, 0);
    writer.write_leaf(north_west, 0);
    return;
  }
  writer.write_split(Tree::kRoot, 7, south_east);
  writer.write_split(Tree::kRoot, 3, north_west);
}

void Roam::update_mesh(Mesh& mesh, std::uint64_t& revision) const {
  if (revision == tree_->revision) return;
  extract_mesh(mesh);
  revision = tree_->revision;
}

}  // namespace swell::lod
