#include "apps/view/scene_choice.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "math/elementary.h"
#include "sky/sky_light.h"

namespace swell::view {
namespace {

// A scene that is described alike has the same dump.
std::string dump_after(const scene::Scene& scene, const SceneChoice& choice) {
  return scene::dump_scene(with_choice(scene, choice));
}

TEST(SceneChoice, TheScenesOwnChoiceChangesNothing) {
  for (const auto& entry : std::filesystem::directory_iterator(SWELL_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const scene::Scene scene = scene::load_scene(entry.path());
    EXPECT_EQ(dump_after(scene, scene_choice(scene)), scene::dump_scene(scene)) << entry.path();
  }
}

TEST(SceneChoice, EachChoiceIsReadBackFromTheSceneThatItMakes) {
  scene::Scene scene = scene::parse_scene("[terrain]\n[air]\nvisibility_m = 900\n", "a.toml");
  SceneChoice choice = scene_choice(scene);
  choice.air.sun_azimuth_rad = 1.0;
  choice.air.sun_elevation_rad = 0.5;
  choice.air.clouds = scene::CloudKind::kLayer;
  choice.air.cover = 0.7;
  choice.air.thin_cover = 0.1;
  choice.air.visibility_m = 300.0;
  choice.coast = scene::CoastModel::kBlend;
  choice.detail.terrain_method = scene::TerrainMethod::kRays;
  const SceneChoice again = scene_choice(with_choice(scene, choice));
  EXPECT_EQ(again.air, choice.air);
  EXPECT_EQ(again.coast, choice.coast);
  EXPECT_EQ(again.detail.terrain_method, choice.detail.terrain_method);
}

TEST(AirChoice, FogGoesAndComes) {
  const scene::Scene foggy = scene::parse_scene("air.attenuation_per_m = [0.01, 0.01, 0.01]", "f");
  AirChoice choice = air_choice(foggy);
  EXPECT_TRUE(choice.fog);
  EXPECT_NEAR(choice.visibility_m, 391.2, 0.1);  // ln 50 / B
  choice.fog = false;
  const scene::Scene clear = with_air(foggy, choice);
  EXPECT_FALSE(clear.air.attenuation_per_m);
  EXPECT_FALSE(clear.air.visibility_m);
  choice.fog = true;
  EXPECT_EQ(with_air(clear, choice).air.visibility_m, choice.visibility_m);
}

TEST(AirChoice, TheTimePlacesTheSunAsInAFile) {
  const scene::Scene scene = scene::parse_scene("", "a.toml");
  AirChoice choice = air_choice(scene);
  choice.by_time = true;
  choice.hour_utc = 15.5;
  const scene::Scene chosen = with_air(scene, choice);
  const scene::Scene file = scene::parse_scene("sky.time_utc = \"2026-06-21T15:30:00Z\"", "a.toml");
  EXPECT_EQ(chosen.sky, file.sky);
  EXPECT_NEAR(air_choice(file).hour_utc, 15.5, 1e-6);

  // By hand again, the sun moves and knows no time.
  AirChoice by_hand = air_choice(file);
  by_hand.by_time = false;
  by_hand.sun_elevation_rad = 0.25;
  const scene::Sky sky = with_air(file, by_hand).sky;
  EXPECT_EQ(sky.time_utc, "");
  EXPECT_EQ(sky.sun_elevation_rad, 0.25);
  EXPECT_EQ(sky.sun_direction, sky::sun_direction(sky.sun_azimuth_rad, 0.25));
}

}  // namespace
}  // namespace swell::view
