// The shape of the sea at time t: spectrum waves made by inverse FFT on periodic patches, plus
// explicit sine waves. z = H(x, y, t) is a height field; mean level 0, z up, metres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "math/parallel.h"

namespace swell::ocean {

// One explicit wave: A sin(k . x - 2 pi t / T + phase).
struct SineWave {
  double amplitude_m = 0.0;
  double wavelength_m = 1.0;
  double to_rad = 0.0;      // direction of travel, clockwise from north
  double phase_rad = 0.0;
  double period_s = 0.0;    // 0: from deep-water dispersion, omega^2 = g k
};

struct SeaDescription {
  // Pierson-Moskowitz x Hasselmann spectrum; no spectrum waves if wind_speed_mps == 0.
  bool spectrum = true;
  double wind_speed_mps = 15.0;   // U10, at 10 m height, [0, 60]
  double wind_from_rad = 0.0;     // where the wind comes FROM, clockwise from north
  double amplitude_scale = 1.0;   // multiplies all spectrum heights, [0, 4]
  double gravity_mps2 = 9.81;
  std::uint64_t seed = 1;
  int resolution = 128;           // FFT points per side, power of two in [16, 512]
  // Patch lengths, longest first. Each patch holds the waves that the next longer one is too
  // coarse for: bands of wave numbers do not overlap.
  std::vector<double> patch_lengths_m = {640.0, 97.0, 17.0};
  std::vector<SineWave> sines;
};

// One patch at one time: row-major resolution x resolution samples, sample (i, j) at world
// x = i L / n, y = j L / n, periodic.
struct PatchFrame {
  double length_m = 0.0;
  int resolution = 0;
  std::vector<float> height_m, slope_x, slope_y;  // slope = dH/dx, dH/dy from the same spectrum
  // Mean square slope (both axes together) of the waves in the patch: a constant of the sea state.
  float slope_variance = 0.0f;
};

// A sine wave at one time, for SIMD evaluation: amplitude sin(2 pi (cycles_per_m . x + cycles)).
struct SineFrame {
  glm::dvec2 cycles_per_m{0.0};
  double cycles = 0.0;  // in [0, 1)
  double amplitude_m = 0.0;
};

struct SeaFrame {
  double t_s = 0.0;
  std::vector<PatchFrame> patches;
  std::vector<SineFrame> sines;
};

// A sea state, built once and then read-only.
class Sea {
 public:
  // Throws std::invalid_argument naming the value and its allowed range.
  explicit Sea(const SeaDescription& description);
  ~Sea();
  Sea(Sea&&) noexcept;
  Sea& operator=(Sea&&) noexcept;

  const SeaDescription& description() const;

  // A bound on |H| that holds everywhere and always in practice (6 standard deviations of the
  // spectrum plus the sum of the sines' amplitudes).
  double height_bound_m() const;

  // 4 sqrt(m0) of the waves the patches can hold, sines included.
  double significant_height_m() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

// Fills `frame` with the sea at time t_s (any double; the result depends on nothing else).
void advance(const Sea& sea, double t_s, SeaFrame& frame, Workers& workers);

// Heights at world points, from the frame's patches (bilinear between samples) and sines.
// p_world and height_m have the same length and do not overlap.
void sample_heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m);

}  // namespace swell::ocean
