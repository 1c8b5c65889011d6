// swell-bench lod: how far each triangulation of one sea is from that sea, and what it costs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/shared/report.h"
#include "math/parallel.h"

namespace swell::apps {

struct ComparisonRow {
  std::string view, triangulation;
  int triangles = 0;
  Spread height_px{};      // over places of the sea that the view sees (render/mesh_error.h)
  Spread silhouette_px{};  // over columns of pixels
  double silhouette_mean_px = 0.0;
  double triangulate_ms = 0.0;  // a frame of a flight at 30 m/s; uniform: 0, made once
};

struct Comparison {
  std::vector<int> budgets = {1500, 10000, 50000};
  int width_px = 1280, height_px = 720;  // errors in pixels grow with the height
  int pixel_step = 4;                    // of the places where heights are compared
  int timed_frames = 31;
};

// A sea of 15 m/s wind on 3000 x 2000 m, from 10 m above the mean level and from 2.5 m above the
// waves; ROAM, radial and uniform grids of every budget, and the plane.
std::vector<ComparisonRow> compare_triangulations(const Comparison& comparison, Workers& workers);

std::string comparison_table(std::span<const ComparisonRow> rows);

}  // namespace swell::apps
