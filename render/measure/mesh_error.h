// How far a mesh of the sea is from the sea itself, in pixels of a view: what triangles cut off.
//
// The measure is made of two parts. Height: every few pixels, where the pixel's ray meets the mean
// level, the mesh's height against the surface's, both projected. Silhouette: in every column of
// pixels, the topmost edge of the mesh against the topmost point of the surface, which is looked
// for along fine rays over the ground. Neither looks at the other's triangles.
#pragma once

#include <span>
#include <vector>

#include "lod/roam.h"
#include "math/parallel.h"
#include "math/view.h"
#include "ocean/water_surface.h"

namespace swell::render {

// The sea in a view.
struct SeaReference {
  View view;
  std::vector<glm::ivec2> pixel;     // the places of the height measure: their pixels,
  std::vector<glm::dvec2> p_world;   // places on the mean level
  std::vector<float> height_m;       // and heights of the surface
  std::vector<double> horizon_y_px;  // per column: the topmost of the surface and the horizon
  std::vector<double> flat_y_px;     // the horizon, infinitely far
};

// Looks at places of every pixel_step-th pixel of each row and column that lie inside `area`, and
// at the surface from 1 m to 32 km in steps of 1/1000 of the distance, at least 0.25 m. The eye is
// above the mean level and the view's right is level. About 1 s a thread for 1280 x 720.
SeaReference look_at_sea(const View& view, const ocean::WaterSurface& surface,
                         const ocean::SeaArea& area, int pixel_step, Workers& workers);

struct MeshError {
  std::vector<double> height_px;      // one each place of the reference that the mesh holds
  std::vector<double> silhouette_px;  // one each column; behind the mesh lies the horizon
};

// `height_m` holds one height for each vertex of the mesh on the domain's lattice.
MeshError measure_mesh_error(const SeaReference& sea, const lod::Domain& domain,
                             const lod::Mesh& mesh, std::span<const float> height_m,
                             Workers& workers);

}  // namespace swell::render
