// What a Sea keeps: tables made once from its description.
#pragma once

#include <vector>

#include "ocean/open_sea/crests.h"
#include "ocean/open_sea/map_waves.h"
#include "ocean/open_sea/sea.h"
#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/patch_waves.h"

namespace swell::ocean {

// A sine wave ready to be put at a time: frequency besides SineFrame's numbers at t = 0.
struct SineTrain {
  SineFrame at_start;
  double turns_per_s = 0.0;
  // The water's speed along the wave at its crest, in terms of the rate of the heights.
  double drift = 1.0;
};

struct Sea::State {
  SeaDescription description;
  FftPlan plan;
  std::vector<PatchWaves> patches;
  std::vector<Crests> crests;  // one a patch
  std::vector<MapWaves> maps;
  std::vector<SineTrain> sines;
  double spectrum_variance_m2 = 0.0;

  // Bounds |H| of the patches from `first_patch` on together; maps count on behind the patches.
  double height_bound_m(std::size_t first_patch) const;
};

// How a patch covers the sea.
PatchTiling tiling_of_patch(const SeaDescription& sea, std::size_t patch);

// The time that the waves are put at instead of t_s (finite): in [0, loop_s] of the loop, or of a
// size whose products with frequencies stay finite.
double wave_time_s(const SeaDescription& sea, double t_s);

// The frequency nearest to turns_per_s > 0 with a whole number of turns, at least 1, in a loop; the
// same without one (0).
double looping_frequency(double turns_per_s, double loop_s);

}  // namespace swell::ocean
