// sea.douglas and sea.beaufort: what they set, what excludes them, how they are written out.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "ocean/spectrum/sea_scale.h"
#include "scene/scene_text.h"
#include "scene/water.h"

namespace swell::scene {
namespace {

TEST(SeaState, ACodeSetsTheWindAndThePatchLengths) {
  const Scene rough = parse_scene("[sea]\ndouglas = 5\n", "test.toml");
  EXPECT_NEAR(rough.sea.wind_speed_mps, 11.495, 1e-3);  // sqrt(3.25 g / 0.24131)
  EXPECT_NEAR(rough.sea.patch_lengths_m.at(0), 4.0 * 126.8, 1.0);
  EXPECT_EQ(rough.sea.patch_lengths_m.size(), 3u);
  const Scene gale = parse_scene("[sea]\nbeaufort = 8\n", "test.toml");
  EXPECT_NEAR(gale.sea.wind_speed_mps, 18.917, 1e-3);  // 0.836 8^1.5
  EXPECT_EQ(parse_scene("[sea]\ndouglas = 0\n", "test.toml").sea.wind_speed_mps, 0.0);
}

TEST(SeaState, EveryNumberOfBothScalesIsASea) {
  for (const auto& [key, last] : {std::pair{"douglas", 9}, std::pair{"beaufort", 12}}) {
    double wind_mps = -1.0;
    for (int code = 0; code <= last; ++code) {
      const Scene scene = parse_scene(fmt::format("[sea]\n{} = {}\n", key, code), "test.toml");
      EXPECT_GT(scene.sea.wind_speed_mps, wind_mps) << key << code;
      wind_mps = scene.sea.wind_speed_mps;
      ASSERT_EQ(scene.sea.patch_lengths_m.size(), 3u);
      EXPECT_GE(scene.sea.patch_lengths_m[0], 60.0);
      EXPECT_GT(scene.sea.patch_lengths_m[2], 1.0);
    }
  }
}

// With a floor, and trains asked for: none of them may divide by the wind.
TEST(SeaState, ACalmIsAMirror) {
  const Scene scene = parse_scene(
      "[sea]\ndouglas = 0\n[terrain]\nisland_radius_m = 60\n[coast]\nmodel = \"blend\"\n",
      "test.toml");
  const Water water(scene);
  Workers workers(1);
  ocean::SeaFrame frame;
  const WaterSurface surface = water.at(12.5, frame, workers);
  ocean::VelocityFrame velocity;
  ocean::advance_velocity(water.sea(), frame, velocity, workers);
  const std::vector<glm::dvec2> p = {{0.0, 0.0}, {70.0, -20.0}, {300.0, 400.0}, {5000.0, 0.0}};
  std::vector<float> height(p.size(), 1.0f);
  std::vector<glm::vec3> normal(p.size()), speed(p.size(), glm::vec3(1.0f));
  surface.heights(p, height);
  surface.normals(p, normal);
  surface.velocities(p, velocity, speed);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(height[i], 0.0f) << i;
    EXPECT_EQ(normal[i], glm::vec3(0.0f, 0.0f, 1.0f)) << i;
    EXPECT_EQ(speed[i], glm::vec3(0.0f)) << i;
  }
  const auto hit = surface.intersect({300.0, 400.0, 5.0}, {0.0, 0.6, -0.8}, 100.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance_m, 6.25, 1e-6);
}

TEST(SeaState, PatchLengthsOfTheFileStay) {
  const Scene scene =
      parse_scene("[sea]\npatch_lengths_m = [300, 40]\nbeaufort = 5\n", "test.toml");
  EXPECT_EQ(scene.sea.patch_lengths_m, (std::vector<double>{300.0, 40.0}));
}

TEST(SeaState, TheSeasGravityCounts) {
  const Scene scene = parse_scene("[sea]\ndouglas = 3\ngravity_mps2 = 3.7\n", "test.toml");
  EXPECT_NEAR(scene.sea.wind_speed_mps, 3.6733, 1e-3);  // sqrt(0.88 3.7 / 0.24131)
  EXPECT_EQ(error_of("[sea]\ndouglas = 9\ngravity_mps2 = 100\n"),
            "test.toml:2: column 11: sea.douglas, got 9 with a gravity of 100 m/s^2, which takes a "
            "wind of 82.7 m/s, allowed 60 m/s");
}

TEST(SeaState, TwoKeysForTheWindAreRefusedByBothLines) {
  EXPECT_EQ(error_of("[wind]\nspeed_mps = 10\n[sea]\ndouglas = 5\n"),
            "test.toml:2: column 13: wind.speed_mps, got it besides sea.douglas in line 4, allowed "
            "one of sea.douglas, sea.beaufort, wind.speed_mps");
  EXPECT_EQ(error_of("[sea]\ndouglas = 5\nbeaufort = 6\n"),
            "test.toml:3: column 12: sea.beaufort, got it besides sea.douglas in line 2, allowed "
            "one of sea.douglas, sea.beaufort, wind.speed_mps");
}

TEST(SeaState, CodesOutsideTheScalesAreRefused) {
  EXPECT_EQ(error_of("[sea]\ndouglas = 10\n"),
            "test.toml:2: column 11: sea.douglas, got 10, allowed an integer, 0 to 9");
  EXPECT_NE(error_of("[sea]\nbeaufort = -1\n"), "");
  EXPECT_NE(error_of("[sea]\nbeaufort = 3.5\n"), "");
}

TEST(SeaState, TheDumpKeepsTheCodeAndTellsTheWind) {
  const Scene scene = parse_scene("[sea]\ndouglas = 4\n", "test.toml");
  const std::string dump = dump_scene(scene);
  EXPECT_NE(dump.find("\ndouglas = 4\n"), std::string::npos) << dump;
  EXPECT_NE(dump.find("\n# speed_mps = 8.74"), std::string::npos) << dump;
  EXPECT_EQ(differences(scene, parse_scene(dump, "test.toml")), "");
  EXPECT_EQ(dump_scene(parse_scene("", "test.toml")).find("douglas"), std::string::npos);
}

}  // namespace
}  // namespace swell::scene
