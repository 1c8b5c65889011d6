// swell-bench lod --figures: the original paper's figures of triangulations, drawn by the
// triangulation code itself.
// Source: Elykov et al., 2000.
#pragma once

#include <string>
#include <vector>

namespace swell::apps {

// Two triangulations of one square, side by side as SVG.
struct LodFigure {
  std::string file;  // "lod_grid_9x9.svg"
  int left_triangles = 0, right_triangles = 0;
  int deepest_level = 0;  // of both sides
  std::string svg;
};

// 1. The uniform grid of 9 x 9 points, each square in four triangles, and its simplification for
//    an eye over the lower left corner.
// 2. A triangulation, and what one forced split makes of it: ten triangles more.
// 3. Two base neighbours, and the four triangles that their split makes, which a merge takes back.
std::vector<LodFigure> lod_figures();

}  // namespace swell::apps
