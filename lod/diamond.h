// The geometry of diamonds: which vertex splits which triangles.
//
// Every lattice point but the four corners is the middle of the common base of two triangles of
// one level (of one triangle at the domain's border): its diamond. Splitting both there at once
// is the only operation that keeps the mesh conforming, so a triangulation is a set of split
// diamonds that holds the parents of all its members. With N = 2^lattice_bits and
// h = N >> (level / 2 + 1):
//
//   level        centre                    the two triangles   parents         children
//   0            (h, h)                    the domain          none            (+-h, 0), (0, +-h)
//   even         odd, odd multiple of h    a square, +-h       2 corners of 4  (+-h, 0), (0, +-h)
//   odd          one odd, one even         corners at (+-h, 0) 2 (border: 1)   (+-h/2, +-h/2)
//                                          and (0, +-h)        of the corners
//
// Source: Duchaineau et al., ROAMing Terrain, 1997, section 4; diamonds as units after
// Hwa, Duchaineau, Joy, Real-Time Optimal Adaptation for Planetary Geometry and Texture, 2005.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace swell::lod {

// Diamonds have levels [0, 2 lattice_bits): the level of the triangles that they split.
constexpr int level_count(int lattice_bits) { return 2 * lattice_bits; }

// h above, in lattice units: >= 1 at every level.
constexpr int half_size(int lattice_bits, int level) {
  return (1 << lattice_bits) >> (level / 2 + 1);
}

// Half the side of the square around the centre that holds the diamond and all its descendants.
// A descendant reaches further than the diamond itself. With e and o for even and odd levels:
//   e(h) = h + o(h), o(h) = h/2 + e(h/2)   =>   e(h) = 3h, o(h) = 2h.
constexpr int subtree_half_size(int lattice_bits, int level) {
  return half_size(lattice_bits, level) * (3 - (level & 1));
}

// From the centre to child `slot` in [0, 4): even levels E, N, W, S; odd levels NE, NW, SW, SE.
// `slot` and `slot ^ 2` are opposite.
constexpr glm::ivec2 child_offset(int lattice_bits, int level, int slot) {
  const int h = half_size(lattice_bits, level);
  if (level % 2 == 0)
    return slot % 2 == 0 ? glm::ivec2(h - slot * h, 0) : glm::ivec2(0, h - (slot - 1) * h);
  return {slot == 0 || slot == 3 ? h / 2 : -h / 2, slot < 2 ? h / 2 : -h / 2};
}

constexpr bool in_domain(int lattice_bits, glm::ivec2 p) {
  const int n = 1 << lattice_bits;
  return p.x >= 0 && p.y >= 0 && p.x <= n && p.y <= n;
}

// A diamond on the border has one triangle, and one parent.
constexpr bool on_border(int lattice_bits, glm::ivec2 p) {
  const int n = 1 << lattice_bits;
  return p.x == 0 || p.y == 0 || p.x == n || p.y == n;
}

// The last part of the total order of diamonds: level, then y, then x. 56 bits.
constexpr std::uint64_t lattice_order(int level, int x, int y) {
  return static_cast<std::uint64_t>(level) << 50 | static_cast<std::uint64_t>(y) << 25 |
         static_cast<std::uint64_t>(x);
}

}  // namespace swell::lod
