// How far points lie from a surface of triangles.
#pragma once

#include <cstdint>
#include <span>

#include "shapes/flat_mesh.h"

namespace swell::mesh_import {

// The largest distance of vertices, by their numbers, from the nearest of the triangles, in units
// of the file; 0 if there are none of either. 1 to 5 us a vertex.
float farthest_from(std::span<const shapes::FlatVertex> vertices,
                    std::span<const std::uint32_t> numbers, std::span<const std::uint32_t> indices);

}  // namespace swell::mesh_import
