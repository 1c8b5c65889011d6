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
inline constexpr double kBirthsAhead_rad = 0.6;  // B leads the crests by this phase

// After so many steps nothing is left of foam.
inline int steps_of_life(const FoamPatch& patch) {
  return (kFullCode + patch.decay - 1) / patch.decay;
}

// The time of a step, in a sea that repeats within its loop.
double time_of_step(const Whitecaps& whitecaps, double step);

// C of trains at t_s, at points of these phases: of the first train those of all points, then of
// the next, 2^-16 cycles.
void add_crests(const TrainSquare& trains, std::span<const std::uint16_t> phase, double t_s,
                std::span<float> c);

// Foam of trains one step later: `codes` of the square become those of `step`. `breaking` is the
// first patch's B then.
void age_train_foam(const Whitecaps& whitecaps, double step, std::span<const float> breaking,
                    std::span<std::uint8_t> codes, Workers& workers);

// The foam of such codes, in foam_of_trains()'s unit: at each point the binomial mean of nine,
// since points lie metres apart, and one alone would be seen as a square.
void smooth_train_foam(std::span<const std::uint8_t> codes, std::span<std::uint16_t> foam,
                       Workers& workers);

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
