// The rows of a patch that ocean/open_sea/crests.h warps: for its own sources.
#pragma once

#include "ocean/open_sea/crests.h"

namespace swell::ocean {

// So many steps X <- x - c D(X), the first of them from X = x. Three leave an error of 7e-4
// standard deviations of the height where the mean square slope is 0.01.
inline constexpr int kWarpSteps = 3;

// Rows [first, last). First all of a patch's heights, displacements and the slopes that the waves
// have where they come from, then the slopes of the warped waves in place of these.
void warp_rows(const Crests& crests, const LinearWaves& linear, int first, int last,
               PatchFrame& patch);
void steepen_rows(const Crests& crests, int first, int last, PatchFrame& patch);

// Rows [first, last) of the velocities, from those of the linear waves: x, y, z, one after the
// other.
void move_rows(const Crests& crests, const PatchFrame& patch, const float* linear, int first,
               int last, const PatchVelocity& velocity);

}  // namespace swell::ocean
