// One step of the open sea's foam, for those who make it and those who try its thresholds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ocean/open_sea/whitecaps.h"

namespace swell::ocean {

// Foam is whole where B is this many standard deviations over its threshold.
inline constexpr double kFullExcess = 2.0;
inline constexpr int kFullCode = 255;

// After so many steps nothing is left of foam.
inline int steps_of_life(const FoamPatch& patch) {
  return (kFullCode + patch.decay - 1) / patch.decay;
}

// B of one patch or two at a step, a square of the plan's size each. `waves` are as long as the
// plan; the second of `breaking` is not touched for one patch.
void break_waves(const Whitecaps& whitecaps, const FftPlan& plan,
                 std::span<const PatchWaves* const> waves, double step,
                 const std::array<std::span<float>, kMostFoamPatches>& breaking,
                 std::vector<float>& planes, Workers& workers);

// Foam one step later: `codes` is F_(m-1) and becomes F_m. `breaking` is as long.
void age_foam(std::span<const float> breaking, float threshold, int decay,
              std::span<std::uint8_t> codes);

}  // namespace swell::ocean
