// Envelopes: bounds of all that lies below a triangle of the bintree.
//
// The leaves below a triangle fill it exactly, seen from above. So its envelope is the prism over
// it between the least and the greatest height there. Its corners follow from the way down from
// the roots; what has to be kept are two heights and the number of leaves. Those leaves are
// neighbours in the mesh's order: what is known of an envelope holds for a range of triangles.
//
// Source: Duchaineau et al., ROAMing Terrain, 1997, section 6 (wedgies; culling by subtree);
// Elykov et al., 2000 (envelopes for culling, intersection and search).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/height_pyramid.h"
#include "lod/roam.h"
#include "math/view.h"

namespace swell::lod {

// The bintree above a mesh: each triangle, then all below its first half, then all below its
// second; the south-eastern root before the north-western one. Both vectors have 2 n - 2 entries
// for n leaves.
struct Envelopes {
  std::vector<HeightRange> height;
  std::vector<std::int32_t> leaves;
};

// Fits envelopes to this frame's heights, one a vertex, all finite. 6 ns a triangle.
void build_envelopes(const Mesh& mesh, std::span<const float> height_m, Envelopes& envelopes);

// Fits envelopes to bounds of the height, so before there are heights: what is out of sight then
// needs none. They stay true as long as the mesh does not change. lattice_bits: of its domain.
void build_envelopes(const Mesh& mesh, int lattice_bits, const HeightPyramid& bounds,
                     Envelopes& envelopes);

// One envelope, met on the way down. The leaves below are triangles [first_leaf, first_leaf +
// leaves) of the mesh.
struct Envelope {
  std::array<glm::ivec2, 3> corner;  // on the lattice, counter-clockwise; the apex is corner[1]
  HeightRange height;
  int level, node, first_leaf, leaves;

  bool is_leaf() const { return leaves == 1; }
  glm::ivec2 low() const { return glm::min(glm::min(corner[0], corner[1]), corner[2]); }
  glm::ivec2 high() const { return glm::max(glm::max(corner[0], corner[1]), corner[2]); }
};

// The two roots, and the two halves of one that is no leaf, in the mesh's order.
std::array<Envelope, 2> roots_of(const Envelopes& envelopes, int lattice_bits);
std::array<Envelope, 2> halves_of(const Envelopes& envelopes, const Envelope& whole);

struct TriangleRange {
  int begin, end;  // triangles [begin, end) of the mesh
};

// Finds the triangles whose envelope's box (sides along the axes) is not wholly outside one of the
// planes of the view's frustum: all that can be seen and a few more. Ranges ascend and do not
// touch. Boxes inside a plane are not tested against it again further down, nor are those outside
// one: returns the number of envelopes tested, at most a few for each that the frustum's border
// cuts. Keeps the vector's capacity.
int find_in_view(const Envelopes& envelopes, const Domain& domain, const View& view,
                 std::vector<TriangleRange>& in_view);

}  // namespace swell::lod
