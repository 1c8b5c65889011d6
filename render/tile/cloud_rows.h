// The passes that fill a CloudPicture, row by row of its nodes.
#pragma once

#include "render/tile/cloud_picture.h"

namespace swell::render {

// Nodes of multiples of `spacing` in rows j to j + 3 spacing, j a multiple of 4 spacing; if those
// of multiples of 2 spacing are `known`, the others, whose rays begin where those met the first
// forms.
void write_coarse_clouds(const Shading& shading, const VolumeClouds& clouds, int j, int spacing,
                         bool known, CloudPicture& picture);

// Which cells of row j, odd, are even: for write_fine_clouds, which interpolates only in those.
void find_even_cells(int j, CloudPicture& picture);

// The nodes of rows j to j + 3, j a multiple of 4, that are not coarse: between coarse nodes (of
// multiples of 2) that show about the same they are interpolated, elsewhere they have rays of their
// own.
void write_fine_clouds(const Shading& shading, const VolumeClouds& clouds, int j,
                       CloudPicture& picture);

}  // namespace swell::render
