// Step 2 of a pass, for the few triangles that need it: homogeneous clipping.
//
// Source: Sutherland and Hodgman, Reentrant Polygon Clipping, 1974, one plane after the other in a
// fixed order. A new vertex is computed from its edge's two ends by a formula that is symmetric bit
// by bit, so both triangles at an edge, and both sides of a plane, get the same vertex.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/pass.h"

namespace swell::raster {

struct ClipVertex {
  glm::dvec4 p_clip;
  std::array<double, kClipDistances> user;
  int source = -1;  // which of the triangle's vertices this is; -1: made by a cut
};

// The vertex on the edge from a to b where the plane's signed distances da and db (of opposite
// sign, or one of them 0) would meet at 0. Swapping (a, da) with (b, db), or the sign of both
// distances, gives the same bits.
ClipVertex cut_edge(const ClipVertex& a, double da, const ClipVertex& b, double db);

struct ClipPolygon {
  static constexpr int kMaxVertices =
      3 + 7 + static_cast<int>(kClipDistances);  // a convex polygon gains at most one a plane
  std::array<ClipVertex, kMaxVertices> vertices;
  int count = 0;
};

// The part of a triangle inside near, far (z >= 0), w, user and guard-band planes; count is 0 if
// nothing is left. The result starts at the same vertex whichever way the triangle was rotated.
ClipPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, Viewport viewport);

}  // namespace swell::raster
