// ROAM: a triangle bintree that follows the camera with a fixed number of triangles.
// Source: Duchaineau et al., ROAMing Terrain, 1997; Elykov et al., 2000 (Algorithms I and II).
//
// The domain is a square of world size size_m, split by 2 root triangles; vertices lie on an
// integer lattice of (2^lattice_bits + 1)^2 points. The triangulation knows positions in the
// plane only, plus bounds of the height: waves move the vertices later.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "math/view.h"

namespace swell::lod {

struct Domain {
  glm::dvec2 min_world{0.0};  // lower left corner
  double size_m = 1.0;
  int lattice_bits = 10;  // [1, 20]; the deepest triangles have legs of size_m / 2^lattice_bits
};

// Formulas, and why a child never has more than its parents: lod/priority.h.
enum class Priority : std::uint8_t {
  kProjectedSize,    // bound of the triangle's size over its nearest distance (default)
  kInverseDistance,  // the paper's base variant: the nearest part to the last level first
};

struct AdaptRequest {
  View view;
  int triangle_budget = 10000;  // >= 2; never exceeded
  Priority priority = Priority::kProjectedSize;
  float min_height_m = 0.0f, max_height_m = 0.0f;  // of all the surface, at all times
  // Triangles outside the frustum, widened by this angle's tangent, get priority 0.
  float frustum_margin = 0.0f;
};

struct AdaptStatistics {
  int triangles = 0, splits = 0, merges = 0;
  bool operation_cap_hit = false;  // must never be true; tests require it
};

// The triangulation as an indexed mesh. Order of vertices and triangles depends on the
// triangulation alone, not on how it was reached.
struct Mesh {
  std::vector<glm::ivec2> lattice;     // per vertex, in [0, 2^lattice_bits]^2
  std::vector<std::uint32_t> indices;  // 3 per triangle, counter-clockwise seen from +z
  std::vector<std::uint8_t> level;     // per triangle: depth in the bintree
};

class Roam {
 public:
  // Storage for max_triangles leaves is allocated here, once.
  Roam(const Domain& domain, int max_triangles);
  ~Roam();
  Roam(Roam&&) noexcept;
  Roam& operator=(Roam&&) noexcept;

  const Domain& domain() const;

  // Algorithm II: changes the last triangulation until it fits the request. The result depends on
  // the request alone: it is bit for bit what rebuild() makes.
  AdaptStatistics adapt(const AdaptRequest& request);

  // Algorithm I: the same from the two root triangles.
  AdaptStatistics rebuild(const AdaptRequest& request);

  // Moves the domain's corner (an endless sea follows the camera). The triangulation stays in its
  // place in the domain, so the next adapt is cheap if the eye keeps its place there too.
  void set_origin(glm::dvec2 min_world);

  // Writes the mesh; vectors keep their capacity. Neighbours in the list share an edge. Uses
  // scratch in the tree: not two calls at a time on one Roam.
  void extract_mesh(Mesh& mesh) const;

  struct Tree;
  const Tree& tree() const { return *tree_; }  // for tests and queries

 private:
  std::unique_ptr<Tree> tree_;
};

}  // namespace swell::lod
