#include "ocean/open_sea/periodic_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "math/elementary.h"
#include "math/stop.h"
#include "ocean/open_sea/map_statistics.h"
#include "ocean/open_sea/wave_automaton.h"
#include "ocean/spectrum/require.h"

namespace swell::ocean {
namespace {

constexpr double kLeastCorrelation = -0.9;

void check_recipe(const MapRecipe& recipe) {
  if (recipe.size < kMinMapSize || recipe.size > kMaxMapSize ||
      !std::has_single_bit(static_cast<unsigned>(recipe.size)))
    throw std::invalid_argument(fmt::format("map size: got {}, allowed powers of two from {} to {}",
                                            recipe.size, kMinMapSize, kMaxMapSize));
  require(recipe.frames, kMinMapFrames, kMaxMapFrames, "map frames");
  const auto samples = static_cast<std::size_t>(recipe.size) * recipe.size * recipe.frames;
  if (samples > kMaxMapSamples)
    throw std::invalid_argument(
        fmt::format("map frames: got {} of {} x {} samples, allowed {} samples in all",
                    recipe.frames, recipe.size, recipe.size, kMaxMapSamples));
  if (recipe.bits != 8 && recipe.bits != 16)
    throw std::invalid_argument(fmt::format("map bits: got {}, allowed 8 or 16", recipe.bits));
  require(recipe.steps_per_frame, 1, 64, "map steps per frame");
  require(recipe.blend, 0.05, 0.5, "map blend");
  require(recipe.to_rad, -1e6, 1e6, "map direction");
  require(recipe.spreading, 0.0, 50.0, "map spreading");
  require(recipe.peak_waves, 1.0, recipe.size / 8.0, "map peak waves");
  require(recipe.drops, 1, 10000, "map drops");
  require(recipe.drop_cells, 1.0, 64.0, "map drop radius");
  if (recipe.first != FirstDisturbance::kHeights) return;
  if (recipe.heights.size() != static_cast<std::size_t>(recipe.size) * recipe.size)
    throw std::invalid_argument(fmt::format("map heights: got {}, allowed {} x {}",
                                            recipe.heights.size(), recipe.size, recipe.size));
  for (const float height : recipe.heights) require(height, -1e6, 1e6, "map height");
}

void disturb(const MapRecipe& recipe, WaveAutomaton& automaton) {
  switch (recipe.first) {
    case FirstDisturbance::kGusts:
      return add_gusts(automaton, {recipe.to_rad, recipe.spreading, recipe.peak_waves,
                                   std::max(1, recipe.size / 6), recipe.seed});
    case FirstDisturbance::kDrops:
      return add_drops(automaton, recipe.drops, recipe.drop_cells, recipe.seed);
    case FirstDisturbance::kHeights:
      return add_heights(automaton, recipe.heights);
  }
}

using Frames = std::vector<std::vector<double>>;

// The correlation of `later` with the first frames, all of them together: that of waves at rest, of
// which all heights come and go at once, swings from frame to frame.
double correlation(const Frames& frames, const Frames& later) {
  double own = 0.0, other = 0.0, both = 0.0;
  for (std::size_t f = 0; f < later.size(); ++f)
    for (std::size_t i = 0; i < later[f].size(); ++i) {
      own += frames[f][i] * frames[f][i];
      other += later[f][i] * later[f][i];
      both += frames[f][i] * later[f][i];
    }
  const double product = own * other;
  return product > 0.0 ? std::max(both / std::sqrt(product), kLeastCorrelation) : 0.0;
}

// a(t + T) becomes a(t) over the frames of `later`: out = sin(q) a(t) + cos(q) a(t + T), whose
// variance is that of both but for their correlation rho, which 1 / sqrt(1 + rho sin(2 q)) makes up
// for.
void blend_in(const Frames& later, Frames& frames) {
  const double rho = correlation(frames, later);
  for (std::size_t f = 0; f < later.size(); ++f) {
    const double u = static_cast<double>(f) / static_cast<double>(later.size());
    const SinCos q = sin_cos_turns(0.25 * u * u * (3.0 - 2.0 * u));
    const double scale = 1.0 / std::sqrt(1.0 + 2.0 * rho * q.sin * q.cos);
    for (std::size_t i = 0; i < later[f].size(); ++i)
      frames[f][i] = scale * (q.sin * frames[f][i] + q.cos * later[f][i]);
  }
}

Frames run_loop(const MapRecipe& recipe) {
  WaveAutomaton automaton = make_automaton(recipe.size, recipe.courant);
  disturb(recipe, automaton);
  remove_mean(automaton.now);
  remove_mean(automaton.before);
  const auto run = [&](int count) {
    Frames frames;
    for (int f = 0; f < count; ++f) {
      check_stop();
      frames.push_back(automaton.now);
      for (int i = 0; i < recipe.steps_per_frame; ++i) step(automaton);
    }
    return frames;
  };
  Frames frames = run(recipe.frames);
  blend_in(run(std::max(2, static_cast<int>(recipe.blend * recipe.frames))), frames);
  return frames;
}

void normalise(Frames& frames) {
  double sum = 0.0, count = 0.0;
  for (const auto& frame : frames) {
    for (const double height : frame) sum += height * height;
    count += static_cast<double>(frame.size());
  }
  if (!(sum > 0.0))
    throw std::invalid_argument(
        "map heights: got a flat first disturbance, allowed one with waves");
  const double scale = 1.0 / std::sqrt(sum / count);
  for (auto& frame : frames)
    for (double& height : frame) height *= scale;
}

// Central differences of the sixth order, in heights per side: of a wave of 6 cells 1 % too small,
// of 8 cells 0.2 %.
std::vector<double> slope_along(const std::vector<double>& frame, int size, bool along_x) {
  std::vector<double> slopes(frame.size());
  const int mask = size - 1;
  const double scale = size / 60.0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const auto at = [&](int by) {
        return along_x ? frame[static_cast<std::size_t>(j * size + ((i + by) & mask))]
                       : frame[static_cast<std::size_t>(((j + by) & mask) * size + i)];
      };
      slopes[static_cast<std::size_t>(j * size + i)] =
          scale * (45.0 * (at(1) - at(-1)) - 9.0 * (at(2) - at(-2)) + (at(3) - at(-3)));
    }
  return slopes;
}

double most_of(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

void add_codes(const std::vector<double>& values, float scale, int bits,
               std::vector<std::int16_t>& codes) {
  const double most = bits == 8 ? 127.0 : 32767.0;
  const double per_scale = 1.0 / static_cast<double>(scale);
  for (const double value : values)
    codes.push_back(
        static_cast<std::int16_t>(std::clamp(std::nearbyint(value * per_scale), -most, most)));
}

}  // namespace

void measure(PeriodicMap& map) {
  double height2 = 0.0, slope2 = 0.0, slope_y2 = 0.0, most = 0.0;
  for (std::size_t i = 0; i < map.height.size(); ++i) {
    const double h = map.height[i], x = map.slope_x[i], y = map.slope_y[i];
    height2 += h * h;
    slope2 += x * x + y * y;
    slope_y2 += y * y;
    most = std::max(most, std::abs(h));
  }
  const double count = static_cast<double>(map.height.size());
  const double h_scale = map.height_scale, s_scale = map.slope_scale;
  map.variance = height2 / count * h_scale * h_scale;
  map.slope_variance = slope2 / count * s_scale * s_scale;
  map.slope_variance_y = slope_y2 / count * s_scale * s_scale;
  map.peak = most * h_scale;
}

double PeriodicMap::mean_wave_number() const {
  return variance > 0.0 ? std::sqrt(slope_variance / variance) : 0.0;
}

PeriodicMap make_periodic_map(const MapRecipe& recipe) {
  check_recipe(recipe);
  Frames frames = run_loop(recipe);
  normalise(frames);
  PeriodicMap map;
  map.size = recipe.size, map.frames = recipe.frames, map.bits = recipe.bits;
  map.travel = recipe.courant * recipe.steps_per_frame * recipe.frames / recipe.size;
  double most_height = 0.0, most_slope = 0.0;
  for (const auto& frame : frames) {
    check_stop();
    most_height = std::max(most_height, most_of(frame));
    for (const bool along_x : {true, false})
      most_slope = std::max(most_slope, most_of(slope_along(frame, map.size, along_x)));
  }
  const double codes = map.bits == 8 ? 127.0 : 32767.0;
  map.height_scale = static_cast<float>(most_height / codes);
  map.slope_scale = static_cast<float>(most_slope / codes);
  for (const auto& frame : frames) {
    check_stop();
    add_codes(frame, map.height_scale, map.bits, map.height);
    add_codes(slope_along(frame, map.size, true), map.slope_scale, map.bits, map.slope_x);
    add_codes(slope_along(frame, map.size, false), map.slope_scale, map.bits, map.slope_y);
  }
  measure(map);
  return map;
}

MapTime map_time(const PeriodicMap& map, double loops) {
  const double at = (loops - std::floor(loops)) * map.frames;
  const double whole = std::floor(at), u = at - whole;
  const double u2 = u * u, u3 = u2 * u;
  MapTime time;
  for (int i = 0; i < 4; ++i)
    time.frame[i] = (static_cast<int>(whole) + i - 1 + map.frames) % map.frames;
  const double weight[4] = {-0.5 * u + u2 - 0.5 * u3, 1.0 - 2.5 * u2 + 1.5 * u3,
                            0.5 * u + 2.0 * u2 - 1.5 * u3, -0.5 * u2 + 0.5 * u3};
  const double rate[4] = {-0.5 + 2.0 * u - 1.5 * u2, -5.0 * u + 4.5 * u2, 0.5 + 4.0 * u - 4.5 * u2,
                          -u + 1.5 * u2};
  for (int i = 0; i < 4; ++i) {
    time.weight[i] = static_cast<float>(weight[i]);
    time.rate[i] = static_cast<float>(rate[i] * map.frames);
  }
  return time;
}

}  // namespace swell::ocean
