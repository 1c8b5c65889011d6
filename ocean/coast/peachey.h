// Waves that know the sea floor: z = sum of A_i(x, y) w_i(theta_i(x, y) - t / T_i) over a few wave
// trains, with heights and slopes anywhere, at any time.
//
// Source: Peachey, Modeling Waves and Surf, SIGGRAPH 1986, as restated by Elykov, Belago,
// Kuzikovsky, Nekrasov, 2000.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "math/smoothstep.h"
#include "ocean/coast/wave_phase.h"
#include "ocean/spectrum/spectrum.h"
#include "terrain/sea_floor.h"

namespace swell::ocean {

inline constexpr int kMaxTrains = 16;

// Draws `count` (1 to kMaxTrains) trains from the wind's spectrum: the frequencies between
// kBandBegin and kBandEnd of the energy (0.75 to 1.86 times the peak's) and the directions are cut
// into `count` bins of equal energy, and each train takes one place in one bin of either, so that
// all have the same amplitude and sum A^2 / 2 is exactly the band's part of m0. The same seed gives
// the same trains. A wind of 0 gives trains without height.
inline constexpr double kBandBegin = 0.02, kBandEnd = 0.9;
std::vector<WaveTrain> make_trains(const WaveSystem& system, int count, std::uint64_t seed);

// Draws trains from several systems, at least one: each has a train or more, the more the higher it
// is. count is at least their number.
std::vector<WaveTrain> make_trains(std::span<const WaveSystem> systems, int count,
                                   std::uint64_t seed);

// The depths where a train's profile begins to change from deep water's into the shore's, a quarter
// of the local wavelength, and has become it, a twentieth. deep_length_m is g T^2 / (2 pi).
struct ProfileDepths {
  double deep_m, shallow_m;
};
ProfileDepths profile_depths(double deep_length_m);

// Part of the shore's profile in the wave's: 0 from deep_m down, 1 from shallow_m up, smooth
// between. The quotient is one of T, float or double.
template <class T>
double shore_part(T depth_m, T deep_m, T shallow_m) {
  return smoothstep(0.0, 1.0, static_cast<double>((deep_m - depth_m) / (deep_m - shallow_m)));
}

// Trains over a sea floor, ready to be sampled; read-only after it is made. 32 bytes a train and 16
// more for each cell between four samples.
struct TrainSea {
  terrain::Grid grid;  // the sea floor's
  int cells_x = 0, cells_y = 0;
  int trains = 0;
  // |z| and |grad z| are at most this on the grid, always.
  float height_bound_m = 0.0f, slope_bound = 0.0f;
  // By train.
  std::vector<double> period_s, gravity_mps2;
  std::vector<float> deep_depth_m, shallow_depth_m;  // where the profile's blend begins and ends
  // Bilinear coefficients v = c0 + c1 fx + c2 fy + c3 fx fy. By cell and train: theta in cycles
  // (c0 wrapped into [0, 1]), then the amplitude in metres, broken. By cell: the depth in metres.
  std::vector<float> waves, depth;
};

// Waves of all trains together are at most 0.78 of the depth high (see breaking_factor); on land
// there are none. Throws std::invalid_argument for a bad floor or train, or more than kMaxTrains.
// Each train's phase is worked out by one worker; about 0.2 microseconds a sample and train, and 45
// bytes while it is made. kept: by train, for the floor's samples, what land leaves of its height
// before it breaks (shelter_train()); empty: all of it.
TrainSea make_train_sea(const terrain::HeightGrid& floor, std::span<const WaveTrain> trains,
                        PhaseMethod method, Workers& workers,
                        std::span<const std::vector<float>> kept = {});

// Heights above mean sea level at time t_s (finite), and slopes dz/dx and dz/dy, at world points.
// All spans have the same length and do not overlap. The slopes are the heights' own derivative
// inside a cell (bilinear phase, amplitude and depth); at a cell's border they jump a little, and
// at a shallow-water crest, which is sharp, a lot. Beyond the grid each wave runs straight on from
// the border's cells. The profile is the paper's: w = cos(2 pi u) in deep water, 8 (u - 1/2)^2 - 1
// (mean -1/3) near the shore. May be called from many threads at once; allocates nothing. The same
// bits on every SIMD target.
void sample_trains(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                   std::span<float> height_m);
void sample_trains(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                   std::span<float> height_m, std::span<float> slope_x, std::span<float> slope_y);

}  // namespace swell::ocean
