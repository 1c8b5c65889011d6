#include <array>
#include <vector>

#include "math/check.h"
#include "math/with_ieee.h"
#include "ocean/below_frame.h"
#include "ocean/water_surface.h"

namespace swell::ocean {
namespace {

// The parts of triangles that are under water, as triangles; the water as heights of the corners
// over the surface.
class WetTriangles {
 public:
  void add(const std::array<glm::dvec3, 3>& corner, const std::array<double, 3>& above_m) {
    // Round the triangle: the corners that are under water, and where edges pass the surface.
    std::array<glm::dvec3, 4> ring;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      if (above_m[i] <= 0.0) ring[count++] = corner[i];
      if ((above_m[i] <= 0.0) == (above_m[next] <= 0.0)) continue;
      const double part = above_m[i] / (above_m[i] - above_m[next]);
      ring[count++] = corner[i] + part * (corner[next] - corner[i]);
    }
    for (std::size_t i = 2; i < count; ++i) add_triangle(ring[0], ring[i - 1], ring[i]);
  }

  // The middles of their edges, three a triangle: the mean over them is exact for polynomials of
  // degree 2.
  const std::vector<glm::dvec3>& middles() const { return middles_; }
  // Of a triangle, outwards; its length is the area [m2].
  glm::dvec3 area(std::size_t triangle) const { return areas_[triangle]; }

 private:
  void add_triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    areas_.push_back(0.5 * glm::cross(b - a, c - a));
    for (const glm::dvec3& middle : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
      middles_.push_back(middle);
  }

  std::vector<glm::dvec3> middles_, areas_;
};

WetTriangles cut_hull(const HullMesh& hull, std::span<const double> above_m) {
  WetTriangles wet;
  for (const glm::uvec3& triangle : hull.triangles) {
    std::array<glm::dvec3, 3> corner;
    std::array<double, 3> above;
    for (int i = 0; i < 3; ++i) {
      SWELL_CHECK(triangle[i] < hull.p_world.size(), "corner {} of {}", triangle[i],
                  hull.p_world.size());
      corner[static_cast<std::size_t>(i)] = hull.p_world[triangle[i]];
      above[static_cast<std::size_t>(i)] = above_m[triangle[i]];
    }
    wet.add(corner, above);
  }
  return wet;
}

void press(double pressure_pa, glm::dvec3 arm_m, glm::dvec3 area_m2, Load& load) {
  const glm::dvec3 force_n = -pressure_pa * area_m2;
  load.force_n += force_n;
  load.moment_nm += glm::cross(arm_m, force_n);
}

}  // namespace

HullLoads WaterSurface::hull_loads(const HullMesh& hull, glm::dvec3 about, double density_kg_m3,
                                   BelowFrame& below, Workers& workers) const {
  const ScopedFloatEnvironment ieee;
  find_columns(hull.p_world, below, workers);
  std::vector<double> above_m(hull.p_world.size());
  for (std::size_t i = 0; i < above_m.size(); ++i)
    above_m[i] = hull.p_world[i].z - static_cast<double>(below.column[i].surface_m);
  const WetTriangles wet = cut_hull(hull, above_m);
  const std::vector<glm::dvec3>& middles = wet.middles();
  std::vector<WaterMotion> motion(middles.size());
  nearest_motions(middles, {false, false, true}, density_kg_m3, below, workers, motion);
  const double pa_m = density_kg_m3 * water_.parts().sea->description().gravity_mps2;
  HullLoads loads;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const glm::dvec3 area_m2 = wet.area(i / 3) / 3.0, arm_m = middles[i] - about;
    const double still_m = static_cast<double>(below.column[i].level_m) - middles[i].z;
    press(pa_m * still_m, arm_m, area_m2, loads.buoyancy);
    press(static_cast<double>(motion[i].pressure_pa), arm_m, area_m2, loads.froude_krylov);
  }
  return loads;
}

}  // namespace swell::ocean
