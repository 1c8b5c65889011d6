// What the heights of a patch stay within at one time: not of the sea's spectrum but of the samples
// that are there.
#pragma once

#include "ocean/open_sea/sea.h"

namespace swell::ocean {

struct HeightBounds {
  double height_m = 0.0;  // |z|
  double slope = 0.0;     // in any direction
};

// Of sample_heights() of the patch alone. Where it is tiled the blend of two neighbours is within
// them always, that of the four around a corner in practice: all four would have to be near their
// highest at one place. 20 us for 128 x 128 samples.
HeightBounds bounds_of_patch(const PatchFrame& patch);

// Of the sines together.
HeightBounds bounds_of_sines(const SeaFrame& frame);

}  // namespace swell::ocean
