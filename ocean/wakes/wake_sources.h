// From a list of disturbances and a time to the squares of water that they tell on, each with what
// makes waves in it.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/limits.h"
#include "ocean/wakes/disturbance.h"
#include "ocean/wakes/made_fields.h"

namespace swell::terrain {
class ShoreMap;
}

namespace swell::ocean {

inline constexpr std::size_t kMostHullWindows = 6;  // of these: the largest hulls
inline constexpr std::size_t kMostRings = 64;       // at a time: the latest
inline constexpr std::size_t kMostStretches = 24;   // of a hull's way: the latest
inline constexpr float kWakeRim = 0.08f;            // part of a window over which waves fade

// A hump h exp(-r^2 / radius^2) that stood still at age_s ago; places are in the window.
struct WakeRing {
  float x_m = 0.0f, y_m = 0.0f, age_s = 0.0f, radius_m = 1.0f, height_m = 0.0f;
};

// A straight piece of a hull's way: between the two ages it was at (x, y) - age (u, v).
struct WakeStretch {
  float x_m = 0.0f, y_m = 0.0f, u_mps = 0.0f, v_mps = 0.0f, from_s = 0.0f, to_s = 0.0f;
};

struct WakeHull {
  float beam_m = 0.0f, length_m = 0.0f, draught_m = 0.0f, speed_mps = 0.0f;
};

// A square of the sea: sample [j * kWakeSamples + i] lies at corner + (i, j) length / kWakeSamples.
struct WakeWindow {
  glm::dvec2 corner_m{0.0};  // on a lattice of samples, so that they do not move with a hull
  double length_m = 1.0;
  // Where waves end: in a square of the same size that moves with a hull and not in steps; its
  // corner in the window.
  glm::vec2 end_m{0.0f};
  float depth_m = 0.0f;  // of the water; 0: deep
  float gravity_mps2 = 9.81f;
  float bound_m = 0.0f;                // |z| is kept below
  float most_counts = 0.0f;            // no wave of more to the window's length
  WakeHull hull;                       // of the stretches
  std::vector<WakeStretch> stretches;  // latest first, each as old as the one before ends
  std::vector<WakeRing> rings;         // oldest first
  // What wakes.h makes of them, of a frame that waits to be asked through a const one too.
  mutable std::vector<float> height_m, slope_x, slope_y, foam;
  mutable std::vector<float> lee;  // what land leaves of them (wake_lee.h); empty: all
};

// A ring in the world.
struct TimedRing {
  double t_s = 0.0;
  glm::dvec2 p_world{0.0};
  glm::dvec2 home_m{0.0};  // of its window: a disturbance's rings share it
  double radius_m = 1.0, height_m = 0.0;
  auto key() const { return std::array{t_s, p_world.x, p_world.y, radius_m, height_m}; }
};

// The windows of a time: the first `count` of them; those behind are storage.
struct WakeFrame {
  std::vector<WakeWindow> windows;
  std::size_t count = 0;
  std::vector<const Disturbance*> order;  // storage
  std::vector<TimedRing> rings;           // storage
  mutable std::vector<float> fft_planes;  // storage
  FftPlan plan;
  const terrain::ShoreMap* shore = nullptr;  // as advance_wakes() had it
  MadeFields made;

  std::span<const WakeWindow> shown() const { return {windows.data(), count}; }
};

// Fills frame.windows with the sources of both lists together at t_s. The order of the lists does
// not matter: sources are put into one of their own. Where there are more than the bounds above
// allow, smaller hulls and earlier rings are left out.
void find_wake_sources(std::span<const Disturbance> some, std::span<const Disturbance> others,
                       double gravity_mps2, double t_s, WakeFrame& frame);

}  // namespace swell::ocean
