// A World is the same bits on any number of threads.
#include <gtest/gtest.h>

#include "ocean/open_sea/whitecaps.h"
#include "render/shot.h"
#include "render/sky/sky_maps.h"
#include "render/world/coast_maps.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

TEST(World, HasTheSameMapsOnAnyNumberOfThreads) {
  scene::Scene scene = load_shipped("beach");
  scene.coast.trains = 1;
  const World alone(scene, 1);
  const WorldState& a = alone.state();
  for (const int threads : {2, 7}) {
    const World shared(scene, threads);
    const WorldState& b = shared.state();
    ASSERT_EQ(a.sky->heights.size(), b.sky->heights.size());
    for (std::size_t i = 0; i < a.sky->heights.size(); ++i)
      EXPECT_EQ(a.sky->heights[i].map.channels, b.sky->heights[i].map.channels);
    EXPECT_EQ(a.sky->soft_clear, b.sky->soft_clear);
    EXPECT_EQ(a.sky->clouds.words, b.sky->clouds.words);
    EXPECT_EQ(a.sky->soft.words, b.sky->soft.words);
    EXPECT_EQ(a.sky->ambient, b.sky->ambient);
    EXPECT_EQ(a.terrain->height_m, b.terrain->height_m);
    EXPECT_EQ(a.terrain_maps->albedo.texels, b.terrain_maps->albedo.texels);
    EXPECT_EQ(a.terrain_maps->slopes.words, b.terrain_maps->slopes.words);
    EXPECT_EQ(a.coast_maps->waves.wave, b.coast_maps->waves.wave);
    EXPECT_EQ(a.coast_maps->waves.surf, b.coast_maps->waves.surf);
    EXPECT_EQ(a.coast_maps->ceded, b.coast_maps->ceded);
    EXPECT_EQ(a.textures.foam->words, b.textures.foam->words);
    EXPECT_EQ(a.whitecaps->patches.at(0).threshold, b.whitecaps->patches.at(0).threshold);
    EXPECT_EQ(a.textures.bump->words, b.textures.bump->words);
  }
}

TEST(World, RefusesANumberOfThreadsThatIsNone) {
  EXPECT_DEATH(World(scene::Scene{}, 0), "threads=0");
  EXPECT_DEATH(World(scene::Scene{}, 257), "threads=257");
}

}  // namespace
}  // namespace swell::render
