// Animated texture coordinates: the offsets (cos, sin)(angle(i, j, t)) on a periodic grid, where
// the angle is Perlin noise in two dimensions and time. Source: Elykov et al., 2000.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "texture/perlin.h"

namespace swell::texture {

struct UvNoiseOptions {
  int size = 64;             // grid points a side: a power of two in [8, 1024]
  int cells = 8;             // noise cells a side of the first octave: a power of two
  int octaves = 2;           // each has twice the cells and runs twice as fast; cells of the last
                             // at most size / 2 and 256
  double persistence = 0.5;  // amplitude from octave to octave, in [0, 1]
  double angle_turns = 0.5;  // largest angle: half a turn is +-pi
  std::uint64_t seed = 1;
};

// Tables and work space; one thread at a time. What evaluate() writes depends on the options and
// on t alone.
class UvNoise {
 public:
  explicit UvNoise(const UvNoiseOptions& options);

  // Writes cos and sin of angle_turns * 2 pi * noise(i, j, t), row-major, size * size floats each,
  // ready for pack_map2. noise = sum of persistence^o value(2^o i cells / size, 2^o j cells / size,
  // 2^o t), o < octaves, divided by the sum of persistence^o; value is PerlinNoise's lattice with
  // cubic interpolation, wrapped at the grid's edges. t [cells] may be any finite time; the motion
  // has a continuous speed and repeats after kPeriod. About 0.01 ms for 64 x 64 and two octaves.
  static constexpr int kPeriod = 256;
  void evaluate(double t, std::span<float> cos_out, std::span<float> sin_out);

  // Writes noise that repeats after loop_cells, a whole number in [1, 2^20], else as evaluate().
  // Octave o passes through 2^o loop_cells values of the lattice in that time: one value stands
  // still. t is in [0, loop_cells].
  void evaluate_looping(double t, int loop_cells, std::span<float> cos_out,
                        std::span<float> sin_out);

 private:
  // Lattice times before and after t, and how far it lies between them.
  struct LatticeTimes {
    int now, next;
    float weight;
  };
  void add_octave(int octave, float amplitude, const LatticeTimes& times);
  template <class TimesOf>
  void write(const TimesOf& times_of, std::span<float> cos_out, std::span<float> sin_out);

  UvNoiseOptions options_;
  PerlinNoise noise_;
  std::vector<float> turns_;  // the angle, size * size
  std::vector<float> plane_;  // lattice values at t, cells of the octave a side
  std::vector<float> rows_;   // the same widened to `size` columns
};

// cos and sin of 2 pi turns[i], |turns[i]| < 2^22, on the selected SIMD target.
void write_unit_vectors(std::span<const float> turns, std::span<float> cos_out,
                        std::span<float> sin_out);

}  // namespace swell::texture
