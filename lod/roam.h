// ROAM: a triangle bintree that follows the camera with a fixed number of triangles.
// Source: Duchaineau et al., ROAMing Terrain, 1997; Elykov et al., 2000 (Algorithms I and II).
//
// The domain is a square of world size size_m, split by 2 root triangles; vertices lie on an
// integer lattice of (2^lattice_bits + 1)^2 points. The triangulation knows positions in the
// plane only, plus bounds of the height: waves move the vertices later.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "lod/request.h"
#include "math/lattice.h"

namespace swell::lod {

struct Domain {
  glm::dvec2 min_world{0.0};  // lower left corner
  double size_m = 1.0;
  int lattice_bits = 10;  // [1, 24]; the deepest triangles have legs of step_m()

  double step_m() const { return size_m / static_cast<double>(1 << lattice_bits); }
  glm::dvec2 point(glm::ivec2 p) const { return lattice_point(min_world, step_m(), glm::dvec2(p)); }
};

struct AdaptStatistics {
  int triangles = 0, splits = 0, merges = 0;
  bool anew = false;               // from the two root triangles
  bool stopped = false;            // at one of the request's limits, with work left
  bool operation_cap_hit = false;  // must never be true; tests require it
  // Out to here, in metres from the eye, > 0, no triangle in view is wider than the request's
  // largest_size_m; beyond, their vertices lie too far apart to follow a wave.
  double reach_m = std::numeric_limits<double>::infinity();
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
  // the request alone, if that has no limits: it is bit for bit what rebuild() makes.
  AdaptStatistics adapt(const AdaptRequest& request);

  // Algorithm I: the same from the two root triangles.
  AdaptStatistics rebuild(const AdaptRequest& request);

  // Moves the domain's corner (an endless sea follows the camera). The triangulation stays in its
  // place in the domain, so the next adapt is cheap if the eye keeps its place there too.
  void set_origin(glm::dvec2 min_world);

  // Goes to another domain, in the same storage. If more than its corner differs, the next adapt
  // starts from the two root triangles.
  void set_domain(const Domain& domain);

  // Writes the mesh; vectors keep their capacity. Neighbours in the list share an edge. Uses
  // scratch in the tree: not two calls at a time on one Roam.
  void extract_mesh(Mesh& mesh) const;

  // Writes the mesh only if the triangulation has changed in its domain since `revision` was set by
  // the call that wrote `mesh`. 0: it writes; set this after another Roam, or something else, wrote
  // the mesh.
  void update_mesh(Mesh& mesh, std::uint64_t& revision) const;

  struct Tree;
  const Tree& tree() const { return *tree_; }  // for tests and queries

 private:
  std::unique_ptr<Tree> tree_;
};

}  // namespace swell::lod
