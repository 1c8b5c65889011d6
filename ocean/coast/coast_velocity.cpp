#include "ocean/coast/coast_velocity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/spectrum/point_chunk.h"

namespace swell::ocean {
namespace {

// A place along one axis of the grid, as in sample_trains(): samples from the cell's lower border,
// which `held` keeps in [0, 1]; rate is its derivative.
struct AxisPlace {
  int cell;
  double free, held, rate;
};

AxisPlace find_axis(double x_m, double min_m, double spacing_m, int cells) {
  const double u = (x_m - min_m) / spacing_m;
  // Compare and select: NaN ends in cell 0.
  double cell = std::floor(u);
  cell = cell > 0.0 ? cell : 0.0;
  cell = cell < cells - 1 ? cell : cells - 1;
  const double free = u - cell;
  const double held = free > 1.0 ? 1.0 : free < 0.0 ? 0.0 : free;
  return {static_cast<int>(cell), free, held, free == held ? 1.0 : 0.0};
}

double sample_held(const float* c, const AxisPlace& x, const AxisPlace& y) {
  return c[0] + c[1] * x.held + (c[2] + c[3] * x.held) * y.held;
}

// A train's phase at a place, and its gradient in cycles per sample spacing.
struct Phase {
  double cycles;
  glm::dvec2 gradient;
};

Phase sample_phase(const float* c, const AxisPlace& x, const AxisPlace& y) {
  return {c[0] + c[1] * x.free + c[2] * y.free + c[3] * (x.held * y.held),
          {c[1] + c[3] * y.held * x.rate, c[2] + c[3] * x.held * y.rate}};
}

// A profile of amplitude 1 over its mean, and its derivative by u in cycles. part: the shore's.
struct WaveProfile {
  double over_mean, rate;
};

WaveProfile profile_at(double turns, double part) {
  const double u = turns - std::floor(turns), centred = u - 0.5;
  const SinCos deep = sin_cos_turns(u);
  const double deep_rate = -2.0 * kPi * deep.sin;
  return {deep.cos + part * (8.0 * centred * centred - 2.0 / 3.0 - deep.cos),
          deep_rate + part * (16.0 * centred - deep_rate)};
}

glm::vec3 train_velocity(const TrainSea& sea, double t_s, glm::dvec2 p_world) {
  const terrain::Grid& grid = sea.grid;
  const AxisPlace x = find_axis(p_world.x, grid.min_world.x, grid.spacing_m, sea.cells_x);
  const AxisPlace y = find_axis(p_world.y, grid.min_world.y, grid.spacing_m, sea.cells_y);
  const auto cell = static_cast<std::size_t>(y.cell) * static_cast<std::size_t>(sea.cells_x) +
                    static_cast<std::size_t>(x.cell);
  const double depth_m = sample_held(sea.depth.data() + 4 * cell, x, y);
  const float* wave = sea.waves.data() + 8 * cell * static_cast<std::size_t>(sea.trains);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < sea.period_s.size(); ++i, wave += 8) {
    const double period_s = sea.period_s[i], turns = t_s / period_s;
    const Phase phase = sample_phase(wave, x, y);
    const double amplitude_m = sample_held(wave + 4, x, y);
    const WaveProfile w = profile_at(phase.cycles - (turns - std::floor(turns)),
                                     shore_part(depth_m, static_cast<double>(sea.deep_depth_m[i]),
                                                static_cast<double>(sea.shallow_depth_m[i])));
    // g k / omega = g T grad(cycles).
    const double per_gradient = sea.gravity_mps2[i] * period_s / grid.spacing_m;
    sum += glm::dvec3(amplitude_m * w.over_mean * per_gradient * phase.gradient,
                      -amplitude_m * w.rate / period_s);
  }
  return glm::vec3(sum);
}

}  // namespace

void sample_train_velocities(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                             std::span<glm::vec3> velocity_mps) {
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  SWELL_CHECK(sea.cells_x > 0 && sea.cells_y > 0, "cells={}x{}", sea.cells_x, sea.cells_y);
  for (std::size_t i = 0; i < p_world.size(); ++i)
    velocity_mps[i] = train_velocity(sea, t_s, p_world[i]);
}

void sample_coast_velocities(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                             std::span<glm::vec3> velocity_mps) {
  SWELL_CHECK(p_world.size() == velocity_mps.size(), "{} points, {} velocities", p_world.size(),
              velocity_mps.size());
  for (std::size_t first = 0; first < p_world.size(); first += kPointChunk) {
    const std::size_t count = std::min(kPointChunk, p_world.size() - first);
    std::array<float, kPointChunk> share;
    sample_coast_share(coast, p_world.subspan(first, count), std::span(share).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      glm::vec3& velocity = velocity_mps[first + i];
      velocity = glm::vec3(0.0f);
      if (share[i] == 0.0f) continue;
      sample_train_velocities(coast.trains, t_s, p_world.subspan(first + i, 1), {&velocity, 1});
      velocity *= share[i];
    }
  }
}

}  // namespace swell::ocean
