// The passes that fill a CloudPicture, row by row of its nodes.
#pragma once

#include "render/tile/cloud_picture.h"

namespace swell::render {

// Every second node of rows j and j + 2, j a multiple of 4.
void write_coarse_clouds(const Shading& shading, const VolumeClouds& clouds, int j,
                         CloudPicture& picture);

// The nodes of rows j and j + 1, j even, that are not coarse: between coarse nodes that show about
// the same they are interpolated, elsewhere they have rays of their own.
void write_fine_clouds(const Shading& shading, const VolumeClouds& clouds, int j,
                       CloudPicture& picture);

}  // namespace swell::render
