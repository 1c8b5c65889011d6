#include "lod/plane.h"

namespace swell::lod {

void write_plane(const Domain& domain, Mesh& mesh) {
  const int n = 1 << domain.lattice_bits;
  mesh.lattice = {{0, 0}, {n, 0}, {n, n}, {0, n}};
  mesh.indices = {0, 1, 2, 2, 3, 0};
  mesh.level = {0, 0};
}

}  // namespace swell::lod
