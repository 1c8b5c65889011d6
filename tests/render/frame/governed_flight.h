// A simulated renderer under the frame governor: known costs, noise, spikes, bursts of other work.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "math/random.h"
#include "render/quality/governor.h"

namespace swell::render {

inline constexpr double kBudget_ms = 17.0;
inline constexpr int kSecond = 60;  // frames

// What a frame at full quality costs on the simulated machine.
struct Load {
  double sea_ms = 0.5, triangles_ms = 2.0, visibility_ms = 1.5, planar_maps_ms = 0.0,
         shade_ms = 8.0;
  double rest_ms = 0.2;
  Load times(double factor) const {
    return {factor * sea_ms,         factor * triangles_ms, factor * visibility_ms,
            factor * planar_maps_ms, factor * shade_ms,     factor * rest_ms};
  }
};
inline constexpr Load kOpenSea{};
inline constexpr Load kCoast{1.0, 4.0, 2.5, 4.0, 14.0, 0.2};
inline constexpr Load kLagoon{0.5, 0.8, 0.9, 1.0, 3.8, 0.2};
inline constexpr double kPresent_ms = 0.9;

struct Noise {
  double sigma = 0.0;        // of each stage's factor
  double spike_share = 0.0;  // of frames that the machine disturbs
  double spike_ms = 0.0;
};

inline FrameOptions full_quality() {
  FrameOptions options;
  options.water_triangles = 30000;
  options.terrain_triangles = 20000;
  options.lookup_scale = 0.5;
  return options;
}

// Draws a frame: unlike the governor's model, part of the triangles' cost and of the pixels' cost
// does not scale.
inline FrameStatistics simulate(const Load& load, const FrameOptions& options, const Noise& noise,
                                int frame) {
  const auto dice = [&](int i) {
    return random_uniform(5, static_cast<std::uint64_t>(16 * frame + i));
  };
  const auto factor = [&](int i) { return 1.0 + noise.sigma * std::sqrt(12.0) * (dice(i) - 0.5); };
  const double triangles = options.water_triangles / 30000.0;
  const double pixels = options.picture_scale * options.picture_scale;
  const double lookups = pixels * options.lookup_scale * options.lookup_scale / 0.25;
  FrameStatistics s;
  const auto stage = [&](Stage which) -> double& {
    return s.stage_ms[static_cast<std::size_t>(which)];
  };
  stage(Stage::kSea) = load.sea_ms * factor(0);
  stage(Stage::kTriangulate) = load.triangles_ms * (0.05 + 0.95 * triangles) * factor(1);
  stage(Stage::kVisibility) = load.visibility_ms * (0.6 * triangles + 0.4 * pixels) * factor(2);
  stage(Stage::kPlanarMaps) = load.planar_maps_ms * (0.3 * triangles + 0.7 * lookups) * factor(3);
  stage(Stage::kShade) = load.shade_ms * (0.05 + 0.95 * pixels) * factor(4);
  if (dice(5) < noise.spike_share) {
    const auto hit = static_cast<std::size_t>(dice(6) * 5.0);
    stage(std::array{Stage::kSea, Stage::kTriangulate, Stage::kVisibility, Stage::kPlanarMaps,
                     Stage::kShade}[hit]) += noise.spike_ms;
  }
  for (const double ms : s.stage_ms) s.frame_ms += ms;
  s.frame_ms += load.rest_ms;
  s.water_triangles = options.water_triangles;
  return s;
}

struct Flight {
  std::vector<double> frame_ms;
  std::vector<FrameOptions> options;
  GovernorReport last;
};

// `outside_ms`: of presentation.
inline Flight run(Governor& governor, int frames, const std::function<Load(int)>& load,
                  Noise noise = {}, double outside_ms = 0.0) {
  Flight result;
  for (int k = 0; k < frames; ++k) {
    result.options.push_back(governor.options());
    const FrameStatistics s = simulate(load(k), governor.options(), noise, k);
    result.frame_ms.push_back(s.frame_ms + outside_ms);
    governor.next(s, outside_ms);
  }
  result.last = governor.report();
  return result;
}

inline Flight run(int frames, const std::function<Load(int)>& load, Noise noise = {},
                  double outside_ms = 0.0) {
  Governor governor({.budget_ms = kBudget_ms}, full_quality());
  return run(governor, frames, load, noise, outside_ms);
}

// Bursts of frames that other work makes late, `factor` times, one to `longest` frames each, with
// quiet frames between: `least_gap` to twice as many.
inline std::vector<double> other_work(int frames, int longest, int least_gap, double factor,
                                      std::uint64_t seed) {
  std::vector<double> factors(static_cast<std::size_t>(frames), 1.0);
  std::uint64_t draws = 0;
  const auto dice = [&](int low, int high) {
    return low + static_cast<int>(random_uniform(seed, draws++) * (high - low + 1));
  };
  for (int k = dice(least_gap, 2 * least_gap); k < frames; k += dice(least_gap, 2 * least_gap))
    for (const int end = std::min(k + dice(1, longest), frames); k < end; ++k)
      factors[static_cast<std::size_t>(k)] = factor;
  return factors;
}

// From frame `first` on.
inline double median_ms(const Flight& run, std::size_t first) {
  std::vector<double> ms(run.frame_ms.begin() + static_cast<std::ptrdiff_t>(first),
                         run.frame_ms.end());
  const auto middle = ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2);
  std::nth_element(ms.begin(), middle, ms.end());
  return *middle;
}

inline int size_changes(const Flight& run, std::size_t first) {
  int changes = 0;
  for (std::size_t i = std::max<std::size_t>(first, 1); i < run.options.size(); ++i)
    changes += run.options[i].lookup_scale != run.options[i - 1].lookup_scale ||
               run.options[i].picture_scale != run.options[i - 1].picture_scale;
  return changes;
}

inline bool is_full_size(const FrameOptions& o) {
  return o.lookup_scale == 0.5 && o.picture_scale == 1.0;
}

}  // namespace swell::render
