// What swell-bench lod says of triangulations: ROAM comes closest to the sea, and the paper's
// figures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "apps/bench/lod_comparison.h"
#include "tools/figures/lod_figures.h"

namespace swell::apps {
namespace {

// All draw the same sea, in the same view, from the same number of triangles at most.
TEST(Triangulations, RoamComesCloserToTheSeaThanTheGrids) {
  Workers workers(2);
  const Comparison comparison{.budgets = {1500, 10000, 50000},
                              .width_px = 640,
                              .height_px = 360,
                              .pixel_step = 3,
                              .timed_frames = 1};
  int compared = 0, silhouettes = 0;
  const std::vector<ComparisonRow> rows = compare_triangulations(comparison, workers);
  for (const ComparisonRow& row : rows) {
    EXPECT_LE(row.triangles, 50000);
    if (row.triangulation != "roam") continue;
    for (const ComparisonRow& other : rows) {
      const bool same_budget =
          std::abs(other.triangles - row.triangles) < row.triangles / 8 || other.triangles == 2;
      if (&other == &row || other.view != row.view || !same_budget) continue;
      SCOPED_TRACE(row.view + ", " + std::to_string(row.triangles) + " against " +
                   other.triangulation);
      EXPECT_LT(row.height_px.median, other.height_px.median);
      EXPECT_LT(row.height_px.p95, other.height_px.p95);
      EXPECT_LT(row.height_px.max, other.height_px.max);
      EXPECT_LE(row.silhouette_px.max, other.silhouette_px.max);
      if (other.silhouette_mean_px > 0.0) {  // from the bridge all draw the horizon as it is
        EXPECT_LT(row.silhouette_mean_px, other.silhouette_mean_px);
        ++silhouettes;
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 2 * 3 * 3) << "views, budgets, others";
  EXPECT_EQ(silhouettes, 3 * 3) << "from the boat";
}

TEST(LodFigures, SimplifyTheGridOfThePaper) {
  const LodFigure grid = lod_figures().at(0);
  EXPECT_EQ(grid.left_triangles, 256);
  EXPECT_LE(grid.right_triangles, 100);
  EXPECT_GE(grid.right_triangles, 97);
  EXPECT_EQ(grid.deepest_level, 7) << "nothing finer than the grid itself";
}

TEST(LodFigures, ForceTenTrianglesBySplittingOne) {
  const LodFigure forced = lod_figures().at(1);
  EXPECT_EQ(forced.right_triangles - forced.left_triangles, 10);
}

}  // namespace
}  // namespace swell::apps
