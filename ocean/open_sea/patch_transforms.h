// The inverse transforms that make fields of samples from a sea's waves: one for two fields of a
// patch, one for a third field of two patches, one for two more fields of a patch that has them.
#pragma once

#include <span>
#include <vector>

#include "math/parallel.h"
#include "ocean/open_sea/sea_state.h"

namespace swell::ocean {

// What the waves are filled in by (ocean/spectrum/patch_waves.h): as both fields of one patch, and
// as the third field of one patch or two.
struct PatchFills {
  bool (*both)(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
               float* im);
  bool (*third)(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                int column0, float* re, float* im);
};

// Where a patch's fields go, resolution x resolution samples each. Displacements are null where
// they are not wanted.
struct PatchFields {
  float *first = nullptr, *second = nullptr, *third = nullptr;
  float *displacement_x = nullptr, *displacement_y = nullptr;
};

// Transforms all of the sea's patches at time t_s (wave_time_s()); fields has one element a patch,
// at most kMaxPatches. `planes` is working storage, kept from call to call.
void transform_patches(const Sea::State& state, double t_s, const PatchFills& fills,
                       std::span<const PatchFields> fields, std::vector<float>& planes,
                       Workers& workers);

}  // namespace swell::ocean
