// A small sea that repeats itself in space and in time, frame by frame: short waves before the wind
// for sequences of bump images.
#pragma once

#include <cstdint>
#include <vector>

#include "math/parallel.h"

namespace swell::ocean {

struct SmallSea {
  int size = 256;              // samples a side, a power of two in [128, 512]
  double length_m = 6.0;       // period along both axes
  double loop_s = 4.0;         // after which the waves are the same
  int frames = 128;            // in a loop, at least 2
  double wind_from_rad = 0.0;  // clockwise from north
  double gravity_mps2 = 9.81;
  std::uint64_t seed = 1;
};

// Lengths of its waves: a quarter of the period to a fortieth.
inline constexpr int kLeastSmallWaves = 4, kMostSmallWaves = 40;

// A wave of the sea: height = amplitude cos(2 pi (i x + j y - cycles t + phase)), x and y [1] in
// periods, t [1] in loops.
struct SmallWave {
  int i = 0, j = 0, cycles = 1;
  double amplitude = 0.0, phase = 0.0;
};

// Returns the sea's waves. Each octave of lengths is as steep as another. None runs against the
// wind; one that runs with it is twice as high as one across it. A wave takes the whole number of
// cycles a loop that is nearest to its own, of gravity and surface tension (0.0728 N/m over
// 1000 kg/m^3), but at least 1 and at most a tenth of the frames, so that frames can be blended.
std::vector<SmallWave> small_sea_waves(const SmallSea& sea);

// Heights of each frame [arbitrary unit], size * size values, row by row from the south.
std::vector<std::vector<float>> small_sea_heights(const SmallSea& sea, Workers& workers);

}  // namespace swell::ocean
