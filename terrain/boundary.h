// The water boundary as a picture, to be looked at, painted over and read again in place of the map
// that is made from the heights.
//
// An EXR file, square, north on top, over the terrain's square with its apron, with four channels:
//   R  the distance to the still water line [m], positive in the sea, negative on land
//   G  the depth of the sea [m], 0 on land
//   B  the height of the bank [m], 0 in the sea
//   A  the part of surf fronts that run in there, 0 to 1; 1 where a map is made from heights
// Source: Gabdrakhmanov, Modelling Interactive Water Surfaces: one
// texture of depths and banks drives shore, normals of banks, surf, caustics and trees.
#pragma once

#include <filesystem>

#include "terrain/shore_map.h"
#include "texture/image/image.h"

namespace swell::terrain {

// The picture of a map: as many pixels as points, as floats, so that what is read again has the
// same bits.
texture::ImageF boundary_image(const ShoreMap& shore);

// The map of a picture of any size, 2 to kShoreMapCells + 1 a side, over the square of `land` with
// its apron. Throws TerrainError (terrain/terrain.h) or texture::FileError.
ShoreMap read_boundary(const std::filesystem::path& path, const HeightGrid& land);

// The ground of a boundary over the square of `land`: the height of the bank, minus the depth. It
// is bilinear between the boundary's points, and has as many samples as the finer of the two. The
// apron is left to the caller.
HeightGrid ground_of_boundary(const ShoreMap& boundary, const HeightGrid& land);

// The normals of a boundary's banks and floor as a picture of as many pixels: red, green and blue
// are the unit normal's east, north and up, from -1 to 1.
texture::Image8 bank_normals(const ShoreMap& boundary);

}  // namespace swell::terrain
