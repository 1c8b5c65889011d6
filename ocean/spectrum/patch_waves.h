// The spectrum waves of one periodic patch: random amplitudes, made once, and their turning in
// time.
//
// The patch's height at x and t is the sum over wave vectors k of h(k, t) e^(i k . x), with
//   h(k, t) = a(k) e^(-i omega t) + conj(a(-k)) e^(i omega t),
// where a(k) belongs to the wave that travels TOWARDS k. (With h0(k) = conj(a(-k)) this is the
// usual h0(k) e^(i omega t) + conj(h0(-k)) e^(-i omega t).) h(-k) = conj h(k) bit for bit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/spectrum.h"

namespace swell::ocean {

// FFT index i in [0, size) as a signed wave count per patch, in [-size/2, size/2).
inline int wave_count(int i, int size) { return i < size / 2 ? i : i - size; }

// The wave vector in rad/m of FFT index (i, j): the one place that knows it.
glm::dvec2 wave_vector(int i, int j, int size, double length_m);

// Where index (i, j) lies in the arrays of PatchWaves: batch by batch, 16 columns of all rows.
inline std::size_t wave_position(int i, int j, int size) {
  const int batch = i / kFftBatch;
  return static_cast<std::size_t>((batch * size + j) * kFftBatch + i % kFftBatch);
}

// Wave numbers in [low, high).
struct WaveBand {
  double low_rad_m = 0.0;
  double high_rad_m = 0.0;
};

struct PatchWaves {
  double length_m = 0.0;
  int size = 0;
  int reach = 0;                // every wave has |wave count| <= reach on both axes
  double variance_m2 = 0.0;     // of the height, mean over time and place
  double variance_k_m = 0.0;    // the same, each wave's times its wave number
  double slope_variance = 0.0;  // of both slopes together
  // h(k, t) = (cos_re c + sin_re s) + i (cos_im c + sin_im s), c + i s = e^(i omega t).
  // In the order of wave_position. DC and the Nyquist row and column are zero.
  std::vector<float> cos_re, sin_re, cos_im, sin_im;
  std::vector<double> turns_per_s;  // omega / (2 pi)
  std::vector<float> k_rad_m;       // one component of the wave vector by FFT index
};

// Draws the waves of `band` on a patch: complex Gaussian amplitudes, E|a(k)|^2 = 1/2 of the
// integral of amplitude_scale^2 S, of all systems, over the part of k's grid cell inside the band.
// The numbers depend on (seed, patch, signed wave counts) alone: a finer grid keeps the long waves.
// At least one system, all of the same gravity.
PatchWaves make_patch_waves(std::span<const WaveSystem> systems, WaveBand band, double length_m,
                            int size, double amplitude_scale, std::uint64_t seed, int patch);

// The farthest count of waves of one patch or two.
inline int reach_of(const PatchWaves& a, const PatchWaves* b) {
  return b == nullptr ? a.reach : std::max(a.reach, b->reach);
}

// Write columns [column0, column0 + 16) of h(k, t) as a batch for inverse_fft_batch; false and
// nothing written if there are no waves in them.
//
// Heights: h_a + i h_b (h_a alone if b is null), so that the transform's real and imaginary parts
// are the two patches' heights. Slopes: i k_x h + i (i k_y h), so that they are dH/dx and dH/dy.
bool fill_heights(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                  int column0, float* re, float* im);
bool fill_slopes(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
                 float* im);

// Displacements i (k_x + i k_y) / |k| h: how far, along x and y, linear waves of deep water move
// the water of the surface away from where it rests.
bool fill_displacements(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0,
                        float* re, float* im);

// Write the water's velocity at the surface likewise, by linear theory of deep water. With the rate
// h' = dh/dt: rising h'_a + i h'_b, as for heights; drift i (k_x + i k_y) / |k| h', the horizontal
// velocities along x and y.
bool fill_rising(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                 int column0, float* re, float* im);
bool fill_drift(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
                float* im);

}  // namespace swell::ocean
