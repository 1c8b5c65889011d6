// Which parts a world shares with others, and that they are those which it would make itself.
#include <gtest/gtest.h>

#include <array>

#include "render/measures.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

scene::Scene small_coast() {
  scene::Scene scene = load_shipped("beach");
  scene.trees = {{.density_per_m2 = 0.001}};
  scene.sea.resolution = 32;
  return scene;
}

// The parts that two worlds have in common, in the order of this text when all are.
constexpr const char* kAll =
    "sea whitecaps coast air sky terrain maps shadow forest shore shelter near ";
std::string common(const World& a, const World& b) {
  const WorldState &x = a.state(), &y = b.state();
  std::string text;
  const auto add = [&](const char* name, const auto& p, const auto& q) {
    EXPECT_TRUE(p && q) << name;
    if (p == q) text += std::string(name) + " ";
  };
  add("sea", x.sea, y.sea);
  add("whitecaps", x.whitecaps, y.whitecaps);
  add("coast", x.coast, y.coast);
  add("air", x.atmosphere, y.atmosphere);
  add("sky", x.sky, y.sky);
  add("terrain", x.terrain, y.terrain);
  add("maps", x.terrain_maps, y.terrain_maps);
  add("shadow", x.land_shadow, y.land_shadow);
  add("forest", x.forest, y.forest);
  add("shore", x.shore, y.shore);
  add("shelter", x.shelter, y.shelter);
  add("near", x.near_shore, y.near_shore);
  return text;
}

TEST(WorldParts, AreSharedWithAWorldThatWasMadeOfTheSame) {
  const scene::Scene scene = small_coast();
  const World world(scene);
  const auto like_it = [&](const scene::Scene& other) { return World(other, world, 1); };

  // What no part is made of, and what adds one.
  scene::Scene other = scene;
  other.round_earth = !other.round_earth;
  other.camera.eye_m.z += 1.0;
  other.water.body_colour.x *= 0.5f;
  other.area.size_m = glm::dvec2(5000.0);
  other.detail.terrain_method = scene::TerrainMethod::kRays;
  const World same = like_it(other);
  EXPECT_EQ(common(world, same), kAll);
  EXPECT_NE(same.state().land_rays, nullptr);

  other = scene;
  other.sea.wind_speed_mps *= 0.5;
  EXPECT_EQ(common(world, like_it(other)), "air sky terrain maps shadow forest shore ");

  other = scene;
  other.sky.sun_elevation_rad *= 0.5;
  other.sky.sun_direction =
      sky::sun_direction(other.sky.sun_azimuth_rad, other.sky.sun_elevation_rad);
  EXPECT_EQ(common(world, like_it(other)),
            "sea whitecaps coast air terrain maps shore shelter near ");

  other = scene;
  other.terrain->beach_slope *= 1.5;
  EXPECT_EQ(common(world, like_it(other)), "sea air sky ");

  other = scene;
  other.sky.turbidity += 1.0;  // the sun stays
  other.trees[0].seed += 1;
  EXPECT_EQ(common(world, like_it(other)),
            "sea whitecaps coast terrain maps shadow shore shelter near ");

  other = scene;
  other.coast.seed += 1;
  other.water.refraction_index = 1.2;
  EXPECT_EQ(common(world, like_it(other)), "sea air sky terrain maps forest shore shelter ");
}

TEST(WorldParts, ComeFromAnyOfManyWorlds) {
  const scene::Scene sunny = load_shipped("open_ocean");
  scene::Scene windy = sunny, both = sunny;
  windy.sea.wind_speed_mps += 3.0;
  windy.sky.cloud_seed += 1;
  both.sea = windy.sea;
  const World first(sunny), second(windy, first, 2);
  const World third(both, std::array{&first, &second}, 2);
  EXPECT_EQ(third.state().sky, first.state().sky);
  EXPECT_EQ(third.state().sea, second.state().sea);
  EXPECT_EQ(third.state().textures.foam, first.state().textures.foam);
  EXPECT_EQ(difference(small_shot(third, 2.0).target, small_shot(World(both), 2.0).target), "");
}

TEST(WorldParts, OutliveTheWorldsThatTheyCameFrom) {
  const scene::Scene scene = load_shipped("open_ocean");
  auto first = std::make_unique<World>(scene);
  auto second = std::make_unique<World>(scene, *first, 1);
  const auto sky = first->state().sky;
  first.reset();
  const World third(scene, *second, 1);
  EXPECT_EQ(third.state().sky, sky);
}

// Shapes of objects are parts, too: one for all of a kind.
TEST(WorldParts, AreSharedWithinAWorld) {
  const World world(load_shipped("buoys"));
  const auto& objects = world.scene().objects;
  const auto& shapes = world.state().objects.of_object;
  ASSERT_GT(objects.size(), 2u);
  for (std::size_t i = 1; i < objects.size(); ++i)
    EXPECT_EQ(shapes[i] == shapes[0],
              objects[i].kind == objects[0].kind && objects[i].top_mark == objects[0].top_mark)
        << i;
}

}  // namespace
}  // namespace swell::render
