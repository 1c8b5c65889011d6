#include "texture/uv_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/check.h"
#include "texture/lattice.h"

namespace swell::texture {
namespace {

bool power_of_two(int n) { return n > 0 && std::has_single_bit(static_cast<unsigned>(n)); }

float mix(float a, float b, float weight) { return a + weight * (b - a); }

float cubic_weight(double t) {
  return static_cast<float>(interpolation_weight(Interpolation::kCubic, t));
}

}  // namespace

UvNoise::UvNoise(const UvNoiseOptions& options) : options_(options), noise_(options.seed) {
  SWELL_CHECK(power_of_two(options.size) && options.size >= 8 && options.size <= 1024, "size={}",
              options.size);
  SWELL_CHECK(options.octaves >= 1 && options.octaves <= 8, "octaves={}", options.octaves);
  SWELL_CHECK(power_of_two(options.cells) && options.cells <= 256, "cells={}", options.cells);
  const int last_cells = options.cells << (options.octaves - 1);
  SWELL_CHECK(last_cells <= 256 && 2 * last_cells <= options.size, "cells={} octaves={} size={}",
              options.cells, options.octaves, options.size);
  SWELL_CHECK(options.persistence >= 0.0 && options.persistence <= 1.0, "persistence={}",
              options.persistence);
  SWELL_CHECK(std::abs(options.angle_turns) <= 1000.0, "angle_turns={}", options.angle_turns);
  turns_.resize(std::size_t{1} * options.size * options.size);
  plane_.resize(std::size_t{1} * last_cells * last_cells);
  rows_.resize(std::size_t{1} * last_cells * options.size);
}

void UvNoise::evaluate(double t, std::span<float> cos_out, std::span<float> sin_out) {
  SWELL_CHECK(std::isfinite(t), "t={}", t);
  write(
      [&](int octave) {
        const LatticePosition time = lattice_position(std::ldexp(t, octave), kPeriod);
        return LatticeTimes{time.cell, time.cell + 1, cubic_weight(time.fraction)};
      },
      cos_out, sin_out);
}

void UvNoise::evaluate_looping(double t, int loop_cells, std::span<float> cos_out,
                               std::span<float> sin_out) {
  SWELL_CHECK(loop_cells >= 1 && loop_cells <= 1 << 20, "loop_cells={}", loop_cells);
  SWELL_CHECK(t >= 0.0 && t <= loop_cells, "t={} loop_cells={}", t, loop_cells);
  write(
      [&](int octave) {
        const double octave_t = std::ldexp(t, octave), cell = std::floor(octave_t);
        const int cells = loop_cells << octave, now = static_cast<int>(cell) % cells;
        return LatticeTimes{now, (now + 1) % cells, cubic_weight(octave_t - cell)};
      },
      cos_out, sin_out);
}

template <class TimesOf>
void UvNoise::write(const TimesOf& times_of, std::span<float> cos_out, std::span<float> sin_out) {
  SWELL_CHECK(cos_out.size() == turns_.size() && sin_out.size() == turns_.size(), "cos={} sin={}",
              cos_out.size(), sin_out.size());
  double sum = 0.0, amplitude = 1.0;
  for (int octave = 0; octave < options_.octaves; ++octave, amplitude *= options_.persistence) {
    sum += amplitude;
  }
  std::fill(turns_.begin(), turns_.end(), 0.0f);
  amplitude = options_.angle_turns / sum;
  for (int octave = 0; octave < options_.octaves; ++octave, amplitude *= options_.persistence) {
    add_octave(octave, static_cast<float>(amplitude), times_of(octave));
  }
  write_unit_vectors(turns_, cos_out, sin_out);
}

void UvNoise::add_octave(int octave, float amplitude, const LatticeTimes& times) {
  const int size = options_.size, cells = options_.cells << octave, per_cell = size / cells;
  // The lattice between the two times.
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const float now = static_cast<float>(noise_.lattice3(i, j, times.now));
      const float next = static_cast<float>(noise_.lattice3(i, j, times.next));
      plane_[static_cast<std::size_t>(j) * cells + i] = amplitude * mix(now, next, times.weight);
    }
  }
  // Along rows, then between them.
  for (int s = 0; s < per_cell; ++s) {
    const float weight = cubic_weight(static_cast<double>(s) / per_cell);
    for (int j = 0; j < cells; ++j) {
      const float* const from = plane_.data() + static_cast<std::size_t>(j) * cells;
      float* const to = rows_.data() + static_cast<std::size_t>(j) * size + s;
      for (int i = 0; i < cells; ++i) {
        to[i * per_cell] = mix(from[i], from[(i + 1) & (cells - 1)], weight);
      }
    }
  }
  for (int y = 0; y < size; ++y) {
    const int j = y / per_cell, next_j = (j + 1) & (cells - 1);
    const float weight = cubic_weight(static_cast<double>(y % per_cell) / per_cell);
    const float* const row = rows_.data() + static_cast<std::size_t>(j) * size;
    const float* const next = rows_.data() + static_cast<std::size_t>(next_j) * size;
    float* const turns = turns_.data() + static_cast<std::size_t>(y) * size;
    for (int x = 0; x < size; ++x) turns[x] += mix(row[x], next[x], weight);
  }
}

}  // namespace swell::texture
