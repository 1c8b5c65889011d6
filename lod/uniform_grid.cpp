#include "lod/uniform_grid.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"

namespace swell::lod {

void write_uniform_grid(const Domain& domain, glm::dvec2 low, glm::dvec2 high, int triangle_budget,
                        Mesh& mesh) {
  const glm::dvec2 size = high - low;
  SWELL_CHECK(size.x > 0.0 && size.y > 0.0, "size=({}, {})", size.x, size.y);
  SWELL_CHECK(triangle_budget >= 2, "triangle_budget={}", triangle_budget);
  const int cells = triangle_budget / 2;
  const int nx = std::clamp(static_cast<int>(std::sqrt(cells * size.x / size.y)), 1, cells);
  const int ny = cells / nx;

  const double steps_per_m = std::ldexp(1.0 / domain.size_m, domain.lattice_bits);
  const glm::dvec2 corner = (low - domain.min_world) * steps_per_m;
  const glm::dvec2 cell = size * steps_per_m / glm::dvec2(nx, ny);
  mesh = {};
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      mesh.lattice.emplace_back(static_cast<int>(std::nearbyint(corner.x + i * cell.x)),
                                static_cast<int>(std::nearbyint(corner.y + j * cell.y)));
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const auto v = static_cast<std::uint32_t>(j * (nx + 1) + i);
      const std::uint32_t above = v + static_cast<std::uint32_t>(nx) + 1;
      for (const std::uint32_t k : {v, v + 1, above + 1, above + 1, above, v})
        mesh.indices.push_back(k);
    }
  }
  mesh.level.assign(mesh.indices.size() / 3, 0);
}

}  // namespace swell::lod
