// The waves of a periodic square of the surface, one Fourier mode at a time, and what they are
// further down: the decay of each mode by its own wave number (ocean/below/motion.h). Whatever the
// samples of the surface hold, crests made sharp, maps and wakes too, is carried down that way.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "math/parallel.h"
#include "ocean/below/motion.h"
#include "ocean/spectrum/fft.h"

namespace swell::ocean {

struct SurfaceModes {
  FftPlan plan;
  glm::dvec2 length_m{1.0};
  double gravity_mps2 = 9.81;
  float depth_m = 0.0f;     // of the water; 0: deep
  float mean_rad_m = 0.0f;  // the wave number that the mean over the square decays with
  // omega^2 by FFT index, row-major; empty: g k tanh kd.
  std::vector<float> omega2;
  // Of the velocities and the head at the surface, once transformed: conjugates of the modes times
  // the number of samples, row-major.
  struct Field {
    std::vector<float> re, im;
    bool is_made = false;
  };
  std::array<Field, kMotionFields> fields;
};

// The field of the surface from which `field` follows.
constexpr MotionField surface_field(MotionField field) {
  return field < kAccelerationX ? field : kHead;
}

// Transforms a field of surface samples, size x size, row-major: velocities or the head.
void find_modes(const std::vector<float>& samples, MotionField field, std::vector<float>& planes,
                SurfaceModes& modes, Workers& workers);

// Waves that have become exp(-this) of what they are at the surface are left out.
inline constexpr double kLeastDecay = 17.0;

// Writes columns [column0, column0 + 16) of the modes of a + i b, fields at a depth below the
// surface, as a batch for inverse_fft_2d(). Their surface_field()s must have been transformed.
// Returns false, with nothing written, if no wave of these columns is felt there.
bool fill_below(const SurfaceModes& modes, double below_m, MotionField a,
                std::optional<MotionField> b, int column0, float* re, float* im);

}  // namespace swell::ocean
