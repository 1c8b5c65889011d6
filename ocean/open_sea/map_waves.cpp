#include "ocean/open_sea/map_waves.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/open_sea/map_sets.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/patch_waves.h"
#include "ocean/spectrum/require.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kBands = 4;  // pieces of work that a map's rows make

void check_layer(const MapLayer& layer) {
  if (layer.period_s != 0.0) require(layer.period_s, 0.1, 1e5, "maps.period_s (or 0)");
  require(layer.hs_m, 0.0, 30.0, "maps.hs_m");
  for (int axis = 0; axis < 2; ++axis) {
    require(layer.length_m[axis], 0.5, 50000.0, "maps.length_m");
    require(layer.offset_m[axis], -1e6, 1e6, "maps.offset_m");
  }
  require(layer.offset_s, -1e6, 1e6, "maps.offset_s");
}

int sample_at(double offset_m, double length_m, int size) {
  const double sides = offset_m / length_m;
  return static_cast<int>(std::nearbyint((sides - std::floor(sides)) * size)) & (size - 1);
}

// Laid over L_x by L_y, waves of mean squares k_x^2 and k_y^2 [rad per side] have those of
// k^2 = k_x^2 / L_x^2 + k_y^2 / L_y^2; over a square of side S, (k_x^2 + k_y^2) / S^2.
double square_side_m(const PeriodicMap& map, glm::dvec2 length_m) {
  const double ratio = length_m.x / length_m.y;
  const double part_y = map.slope_variance_y / map.slope_variance;
  return length_m.x / std::sqrt(1.0 + (ratio * ratio - 1.0) * part_y);
}

// The time of a loop in which the map's mean wave runs as fast as in deep water.
double deep_water_period_s(const PeriodicMap& map, double square_m, double gravity_mps2) {
  const double speed_mps = std::sqrt(gravity_mps2 * square_m / map.mean_wave_number());
  return map.travel * square_m / speed_mps;
}

MapWaves lay_map(std::shared_ptr<const PeriodicMap> map, const MapLayer& layer,
                 const SeaDescription& sea) {
  check_layer(layer);
  MapWaves waves;
  waves.length_m = layer.length_m;
  waves.square_m = square_side_m(*map, layer.length_m);
  const double period_s = layer.period_s != 0.0
                              ? layer.period_s
                              : deep_water_period_s(*map, waves.square_m, sea.gravity_mps2);
  waves.loops_per_s = looping_frequency(1.0 / period_s, sea.loop_s);
  const double first = layer.offset_s / period_s;
  waves.first_loops = first - std::floor(first);
  waves.first_x = sample_at(layer.offset_m.x, layer.length_m.x, map->size);
  waves.first_y = sample_at(layer.offset_m.y, layer.length_m.y, map->size);
  waves.metres = 0.25 * sea.amplitude_scale * layer.hs_m / std::sqrt(map->variance);
  waves.variance_m2 = waves.metres * waves.metres * map->variance;
  const double per_m = waves.metres / waves.square_m;
  waves.slope_variance = per_m * per_m * map->slope_variance;
  waves.map = std::move(map);
  return waves;
}

// Where four frames of codes begin, and what each counts.
struct Blend {
  std::array<const std::int16_t*, 4> codes;
  std::array<float, 4> weight;
};

Blend blend_of(const PeriodicMap& map, const std::vector<std::int16_t>& codes, const int* frame,
               const float* weight, double scale) {
  Blend blend;
  for (std::size_t k = 0; k < 4; ++k) {
    blend.codes[k] = codes.data() + static_cast<std::size_t>(frame[k]) * map.frame_samples();
    blend.weight[k] = static_cast<float>(static_cast<double>(weight[k]) * scale);
  }
  return blend;
}

void blend_run(const Blend& blend, std::size_t from, int count, float* to) {
  const std::int16_t *const a = blend.codes[0] + from, *const b = blend.codes[1] + from;
  const std::int16_t *const c = blend.codes[2] + from, *const d = blend.codes[3] + from;
  const auto [wa, wb, wc, wd] = blend.weight;
  for (int i = 0; i < count; ++i)
    to[i] = (wa * static_cast<float>(a[i]) + wb * static_cast<float>(b[i])) +
            (wc * static_cast<float>(c[i]) + wd * static_cast<float>(d[i]));
}

// Rows [first, last) of a field, each turned by the place of the world's origin.
void blend_rows(const MapWaves& waves, const Blend& blend, int first, int last, float* field) {
  const int size = waves.map->size;
  for (int j = first; j < last; ++j) {
    const auto row =
        static_cast<std::size_t>((j + waves.first_y) & (size - 1)) * static_cast<std::size_t>(size);
    float* const to = field + static_cast<std::ptrdiff_t>(j) * size;
    const int whole = size - waves.first_x;
    blend_run(blend, row + static_cast<std::size_t>(waves.first_x), whole, to);
    blend_run(blend, row, waves.first_x, to + whole);
  }
}

double loops_at(const MapWaves& waves, double t_s) {
  return waves.first_loops + waves.loops_per_s * t_s;
}

void sample_band(const MapWaves& waves, double t_s, std::size_t band, PatchFrame& patch) {
  const PeriodicMap& map = *waves.map;
  const MapTime time = map_time(map, loops_at(waves, t_s));
  const double height = waves.metres * static_cast<double>(map.height_scale);
  const glm::dvec2 slope = waves.metres / waves.length_m * static_cast<double>(map.slope_scale);
  const int rows = map.size / static_cast<int>(kBands);
  const int first = static_cast<int>(band) * rows;
  const auto blend = [&](const std::vector<std::int16_t>& codes, double scale,
                         std::vector<float>& field) {
    blend_rows(waves, blend_of(map, codes, time.frame, time.weight, scale), first, first + rows,
               field.data());
  };
  blend(map.height, height, patch.height_m);
  blend(map.slope_x, slope.x, patch.slope_x);
  blend(map.slope_y, slope.y, patch.slope_y);
}

// Codes of a row's samples and of the next ones, side by side. The sum's low bits are the nearest
// whole number, in two's complement.
void code_pairs(const PatchFrame& patch, int row, std::uint32_t* pairs) {
  constexpr float kWholeBits = 0x1.8p23f;
  const int n = patch.resolution;
  const float* const height_m =
      patch.height_m.data() + static_cast<std::ptrdiff_t>(row & (n - 1)) * n;
  const float per_m = 1.0f / patch.height_step_m;
  const auto code = [&](int i) {
    return std::bit_cast<std::uint32_t>(height_m[i] * per_m + kWholeBits) & 0xffff;
  };
  for (int i = 0; i + 1 < n; ++i) pairs[i] = code(i) | code(i + 1) << 16;
  pairs[n - 1] = code(n - 1) | code(0) << 16;
}

void pack_band(std::size_t band, PatchFrame& patch) {
  const int n = patch.resolution, rows = n / static_cast<int>(kBands);
  const int first = static_cast<int>(band) * rows;
  std::array<std::array<std::uint32_t, kMaxMapSize>, 2> pairs;
  std::uint32_t *here = pairs[0].data(), *next = pairs[1].data();
  code_pairs(patch, first, here);
  for (int j = first; j < first + rows; ++j) {
    code_pairs(patch, j + 1, next);
    std::uint64_t* const quads = patch.height_quads.data() + static_cast<std::ptrdiff_t>(j) * n;
    for (int i = 0; i < n; ++i) quads[i] = here[i] | static_cast<std::uint64_t>(next[i]) << 32;
    std::swap(here, next);
  }
}

// i k / |k| times the field of which `re` and `im` hold the conjugate of the transform, to `x` and
// `y`; `ratio`: of the field's length along x to that along y.
void turn_along_waves(const FftPlan& plan, double ratio, const float* re, const float* im,
                      const FftOutput& out, std::vector<float>& planes, Workers& workers) {
  const int size = plan.size;
  const double per_sample = 1.0 / (static_cast<double>(size) * size);
  const auto fill = [&](int, int column0, float* to_re, float* to_im) {
    for (int j = 0; j < size; ++j) {
      const double ky = ratio * wave_count(j, size);
      for (int lane = 0; lane < kFftBatch; ++lane) {
        const int i = column0 + lane;
        const double kx = wave_count(i, size);
        const auto from = static_cast<std::size_t>(j) * size + i;
        const auto to = static_cast<std::size_t>(plan.slot[j] * kFftBatch + lane);
        // The mean has no direction, and waves of two samples no sign.
        const bool is_wave = (kx != 0.0 || ky != 0.0) && 2 * i != size && 2 * j != size;
        const double k = std::sqrt(kx * kx + ky * ky);
        const double unit = is_wave ? per_sample / k : 0.0;
        const double a = static_cast<double>(re[from]) * unit;
        const double b = -static_cast<double>(im[from]) * unit;
        // (i kx - ky) (a + i b): its transform is x + i y.
        to_re[to] = static_cast<float>(-ky * a - kx * b);
        to_im[to] = static_cast<float>(kx * a - ky * b);
      }
    }
    return true;
  };
  inverse_fft_2d(plan, fill, {&out, 1}, planes, workers);
}

}  // namespace

std::size_t count_map_layers(const SeaDescription& sea) {
  return (sea.map_set == MapSet::kNone ? 0 : kMapSetLayers) + sea.maps.size();
}

std::vector<MapWaves> make_map_waves(const SeaDescription& sea) {
  std::vector<MapWaves> waves;
  if (sea.map_set != MapSet::kNone) {
    const auto map = std::make_shared<const PeriodicMap>(
        make_periodic_map(recipe_of_set(sea.map_set, sea.wind_from_rad, sea.seed)));
    for (const MapLayer& layer : layers_of_set(sea.map_set, sea.seed))
      waves.push_back(lay_map(map, layer, sea));
  }
  for (const MapLayer& layer : sea.maps) {
    check_layer(layer);
    waves.push_back(lay_map(std::make_shared<const PeriodicMap>(read_map(layer.file)), layer, sea));
  }
  std::ranges::stable_sort(waves, std::greater{}, &MapWaves::square_m);
  return waves;
}

float packed_step_m(const MapWaves& waves) {
  constexpr double kMostOfFour = 1.25;  // sum of the sizes of the cubic's weights
  constexpr double kLeast_m = 1e-12;    // of a layer without height
  return static_cast<float>(std::max(kMostOfFour * waves.peak_m() / 32767.0, kLeast_m));
}

void sample_maps(std::span<const MapWaves> waves, double t_s, std::span<PatchFrame> patches,
                 Workers& workers) {
  SWELL_CHECK(waves.size() == patches.size(), "{} maps, {} patches", waves.size(), patches.size());
  workers.for_each(kBands * waves.size(), [&](std::size_t i, int) {
    sample_band(waves[i / kBands], t_s, i % kBands, patches[i / kBands]);
  });
  if (patches.empty() || patches[0].height_quads.empty()) return;
  workers.for_each(kBands * waves.size(),
                   [&](std::size_t i, int) { pack_band(i % kBands, patches[i / kBands]); });
}

void sample_map_velocities(const MapWaves& waves, double t_s, PatchFrame& x, PatchFrame& y,
                           PatchFrame& z, std::vector<float>& storage, Workers& workers) {
  const PeriodicMap& map = *waves.map;
  const MapTime time = map_time(map, loops_at(waves, t_s));
  const double rate_mps = waves.metres * static_cast<double>(map.height_scale) * waves.loops_per_s;
  blend_rows(waves, blend_of(map, map.height, time.frame, time.rate, rate_mps), 0, map.size,
             z.height_m.data());
  const FftPlan plan = make_fft_plan(map.size);
  const std::vector<float>& rising = z.height_m;
  const auto fill = [&](int, int column0, float* re, float* im) {
    for (int j = 0; j < map.size; ++j)
      for (int lane = 0; lane < kFftBatch; ++lane) {
        const auto to = static_cast<std::size_t>(plan.slot[j] * kFftBatch + lane);
        re[to] = rising[static_cast<std::size_t>(j * map.size + column0 + lane)];
        im[to] = 0.0f;
      }
    return true;
  };
  // The inverse transform of a real field is the conjugate of its transform.
  std::vector<float> re(map.frame_samples()), im(map.frame_samples());
  const FftOutput spectrum = {re.data(), im.data()};
  inverse_fft_2d(plan, fill, {&spectrum, 1}, storage, workers);
  turn_along_waves(plan, waves.length_m.x / waves.length_m.y, re.data(), im.data(),
                   {x.height_m.data(), y.height_m.data()}, storage, workers);
}

}  // namespace swell::ocean
