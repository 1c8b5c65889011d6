#include "render/sky/clouds.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/for_each_row.h"
#include "math/smoothstep.h"
#include "ocean/open_sea/sea_state.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"
#include "texture/perlin.h"

namespace swell::render {
namespace {

constexpr int kMapSize = 256, kCells = 8;
constexpr double kFirstPeriod_m = 26000.0;
// Layers of the same map, none a multiple of the next: their sum does not repeat.
constexpr std::array<double, Clouds::kLayers> kPeriods_m = {kFirstPeriod_m, 6100.0, 1370.0};
constexpr double kRegionPeriod_m = 193000.0;
constexpr float kRegionGain = 0.7f;
// The layer fades to nothing towards its own height: a picture from next to it would be all cloud
// or none.
constexpr double kNearLayer_m = 600.0;
constexpr std::array<float, Clouds::kLayers> kGains = {1.0f, 0.34f, 0.10f};

// The threshold that so much of a normal distribution lies above, in deviations: the logistic
// distribution's, which is as wide.
float threshold_of(float cover) {
  const double p = std::clamp(static_cast<double>(cover), 0.002, 0.998);
  return static_cast<float>(-log(p / (1.0 - p)) / 1.702);
}

// Means over noise of a normal distribution.
void set_means(CloudLight& clouds) {
  constexpr int kSteps = 64;
  double opacity = 0.0, passes = 0.0, through = 0.0, weights = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -4.0 + 8.0 * (i + 0.5) / kSteps, weight = exp(-0.5 * x * x);
    const double over = std::max(x - clouds.threshold, 0.0);
    const double depth = kCloudDepth * over * over, clear = exp(-depth);
    opacity += weight * (1.0 - clear);
    through += weight * (1.0 - clear) / (1.0 + static_cast<double>(clouds.loss) * depth);
    passes += weight * clear;
    weights += weight;
  }
  clouds.mean_opacity = static_cast<float>(opacity / weights);
  clouds.mean_radiance = clouds.base * static_cast<float>(through / std::max(opacity, 1e-9));
  clouds.direct_part = static_cast<float>(passes / weights) * (1.0f - clouds.overcast);
}

// With the wind of greater heights. A sea that loops has clouds that drift by whole periods or
// stand still.
glm::dvec2 drift_m(const ocean::SeaDescription& sea, double period_m, double t_s) {
  const double travel = sea.wind_from_rad + kPi, speed_mps = 1.4 * sea.wind_speed_mps;
  const glm::dvec2 velocity = speed_mps * glm::dvec2(sin(travel), cos(travel));
  if (sea.loop_s == 0.0) return velocity * t_s;
  const glm::dvec2 periods = velocity * (sea.loop_s / period_m);
  return glm::dvec2(std::nearbyint(periods.x), std::nearbyint(periods.y)) *
         (period_m * (ocean::wave_time_s(sea, t_s) / sea.loop_s));
}

// Clouds are as smooth as straight lines between texels: what these lack is not lost.
SlopeLayer make_cloud_layer(const texture::PackedMap2& map, double period_m, float gain,
                            glm::dvec2 eye, glm::dvec2 moved_m) {
  SlopeLayer layer = make_layer(map, period_m, gain, eye, moved_m);
  const float between_texels = layer.lost_variance[0];
  for (float& lost : layer.lost_variance) lost -= between_texels;
  return layer;
}

}  // namespace

CloudLight make_cloud_light(const sky::SkyLight& light, glm::vec3 ambient, float cover) {
  CloudLight clouds;
  clouds.overcast = smoothstep(0.75f, 1.0f, cover);
  clouds.threshold = threshold_of(cover) - 1.5f * clouds.overcast;
  clouds.to_light = light.to_light;
  // A low sun shines on the sides of clouds.
  const float incident = 0.85f * std::max(light.to_light.z, 0.0f) + 0.12f;
  clouds.base = light.cloud_irradiance * (incident / static_cast<float>(kPi)) + 0.9f * ambient;
  clouds.tops = clouds.base;
  clouds.forward = light.cloud_irradiance;
  // A closed layer is thicker, and more even.
  clouds.loss *= 1.0f - 0.7f * clouds.overcast;
  clouds.base *= 1.0f - 0.4f * clouds.overcast;
  set_means(clouds);
  return clouds;
}

void build_cloud_map(std::uint64_t seed, glm::vec3 to_light, Workers& workers,
                     texture::PackedMap2& map, float& variance) {
  constexpr int n = kMapSize;
  const texture::PerlinNoise noise(seed);
  std::vector<float> density(static_cast<std::size_t>(n) * n), side(density.size());
  const auto at = [](std::vector<float>& field, int x, int y) -> float& {
    return field[static_cast<std::size_t>((y & (n - 1)) * n + (x & (n - 1)))];
  };
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i) {
      const double x = kCells * static_cast<double>(i) / n, y = kCells * static_cast<double>(j) / n;
      const double bend = noise.periodic_fractal3(x, y, 0.5, kCells, 2, 0.5);
      at(density, i, j) = static_cast<float>(
          noise.periodic_fractal3(x + 0.55 * bend, y + 0.8 * bend, 7.5, kCells, 4, 0.5));
    }
  });
  constexpr float kTexels = 3.0f;
  const int dx = static_cast<int>(std::lround(kTexels * to_light.x));
  const int dy = static_cast<int>(std::lround(kTexels * to_light.y));
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i) at(side, i, j) = at(density, i, j) - at(density, i + dx, j + dy);
  });
  float mean = 0.0f;
  for (const float x : density) mean += x / static_cast<float>(density.size());
  variance = 0.0f;
  for (float& x : density) {
    x -= mean;
    variance += x * x / static_cast<float>(density.size());
  }
  texture::pack_map2(n, density, side, 0.0f, map, 0.0f, &workers);
}

float part_under_clouds(double height_m) {
  return static_cast<float>(smoothstep(0.0, kNearLayer_m, sky::kCloudHeight_m - height_m));
}

Clouds make_clouds(const WorldState& world, double t_s, glm::dvec3 eye, PartSet without) {
  Clouds clouds;
  const scene::Scene& scene = world.scene;
  const double height_m = sky::kCloudHeight_m - eye.z;
  clouds.shown = static_cast<float>(smoothstep(0.0, kNearLayer_m, std::abs(height_m)));
  clouds.any = scene.sky.cloud_cover > 0.0 && clouds.shown > 0.0f && !without.has(Part::kClouds);
  if (!clouds.any) return clouds;
  clouds.is_below = height_m < 0.0;
  clouds.any = !clouds.is_below;
  const texture::PackedMap2& map = world.sky->clouds;
  float variance = 0.0f;
  for (std::size_t i = 0; i < Clouds::kLayers; ++i) {
    clouds.layers[i] = make_cloud_layer(map, kPeriods_m[i], kGains[i], glm::dvec2(eye),
                                        drift_m(scene.sea, kPeriods_m[i], t_s));
    variance += kGains[i] * kGains[i] * world.sky->cloud_variance;
  }
  clouds.inv_deviation = 1.0f / std::sqrt(std::max(variance, 1e-8f));
  const float region_gain = kRegionGain * std::sqrt(variance / world.sky->cloud_variance);
  clouds.regions = make_layer(map, kRegionPeriod_m, region_gain, glm::dvec2(eye),
                              drift_m(scene.sea, kRegionPeriod_m, t_s));
  clouds.height_m = static_cast<float>(height_m);
  clouds.light = world.sky->cloud_light;
  return clouds;
}

}  // namespace swell::render
