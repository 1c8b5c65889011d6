// The radial grid: rings around the point below the eye, their radii growing with the fourth power
// of their number, cut into columns of equal angle. The alternative to ROAM that needs no tree.
//
//   r_i = a0 + a1 i^4, i in [0, N), r_0 = 0.1 m, r_(N-1) = 40 km; angles 2 pi j / M
//
// An eye higher than 90 m sees further on the round earth: the last ring then lies beyond its
// horizon, and the first grows with the domain, whose steps do.
//
// Only the columns that the view can see are made, and a fan closes the hole in the middle. Rings
// between r_0 and 2 r_0 are left out: a million triangles would have a hundred there. N and M
// follow from the budget and from the share of the turn in view, so that cells are as wide as deep
// at 100 m. Turning about the vertical moves no vertex; moving the eye moves all of them, so
// waves that the grid is too coarse for swim, which ROAM's do not.
//
// Source: Gabdrakhmanov, Modelling Interactive Water Surfaces.
#pragma once

#include "lod/roam.h"

namespace swell::lod {

inline constexpr double kRadialFirst_m = 0.1, kRadialLast_m = 40000.0;

// A square of 2^30 steps around the eye, its corner at whole metres, so that a vertex's place in
// the world is exact: of 131 km, steps of 2^-13 m, up to 230 m; twice as large as often as the
// horizon takes, up to 2097 km.
Domain radial_domain(const View& view);

struct RadialLayout {
  double first_m = kRadialFirst_m, last_m = kRadialLast_m;  // r_0 and r_(N-1)
  int rings = 0;                                            // N
  int first_ring = 1;                                       // number of the ring after ring 0
  int columns = 0;                                          // M, of the whole turn
  int first_column = 0;  // in [0, M): the first in view, counter-clockwise from east
  int columns_seen = 0;  // at most M

  int rings_kept() const { return rings - first_ring + 1; }
  int triangles() const { return columns_seen * (2 * rings_kept() - 1); }
};

// Rings and columns for a view and a budget of at least kRadialLeastBudget, which is not exceeded.
inline constexpr int kRadialLeastBudget = 64;
RadialLayout radial_layout(const View& view, int triangle_budget);

// Writes the mesh, on the lattice of radial_domain(view); vectors keep their capacity, which is
// enough for the whole budget. `level` counts halvings of the distance, two a halving, as ROAM's
// levels do. Columns follow each other, from near to far. The eye is finite. A budget below
// kRadialLeastBudget (and at least 2) makes the plane of two triangles. 2 ns a triangle.
AdaptStatistics write_radial_grid(const View& view, int triangle_budget, Mesh& mesh);

}  // namespace swell::lod
