// Making a scene ready to draw: maps of the sky and the land, which do not change with time.
#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "render/labels/classes.h"
#include "render/world/world_state.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/sky.h"
#include "scene/terrain.h"
#include "texture/foam_pattern.h"
#include "texture/normal_map.h"
#include "texture/perlin.h"

namespace swell::render {
namespace {

constexpr int kSharpSkySize = 768, kSoftSkySize = 256;
// Waves too small to see spread what they mirror: no cloud's edge is sharp in the sea.
constexpr int kSoftSkyBlur = 5;
constexpr int kBumpSize = 256, kFoamSize = 256;
constexpr std::uint64_t kFoamSeed = 4;
constexpr int kTerrainMapSize = 1024;

std::uint32_t encode_byte(float x) {
  return static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f);
}

std::uint32_t encode_rgb(glm::vec3 linear, float range) {
  const auto code = [&](float c) { return encode_byte(std::sqrt(std::max(c, 0.0f) / range)); };
  return code(linear.x) | code(linear.y) << 8 | code(linear.z) << 16 | 0xff000000u;
}

// The direction that a sky map's texel shows; outside the horizon's circle it points below.
glm::vec3 sky_direction(int x, int y, int size) {
  const float u = (2.0f * (static_cast<float>(x) + 0.5f)) / static_cast<float>(size) - 1.0f;
  const float v = (2.0f * (static_cast<float>(y) + 0.5f)) / static_cast<float>(size) - 1.0f;
  const float r2 = u * u + v * v;
  return glm::vec3(2.0f * u, 2.0f * v, 1.0f - r2) / (1.0f + r2);
}

// Box filter of half width `radius` along rows (step 3 floats) or columns, edges repeated.
void blur(std::vector<float>& rgb, int size, int radius, bool along_rows) {
  std::vector<float> result(rgb.size());
  const std::ptrdiff_t step = along_rows ? 3 : 3 * size, line = along_rows ? 3 * size : 3;
  const float weight = 1.0f / static_cast<float>(2 * radius + 1);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      for (int c = 0; c < 3; ++c) {
        float sum = 0.0f;
        for (int k = i - radius; k <= i + radius; ++k)
          sum += rgb[static_cast<std::size_t>(j * line + std::clamp(k, 0, size - 1) * step + c)];
        result[static_cast<std::size_t>(j * line + i * step + c)] = weight * sum;
      }
    }
  }
  rgb.swap(result);
}

// blur_radius: two box filters of this half width each way, in texels.
texture::RgbaImage build_sky_map(const scene::Sky& sky, const texture::PerlinNoise& clouds,
                                 int size, int blur_radius) {
  std::vector<float> rgb;
  rgb.reserve(static_cast<std::size_t>(3 * size * size));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      glm::vec3 d = sky_direction(x, y, size);
      d.z = std::max(d.z, -0.1f);
      const glm::vec3 radiance = scene::sky_radiance(sky, clouds, d);
      for (int c = 0; c < 3; ++c) rgb.push_back(radiance[c]);
    }
  }
  for (int pass = 0; pass < (blur_radius > 0 ? 2 : 0); ++pass) {
    blur(rgb, size, blur_radius, true);
    blur(rgb, size, blur_radius, false);
  }
  texture::RgbaImage image;
  texture::resize_image(size, size, image);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float* p = rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * size + x);
      image.texels[static_cast<std::size_t>(y) * image.stride + x] =
          encode_rgb({p[0], p[1], p[2]}, kLookupRange);
    }
  }
  texture::fill_padding(image);
  return image;
}

// Mean radiance of the sky weighted by the cosine to the zenith: rings of equal weight.
glm::vec3 ambient_radiance(const scene::Sky& sky, const texture::PerlinNoise& clouds) {
  constexpr int kRings = 12, kSectors = 24;
  glm::vec3 sum(0.0f);
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;  // sin^2 of the zenith angle
    const float horizontal = std::sqrt(sin2), z = std::sqrt(1.0f - sin2);
    for (int j = 0; j < kSectors; ++j) {
      const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
      sum += scene::sky_radiance(
          sky, clouds,
          {horizontal * static_cast<float>(a.cos), horizontal * static_cast<float>(a.sin), z});
    }
  }
  return sum / static_cast<float>(kRings * kSectors);
}

texture::PackedMap2 build_bump_map(std::uint64_t seed) {
  const texture::SlopeMap slopes = texture::make_bump_slopes(kBumpSize, seed);
  texture::PackedMap2 map;
  texture::pack_map2(kBumpSize, slopes.x, slopes.y, 0.0f, map);
  return map;
}

// Reflectance of the ground by height, steepness and noise: sand, then scrub and forest, rock
// where it is steep, grey-green growth in deeper water.
glm::vec3 ground_albedo(float height_m, float steepness, float noise, float clumps) {
  const glm::vec3 sand =
      glm::mix(glm::vec3(0.58f, 0.50f, 0.36f), glm::vec3(0.68f, 0.61f, 0.47f), 0.5f + 0.5f * noise);
  const glm::vec3 wet_sand = sand * 0.62f;
  const glm::vec3 green =
      glm::mix(glm::vec3(0.035f, 0.075f, 0.020f), glm::vec3(0.14f, 0.18f, 0.05f),
               smoothstep(-0.35f, 0.45f, clumps + 0.3f * noise));
  const glm::vec3 rock =
      glm::mix(glm::vec3(0.20f, 0.18f, 0.16f), glm::vec3(0.34f, 0.31f, 0.27f), 0.5f + 0.5f * noise);
  const glm::vec3 reef(0.16f, 0.19f, 0.13f);
  glm::vec3 c = glm::mix(wet_sand, sand, smoothstep(0.1f, 0.7f, height_m));
  c = glm::mix(c, green, smoothstep(1.8f, 4.0f, height_m + 1.5f * noise));
  c = glm::mix(c, rock, smoothstep(0.55f, 0.9f, steepness + 0.15f * noise));
  if (height_m < -0.5f) c = glm::mix(sand, reef, 0.75f * smoothstep(0.15f, 0.5f, noise));
  return c;
}

}  // namespace

SkyMaps build_sky_maps(const scene::Sky& sky) {
  const texture::PerlinNoise clouds(sky.cloud_seed);
  return {build_sky_map(sky, clouds, kSharpSkySize, 0),
          build_sky_map(sky, clouds, kSoftSkySize, kSoftSkyBlur), ambient_radiance(sky, clouds)};
}

TerrainMaps build_terrain_maps(const terrain::HeightGrid& terrain, std::uint64_t seed) {
  constexpr int n = kTerrainMapSize;
  const double step = terrain.grid.size_m() / n;
  const std::vector<float> height =
      terrain::resample(terrain, {terrain.grid.min_world, step, n, n}).height_m;
  const auto at = [&](int i, int j) {
    return height[static_cast<std::size_t>(std::clamp(j, 0, n - 1)) * n + std::clamp(i, 0, n - 1)];
  };

  TerrainMaps maps;
  texture::resize_image(n, n, maps.albedo);
  const texture::PerlinNoise noise(seed);
  std::vector<float> slope_x(height.size()), slope_y(height.size());
  const float inv_span = static_cast<float>(0.5 / step);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * n + i;
      slope_x[k] = (at(i + 1, j) - at(i - 1, j)) * inv_span;
      slope_y[k] = (at(i, j + 1) - at(i, j - 1)) * inv_span;
      const float steepness = std::sqrt(slope_x[k] * slope_x[k] + slope_y[k] * slope_y[k]);
      const auto patchiness =
          static_cast<float>(noise.fractal2(i * step / 14.0, j * step / 14.0, 5, 0.6));
      const auto clumps =
          static_cast<float>(noise.fractal2(i * step / 5.0 + 31.7, j * step / 5.0, 3, 0.7));
      maps.albedo.texels[static_cast<std::size_t>(j) * maps.albedo.stride + i] = encode_rgb(
          ground_albedo(height[k], steepness, std::clamp(patchiness, -1.0f, 1.0f), clumps), 1.0f);
    }
  }
  texture::fill_padding(maps.albedo);
  texture::pack_map2(n, slope_x, slope_y, 0.0f, maps.slopes);
  return maps;
}

namespace {

// The part that the sea's own waves give up to the trains.
std::vector<float> build_coast_share(const ocean::CoastSea& coast) {
  constexpr int n = kCoastMapSize;
  const terrain::Grid& floor = coast.trains.grid;
  const terrain::Grid grid{floor.min_world, floor.size_m() / n, n, n};
  std::vector<glm::dvec2> p;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) p.push_back(grid.point(i, j));
  std::vector<float> share(p.size());
  ocean::sample_coast_share(coast, p, share);
  for (float& x : share) x = 1.0f - ocean::spectrum_weight(x);
  return share;
}

texture::PackedMap2 build_foam_pattern() {
  std::vector<float> threshold = texture::make_foam_pattern(kFoamSize, kFoamSeed);
  for (float& x : threshold) x = 2.0f * x - 1.0f;
  texture::PackedMap2 map;
  texture::pack_map2(kFoamSize, threshold, threshold, 1.0f / 127.0f, map);
  return map;
}

template <class T>
std::shared_ptr<const T> share(T value) {
  return std::make_shared<const T>(std::move(value));
}

// like: of another coast, or null.
CoastMaps build_coast_maps(const ocean::CoastSea& coast, const CoastMaps* like, int threads) {
  Workers workers(threads);
  return {ocean::make_coast_map(coast, kCoastMapSize, workers), build_coast_share(coast),
          like ? like->foam_pattern : share(build_foam_pattern())};
}

// The parts of a world. like: one that describes the part alike, or null.

void add_sky(const World::State* like, World::State& state) {
  state.sky = like ? like->sky : share(build_sky_maps(state.scene.sky));
}

void add_sea(const World::State* like, World::State& state) {
  state.sea = like ? like->sea : std::make_shared<const ocean::Sea>(state.scene.sea);
}

void add_bump(const World::State* like, World::State& state) {
  state.bump = like ? like->bump : share(build_bump_map(state.scene.sea.seed));
}

void add_terrain(const World::State* like, World::State& state) {
  if (!state.scene.terrain) return;
  state.terrain = like ? like->terrain : share(*scene::build_terrain(state.scene));
  state.terrain_maps = like ? like->terrain_maps
                            : share(build_terrain_maps(*state.terrain, state.scene.terrain->seed));
}

// like: may have another coast.
void add_coast(const World::State* like, bool same_coast, int threads, World::State& state) {
  if (same_coast) {
    state.coast = like->coast;
    state.coast_maps = like->coast_maps;
  } else if (auto coast = scene::build_coast(state.scene, state.terrain.get(), threads)) {
    state.coast = share(std::move(*coast));
    state.coast_maps =
        share(build_coast_maps(*state.coast, like ? like->coast_maps.get() : nullptr, threads));
  }
}

void add_relief_bounds(const World::State* like, World::State& state) {
  if (!state.terrain || !state.scene.detail.normals_count()) return;
  const terrain::HeightGrid& terrain = *state.terrain;
  state.relief_bounds = like && like->relief_bounds
                            ? like->relief_bounds
                            : share(lod::ReliefBounds(terrain.height_m, terrain.grid.samples_x,
                                                      terrain.grid.spacing_m));
}

// like: may be null.
std::unique_ptr<World::State> make_state(scene::Scene scene, const World::State* like,
                                         int threads) {
  scene::check_scene(scene);
  SWELL_CHECK(threads >= 1 && threads <= 256, "threads={}", threads);
  auto state = std::make_unique<World::State>(World::State{.scene = std::move(scene)});
  const scene::Scene& now = state->scene;
  const auto if_alike = [&](bool is_alike) { return is_alike ? like : nullptr; };
  const bool same_sea = like && like->scene.sea == now.sea;
  const bool same_terrain = like && like->scene.terrain == now.terrain;
  const bool same_coast = same_sea && same_terrain && like->scene.coast == now.coast;
  add_sky(if_alike(like && like->scene.sky == now.sky), *state);
  add_sea(if_alike(same_sea), *state);
  add_bump(if_alike(like && like->scene.sea.seed == now.sea.seed), *state);
  add_terrain(if_alike(same_terrain), *state);
  add_relief_bounds(if_alike(same_terrain), *state);
  add_coast(like, same_coast, threads, *state);
  state->objects = build_object_meshes(now.objects);
  state->object_classes = object_classes(now);
  state->focuses = object_focuses(now.objects);
  return state;
}

}  // namespace

World::World(scene::Scene scene)
    : state_(make_state(std::move(scene), nullptr, available_cpus())) {}
World::World(scene::Scene scene, const World& like, int threads)
    : state_(make_state(std::move(scene), &like.state(), threads)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
const scene::Scene& World::scene() const { return state().scene; }

}  // namespace swell::render
