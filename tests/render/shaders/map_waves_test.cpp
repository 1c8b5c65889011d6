// Waves of periodic maps as they are drawn: their maps of slopes, and pictures without them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "ocean/open_sea/sea_state.h"
#include "ocean/water_surface.h"
#include "render/drawn_water.h"

namespace swell::render {
namespace {

scene::Scene lake_scene() {
  scene::Scene scene = shading_scene(20.0);
  scene.sea.spectrum = false;
  scene.sea.map_set = ocean::MapSet::kLake;
  scene.sea.wind_speed_mps = 4.5;
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
  const ocean::SeaFrame& frame = drawn.state().sea.frame;
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

TEST(MapWaves, CanBeLeftOut) {
  scene::Scene scene = lake_scene();
  scene.detail.triangulation = scene::Triangulation::kRoam;
  const World world = world_of(scene);
  DrawnWater drawn;
  drawn.draw(world, view_of(world, 3.0, 64, 48), 3.0, {.without = {Part::kMaps}});
  EXPECT_TRUE(drawn.state().sea.frame.patches.empty());
  EXPECT_TRUE(std::ranges::all_of(drawn.state().meshes.water.height_m,
                                  [](float height_m) { return height_m == 0.0f; }));
  drawn.draw_small(world, 3.0);
  EXPECT_EQ(drawn.state().sea.frame.patches.size(), 7u);
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
