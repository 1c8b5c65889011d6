// Triangles that stand for an implicit surface where its exact shape does not show: in shadows,
// outlines before the sun, waterlines and picks.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/implicit_surface.h"
#include "shapes/mesh_file.h"

namespace swell::shapes {

// An implicit surface as a frame's tables of objects know it: eight corners of its box, and for
// each part a triangle without area, which holds its paint. Its pixels are found by rays.
struct DrawnImplicit {
  // The stand-in's vertices of a part that turns, or whose heights move.
  struct MovingVertices {
    std::uint32_t part, first, count;
  };

  scene::ImplicitSurface implicit;
  ObjectMesh mesh;
  std::vector<MovingVertices> moving;
};

// The implicit surface, with a level in its place of 192 triangles a part as it is at t = 0, more
// for parts with a table of heights, and for those whose middle is not in them. Parts that turn
// have no plan at the waterline.
MeshOfFile with_meshes(scene::ImplicitSurface implicit);

// The stand-in at t_s, but for its paint: its parts have turned and their heights moved. A border
// by a threshold stays. The storage of `posed` is used again.
void pose_stand_in(const MeshOfFile& shape, double t_s, ObjectMesh& posed);

}  // namespace swell::shapes
