// Waves of periodic maps as they are drawn: their maps of slopes, and pictures without them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "ocean/open_sea/periodic_map.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/water_surface.h"
#include "render/drawn_looks.h"
#include "render/drawn_water.h"
#include "render/shaders/shader_kernels.h"
#include "render/view/meshes.h"
#include "scene/water.h"
#include "scratch_folder.h"

namespace swell::render {
namespace {

scene::Scene lake_scene() {
  scene::Scene scene = shading_scene(20.0);
  scene.sea.spectrum = false;
  scene.sea.map_set = ocean::MapSet::kLake;
  scene.sea.wind_speed_mps = 4.5;
  return scene;
}

// Maps of 30 by 12 m and of 5 by 17 m.
scene::Scene stretched_scene(const ScratchFolder& folder) {
  scene::Scene scene = shading_scene(20.0);
  ocean::MapRecipe recipe;
  recipe.size = 32, recipe.frames = 16, recipe.peak_waves = 2.0;
  const std::string file =
      folder.write("waves.map", ocean::encode_map(ocean::make_periodic_map(recipe))).string();
  scene.sea.spectrum = false;
  scene.sea.maps = {{file, {30.0, 12.0}, 0.0, 0.4}, {file, {5.0, 17.0}, 0.0, 0.2}};
  return scene;
}

std::array<int, 4> bytes_of(std::uint64_t quad, int channel) {
  std::array<int, 4> bytes;
  for (int k = 0; k < 4; ++k)
    bytes[static_cast<std::size_t>(k)] =
        static_cast<std::int8_t>(quad >> (32 * channel + 8 * k) & 0xff);
  return bytes;
}

// PER-05: the four codes of a bilinear sample lie in one 32-bit half of a word, and give the same
// bits as four texels one by one, over the seam as well; and they are the map's slopes.
TEST(MapWaves, OneWordHasAllThatABilinearSampleNeeds) {
  const World world = world_of(lake_scene());
  const DrawnWater drawn(world, 3.0);
  const ocean::SeaFrame& frame = drawn.state().sea->frame;
  ASSERT_EQ(frame.patches.size(), 7u);
  for (std::size_t layer = 0; layer < frame.patches.size(); ++layer) {
    const texture::PackedMap2& map = *drawn.water().layers[layer].map;
    const int size = map.size;
    ASSERT_EQ(size, frame.patches[layer].resolution);
    const texture::PackedWord* const words = map.words.data() + map.level_offset[0];
    const auto word = [&](int i, int j) {
      return words[static_cast<std::size_t>((j % size) * size + i % size)].fine;
    };
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        for (const int channel : {0, 1}) {
          const auto code = [&](int x, int y) { return bytes_of(word(x, y), channel)[0]; };
          const std::array<int, 4> quad = bytes_of(word(i, j), channel);
          const int u = (37 * i + 11 * j) & 255, v = (91 * i + 5 * j) & 255;
          const int packed = (256 - v) * ((256 - u) * quad[0] + u * quad[1]) +
                             v * ((256 - u) * quad[2] + u * quad[3]);
          const int plain = (256 - v) * ((256 - u) * code(i, j) + u * code(i + 1, j)) +
                            v * ((256 - u) * code(i, j + 1) + u * code(i + 1, j + 1));
          ASSERT_EQ(packed, plain) << layer << " " << i << " " << j;
        }
        const auto at = static_cast<std::size_t>(j * size + i);
        ASSERT_NEAR(map.scale * static_cast<float>(bytes_of(word(i, j), 0)[0]),
                    frame.patches[layer].slope_x[at], 0.501f * map.scale);
      }
    }
  }
}

// Slopes are codes of a scale, at places of 1/256 texel.
TEST(MapWaves, StretchedOnesAreShadedAsTheyAreAsked) {
  const ScratchFolder folder;
  scene::Scene scene = stretched_scene(folder);
  scene.sea.tiling = false;
  const World world = world_of(scene);
  const DrawnWater drawn(world, 3.0);
  std::vector<glm::dvec2> places;
  std::vector<glm::vec3> from_eye;
  for (int n = 0; n < 400; ++n) {
    from_eye.emplace_back(0.37f * static_cast<float>(n), 60.0f - 0.53f * static_cast<float>(n),
                          -20.0f);
    places.emplace_back(from_eye.back());
  }
  const std::vector<float> finest(places.size(), -20.0f);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const SlopeLayer& shaded = drawn.water().layers[layer];
    ocean::SeaFrame alone;
    alone.patches = {drawn.state().sea->frame.patches[layer]};
    std::vector<glm::vec3> got(places.size());
    add_slopes(shaded, from_eye, finest, got);
    std::vector<float> x(places.size()), y(places.size());
    ocean::sample_slopes(alone, places, x, y);
    const float bound = 0.75f * shaded.map->scale;
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_NEAR(got[i].x, x[i], bound) << layer << " " << i;
      ASSERT_NEAR(got[i].y, y[i], bound) << layer << " " << i;
    }
    const glm::dvec2 length_m = alone.patches[0].length_m;
    EXPECT_NEAR(shaded.log2_texels_per_m, std::log2(32.0 / std::min(length_m.x, length_m.y)), 1e-5);
  }
}

TEST(MapWaves, VerticesHaveTheHeightsThatQueriesGive) {
  const ScratchFolder folder;
  scene::Scene packed_scene = lake_scene();
  packed_scene.sea.map_heights = ocean::MapHeights::kPacked;
  for (scene::Scene scene : {lake_scene(), stretched_scene(folder), packed_scene}) {
    scene.detail.triangulation = scene::Triangulation::kRoam;
    const World world = world_of(scene);
    const DrawnWater drawn(world, 3.0);
    const scene::Water water(scene);
    ocean::SeaFrame frame;
    Workers workers(1);
    const scene::WaterSurface surface = water.at(3.0, frame, workers);
    const Surface& mesh = drawn.state().meshes.water;
    float highest_m = 0.0f;
    for (std::size_t v = 0; v < mesh.height_m.size(); ++v) {
      const glm::dvec2 p = vertex_world(mesh, v);
      if (!shows_all_waves(mesh, view_of(world, 3.0, 64, 48), v)) continue;
      ASSERT_EQ(mesh.height_m[v], surface.height(p)) << p.x << " " << p.y;
      highest_m = std::max(highest_m, mesh.height_m[v]);
    }
    EXPECT_GT(highest_m, 0.1f);
  }
}

TEST(MapWaves, CanBeLeftOut) {
  scene::Scene scene = lake_scene();
  scene.detail.triangulation = scene::Triangulation::kRoam;
  const World world = world_of(scene);
  DrawnWater drawn;
  drawn.draw(world, view_of(world, 3.0, 64, 48), 3.0, {.without = {Part::kMaps}});
  EXPECT_TRUE(drawn.state().sea->frame.patches.empty());
  EXPECT_TRUE(std::ranges::all_of(drawn.state().meshes.water.height_m,
                                  [](float height_m) { return height_m == 0.0f; }));
  drawn.draw_small(world, 3.0);
  EXPECT_EQ(drawn.state().sea->frame.patches.size(), 7u);
}

// What the eye sees of slopes is on the whole what a wind raises, maps and ripples together.
TEST(MapWaves, RipplesFillWhatTheMapsLeaveOfTheWindsSlopes) {
  const World world = world_of(lake_scene());
  const DrawnWater drawn(world, 0.0);
  double variance = drawn.water().base_variance;
  for (int i = 0; i < drawn.water().layer_count; ++i) {
    const SlopeLayer& layer = drawn.water().layers[static_cast<std::size_t>(i)];
    variance += layer.map->lost_variance.back() * layer.gain * layer.gain;
  }
  EXPECT_NEAR(variance, 0.003 + 0.00512 * 4.5, 0.2 * (0.003 + 0.00512 * 4.5));
}

}  // namespace
}  // namespace swell::render
