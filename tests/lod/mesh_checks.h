// What every mesh of the bintree must be, in integers.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "lod/roam.h"

namespace swell::lod {

// Says what is wrong with the mesh, or nothing: vertices unique and used, triangles
// counter-clockwise with the area of their level, together the domain's area; interior edges in two
// triangles, border edges in one; no vertex inside an edge; V - E + F = 1; levels of neighbours.
inline std::string find_mesh_fault(const Mesh& mesh, int bits) {
  const std::int64_t n = std::int64_t{1} << bits;
  std::set<std::pair<int, int>> points;
  for (const glm::ivec2& p : mesh.lattice)
    if (!points.insert({p.x, p.y}).second) return "two vertices in one place";
  if (mesh.indices.size() != 3 * mesh.level.size()) return "sizes differ";

  struct Side {
    int level;
    bool is_base;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides;
  std::set<std::uint32_t> used;
  std::int64_t area2 = 0;
  for (std::size_t t = 0; t < mesh.level.size(); ++t) {
    const std::uint32_t* v = &mesh.indices[3 * t];
    for (int k = 0; k < 3; ++k)
      if (v[k] >= mesh.lattice.size()) return "an index is out of range";
    const glm::i64vec2 a(mesh.lattice[v[0]]), b(mesh.lattice[v[1]]), c(mesh.lattice[v[2]]);
    const std::int64_t cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (cross << mesh.level[t] != n * n) return fmt::format("triangle {} has a wrong area", t);
    area2 += cross;
    for (int k = 0; k < 3; ++k) {
      used.insert(v[k]);
      const Side side{mesh.level[t], k == 2};  // first, apex, last: the base closes the triangle
      if (!sides.insert({{v[k], v[(k + 1) % 3]}, side}).second) return "an edge is used twice";
    }
  }
  if (area2 != 2 * n * n) return "the area is not the domain's";
  if (used.size() != mesh.lattice.size()) return "a vertex is not used";

  std::size_t edges = 0;
  for (const auto& [ends, side] : sides) {
    const glm::ivec2 p = mesh.lattice[ends.first], q = mesh.lattice[ends.second];
    const glm::ivec2 sum = p + q;
    if (sum.x % 2 == 0 && sum.y % 2 == 0 && points.contains({sum.x / 2, sum.y / 2}))
      return fmt::format("T-junction at ({}, {})", sum.x / 2, sum.y / 2);
    const auto other = sides.find({ends.second, ends.first});
    const bool border =
        (p.x == q.x && (p.x == 0 || p.x == n)) || (p.y == q.y && (p.y == 0 || p.y == n));
    if (border != (other == sides.end())) return "a border edge has two sides, or another has one";
    if (border || ends.first < ends.second) ++edges;
    if (border) continue;
    const int finer = other->second.level - side.level;
    if (side.is_base ? finer != (other->second.is_base ? 0 : -1)
                     : finer != (other->second.is_base ? 1 : 0))
      return "neighbours' levels do not fit";
  }
  if (mesh.lattice.size() + mesh.level.size() != edges + 1) return "V - E + F is not 1";
  return {};
}

}  // namespace swell::lod
