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

// A profile of amplitude 1 over its mean, which near the shore is below 0, and its derivatives by u
// in cycles; the second leaves out the edge of a sharp crest. part: the shore's.
struct WaveProfile {
  double over_mean, rate, rate2, mean;
};

WaveProfile profile_at(double turns, double part) {
  const double u = turns - std::floor(turns), centred = u - 0.5;
  const SinCos deep = sin_cos_turns(u);
  const double deep_rate = -2.0 * kPi * deep.sin;
  const double deep_rate2 = -4.0 * kPi * kPi * deep.cos;
  return {deep.cos + part * (8.0 * centred * centred - 2.0 / 3.0 - deep.cos),
          deep_rate + part * (16.0 * centred - deep_rate), deep_rate2 + part * (16.0 - deep_rate2),
          -part / 3.0};
}

// A train at a place.
struct Train {
  double amplitude_m, period_s;
  WaveProfile profile;
  glm::dvec2 gradient;  // of its phase, in cycles per sample spacing
  double per_gradient;  // g k / omega = g T grad(cycles), over the gradient
};

// Calls visit(train) for each train at a place.
template <class Visit>
void for_each_train(const TrainSea& sea, double t_s, glm::dvec2 p_world, const Visit& visit) {
  const terrain::Grid& grid = sea.grid;
  const AxisPlace x = find_axis(p_world.x, grid.min_world.x, grid.spacing_m, sea.cells_x);
  const AxisPlace y = find_axis(p_world.y, grid.min_world.y, grid.spacing_m, sea.cells_y);
  const auto cell = static_cast<std::size_t>(y.cell) * static_cast<std::size_t>(sea.cells_x) +
                    static_cast<std::size_t>(x.cell);
  const double depth_m = sample_held(sea.depth.data() + 4 * cell, x, y);
  const float* wave = sea.waves.data() + 8 * cell * static_cast<std::size_t>(sea.trains);
  for (std::size_t i = 0; i < sea.period_s.size(); ++i, wave += 8) {
    const double period_s = sea.period_s[i], turns = t_s / period_s;
    const Phase phase = sample_phase(wave, x, y);
    const double amplitude_m = sample_held(wave + 4, x, y);
    const WaveProfile w = profile_at(phase.cycles - (turns - std::floor(turns)),
                                     shore_part(depth_m, static_cast<double>(sea.deep_depth_m[i]),
                                                static_cast<double>(sea.shallow_depth_m[i])));
    visit(Train{amplitude_m, period_s, w, phase.gradient,
                sea.gravity_mps2[i] * period_s / grid.spacing_m});
  }
}

glm::vec3 train_velocity(const TrainSea& sea, double t_s, glm::dvec2 p_world) {
  glm::dvec3 sum(0.0);
  for_each_train(sea, t_s, p_world, [&](const Train& train) {
    const double along = train.amplitude_m * train.profile.over_mean * train.per_gradient;
    sum += glm::dvec3(along * train.gradient,
                      -train.amplitude_m * train.profile.rate / train.period_s);
  });
  return glm::vec3(sum);
}

// What is left of a wave below the surface (ocean/below/motion.h); 1 at the surface.
struct Decay {
  double cosh_part, sinh_part;
};

Decay decay_at(double k_rad_m, double below_m, double depth_m) {
  const double kd = k_rad_m * depth_m;
  if (!(kd > 1e-6)) return {1.0, below_m < depth_m ? 1.0 - below_m / depth_m : 0.0};
  const double down = exp(-k_rad_m * below_m), whole = exp(-2.0 * kd);
  const double rest = exp(-2.0 * (kd - k_rad_m * below_m));
  return {down * ((1.0 + rest) / (1.0 + whole)), down * ((1.0 - rest) / (1.0 - whole))};
}

Motion train_motion(const TrainSea& sea, double t_s, glm::dvec2 p_world, double below_m,
                    double depth_m) {
  glm::dvec3 velocity(0.0), acceleration(0.0);
  double head_m = 0.0;
  for_each_train(sea, t_s, p_world, [&](const Train& train) {
    const double a = train.amplitude_m, per_s = 1.0 / train.period_s;
    const double k = kTwoPi * glm::length(train.gradient) / sea.grid.spacing_m;
    const Decay d = decay_at(k, below_m, depth_m);
    // In the order of train_velocity(), for the same bits at the surface.
    const double along = a * train.profile.over_mean * train.per_gradient * d.cosh_part;
    velocity +=
        glm::dvec3(along * train.gradient, -a * train.profile.rate / train.period_s * d.sinh_part);
    const double along_rate = -a * train.profile.rate * per_s * train.per_gradient * d.cosh_part;
    acceleration += glm::dvec3(along_rate * train.gradient,
                               a * train.profile.rate2 * per_s * per_s * d.sinh_part);
    head_m += a * (train.profile.over_mean * d.cosh_part + train.profile.mean);
  });
  Motion motion;
  for (int i = 0; i < 3; ++i) {
    motion[static_cast<std::size_t>(kVelocityX + i)] = static_cast<float>(velocity[i]);
    motion[static_cast<std::size_t>(kAccelerationX + i)] = static_cast<float>(acceleration[i]);
  }
  motion[kHead] = static_cast<float>(head_m);
  return motion;
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

void sample_coast_motions(const CoastSea& coast, double t_s, const PointsBelow& points,
                          std::span<Motion> motion) {
  const std::size_t count = points.p_world.size();
  SWELL_CHECK(count <= kPointChunk && motion.size() == count, "{} points, {} motions", count,
              motion.size());
  std::array<float, kPointChunk> share;
  sample_coast_share(coast, points.p_world, std::span(share).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    motion[i] = {};
    if (share[i] == 0.0f) continue;
    motion[i] =
        train_motion(coast.trains, t_s, points.p_world[i], static_cast<double>(points.below_m[i]),
                     static_cast<double>(points.depth_m[i]));
    for (float& field : motion[i]) field *= share[i];
  }
}

}  // namespace swell::ocean
