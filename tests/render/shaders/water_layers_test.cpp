// Which waves the water shader shows: all that the scene has, and near a coast the right part of
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "math/random.h"
#include "math/simd_target.h"
#include "ocean/water_surface.h"
#include "render/drawn_water.h"
#include "render/measures.h"
#include "render/shaders/optics_kernels.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kTime_s = 3.0;

constexpr double kLayersEye_m = 12.0;

// Pictures of a scene whose sea alone is made anew.
struct DrawnLike : DrawnWater {
  DrawnLike(const scene::Scene& scene, const World& like)
      : DrawnWater(World(scene, like, 1), kTime_s) {}
};

TEST(WaterLayers, EverySineIsShaded) {
  scene::Scene scene = shading_scene(kLayersEye_m);
  scene.sea.spectrum = false;
  for (std::size_t i = 0; i < ocean::kMaxSines; ++i)
    scene.sea.sines.push_back({.amplitude_m = 0.02,
                               .wavelength_m = 2.0 + 0.1 * static_cast<double>(i),
                               .to_rad = 0.09 * static_cast<double>(i)});
  const World like = world_of(scene);
  const DrawnLike whole(scene, like);
  for (std::size_t i = 0; i < ocean::kMaxSines; ++i) {
    scene::Scene without = scene;
    without.sea.sines[i].amplitude_m = 0.0;
    EXPECT_GT(different_pixels(whole.target, DrawnLike(without, like).target), 300) << "sine " << i;
  }
}

TEST(WaterLayers, EveryPatchAndBothLayersOfRipplesAreShaded) {
  scene::Scene scene = shading_scene(kLayersEye_m);
  scene.sea.patch_lengths_m.clear();
  const World like = world_of(shading_scene(kLayersEye_m));
  double length_m = 4000.0;
  for (std::size_t patches = 1; patches <= ocean::kMaxPatches; ++patches) {
    scene.sea.patch_lengths_m.push_back(length_m *= 0.4);
    const DrawnLike drawn(scene, like);
    const Water& water = drawn.water();
    ASSERT_EQ(water.layer_count, static_cast<int>(patches) + 2);
    for (std::size_t i = 0; i < patches; ++i)
      EXPECT_EQ(water.layers[i].map, &drawn.state().sea->patch_slopes[i]);

    scene::Scene smooth = scene;
    smooth.water.bump_strength = 0.0;
    EXPECT_GT(different_pixels(drawn.target, DrawnLike(smooth, like).target), 300) << patches;
  }
}

// Trains alone: nothing of the open sea's long waves is left.
TEST(WaterLayers, RipplesStayNearTheShoreHoweverManyPatchesTheSeaHas) {
  scene::Scene scene = shading_scene(kLayersEye_m);
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-400.0, -40.0}, {400.0, -40.0}};
  scene.terrain->beach_size_m = 800.0;
  scene.coast.model = scene::CoastModel::kTrains;
  scene.coast.trains = 1;
  scene.coast.grid_spacing_m = 10.0;
  const World like = world_of(scene);
  for (const std::size_t patches : {0, 1, 2, 3}) {
    scene::Scene with_ripples = scene;
    with_ripples.sea.spectrum = patches > 0;
    if (patches > 0) with_ripples.sea.patch_lengths_m.assign({640.0, 97.0, 17.0});
    if (patches > 0) with_ripples.sea.patch_lengths_m.resize(patches);
    scene::Scene without = with_ripples;
    without.water.bump_strength = 0.0;
    const DrawnLike a(with_ripples, like), b(without, like);
    EXPECT_GT(different_pixels(a.target, b.target), 1000) << patches << " patches";
  }
}

// ---- The shader's own numbers

class WaterShader : public testing::TestWithParam<SimdTarget> {
 protected:
  void SetUp() override {
    if (!simd_target_available(GetParam())) GTEST_SKIP() << "this CPU lacks the target";
    select_simd_target(GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Targets, WaterShader, testing::ValuesIn(simd_targets()),
                         [](const auto& test) {
                           return std::string(simd_target_name(test.param));
                         });

constexpr float kBaseVariance = 0.0012f;

// Maps of one value everywhere, and water that has nothing but them and one sine.
struct PlainWater {
  PlainWater(float share_of_trains, float wavelength_m) {
    constexpr int kTexels = 16;
    const std::vector<float> zero(kTexels * kTexels), share(kTexels * kTexels, share_of_trains);
    texture::pack_map2(kTexels, zero, zero, 1.0f / 127.0f, still);
    texture::pack_map2(kTexels, share, zero, 1.0f / 127.0f, surf);
    water.uv_noise = water.trains.slopes = water.foam_lace = layer(still);
    water.trains.surf = layer(surf);
    water.trains.on = true;
    water.base_variance = kBaseVariance;
    // Its slope is largest under the eye.
    water.sines[0] = {.kx = 1.0f / wavelength_m,
                      .slope_x = 0.3f,
                      .slope_y = -0.4f,
                      .wavelength_log2 = std::log2(wavelength_m)};
    water.sine_count = 1;
  }

  // The eye is over the middle of the map.
  static SlopeLayer layer(const texture::PackedMap2& map) {
    return make_square_layer(map, 1e6, glm::dvec2(5e5));
  }

  texture::PackedMap2 still, surf;
  Water water;
};

SeenWater seen_below(const Water& water, float height_m) {
  const glm::vec3 below(0.0f, 0.0f, -height_m);
  SeenWater seen;
  sample_water(water, ViewRays{}, 1, {&below, 1}, {&seen, 1});
  return seen;
}

constexpr float kShare = 64.0f / 127.0f;  // what a map holds exactly

// A pixel is 0.001 of the depth wide.
TEST_P(WaterShader, TrainsTakeTheirShareOfTheSlopesThatAreSeen) {
  const PlainWater plain(kShare, 100.0f);
  const SeenWater s = seen_below(plain.water, 10.0f);
  EXPECT_NEAR(s.slope.x, (1.0f - kShare) * 0.3f, 1e-5f);
  EXPECT_NEAR(s.slope.y, (1.0f - kShare) * -0.4f, 1e-5f);
  EXPECT_NEAR(s.variance, kBaseVariance, 1e-6f);
}

// Slopes scaled by a factor have their variance scaled by its square: here 0.25 / 2 of a sine too
// short to see.
TEST_P(WaterShader, TrainsTakeTheSquareOfTheirShareOfTheVariance) {
  const PlainWater plain(kShare, 0.001f);
  const SeenWater s = seen_below(plain.water, 1000.0f);
  EXPECT_EQ(s.slope, glm::vec2(0.0f));
  EXPECT_NEAR(s.variance, kBaseVariance + (1.0f - kShare) * (1.0f - kShare) * 0.125f, 1e-6f);
}

// ---- Packets side by side

// Near a shore some packets lie among the trains, some across their edge and some at sea, each of
// which takes its own way through the shader.
scene::Scene shore_scene() {
  scene::Scene scene = shading_scene(kLayersEye_m);
  scene.sea.patch_lengths_m = {640.0, 97.0, 17.0};
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-400.0, 0.0}, {400.0, 0.0}};
  scene.terrain->beach_size_m = 800.0;
  scene.coast.model = scene::CoastModel::kBlend;
  scene.coast.trains = 1;
  scene.coast.grid_spacing_m = 10.0;
  return scene;
}

// Runs of 16 places, a packet or two, within a few metres of each other; the runs are anywhere
// within 600 m of the eye's foot.
std::vector<glm::vec3> scattered_runs(int count) {
  std::vector<glm::vec3> p;
  for (int i = 0; i < 16 * count; ++i) {
    const auto within = [&](float metres, std::uint64_t seed, int n) {
      return metres * static_cast<float>(2.0 * random_uniform(seed, n) - 1.0);
    };
    p.emplace_back(within(600.0f, 1, i / 16) + within(3.0f, 3, i),
                   within(600.0f, 2, i / 16) + within(3.0f, 4, i), -12.0f);
  }
  return p;
}

std::vector<SeenWater> seen_at(const Water& water, const ViewRays& rays, int packets_at_once,
                               const std::vector<glm::vec3>& p) {
  std::vector<SeenWater> seen(p.size());
  sample_water(water, rays, packets_at_once, p, seen);
  return seen;
}

TEST_P(WaterShader, ShowsTheSameHoweverManyPacketsAreSideBySide) {
  for (const bool has_coast : {true, false}) {
    scene::Scene scene = shore_scene();
    if (!has_coast) scene.coast = {};
    const World like = world_of(scene);  // whose maps the drawn water refers to
    const DrawnLike drawn(scene, like);
    const Shading& shading = drawn.shading();
    const Water& water = shading.material<Water>();
    ASSERT_EQ(water.trains.on, has_coast);
    std::vector<glm::vec3> p = scattered_runs(300);
    p.resize(p.size() - 21);  // the last packets are not full
    std::vector<SeenWater> alone = seen_at(water, shading.rays, 1, p);
    EXPECT_EQ(seen_at(water, shading.rays, 3, p), alone);
    EXPECT_EQ(seen_at(water, shading.rays, 8, p), alone);
    // Nor does it matter which packets they are.
    std::ranges::reverse(p);
    std::ranges::reverse(alone);
    EXPECT_EQ(seen_at(water, shading.rays, 8, p), alone);
  }
}

}  // namespace
}  // namespace swell::render
