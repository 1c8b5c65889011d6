// The grid of a coast's trains, and how scenes make them.
#include "scene/coast.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "math/random.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/terrain.h"
#include "scene/water.h"
#include "terrain/height_image.h"

namespace swell::scene {
namespace {

std::string parse_error_of(const std::string& text) {
  try {
    parse_scene(text, "test.toml");
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

template <class Make>
std::string scene_error_of(Make make) {
  try {
    make();
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

// A beach 600 m long with trains.
Scene beach_scene(int trains, double grid_spacing_m) {
  Scene scene;
  scene.sea.resolution = 16;
  scene.terrain.emplace().coast_m = {{-300.0, 0.0}, {300.0, 0.0}};
  scene.terrain->beach_size_m = 600.0;
  scene.coast.model = CoastModel::kTrains;
  scene.coast.trains = trains;
  scene.coast.grid_spacing_m = grid_spacing_m;
  return scene;
}

std::string text_of_fault(const Coast& coast, double size_m) {
  const auto fault = fault_of_coast_grid(coast, size_m);
  return fault ? fault_text(*fault) : "";
}

TEST(CoastGrid, TooFineASpacingIsRefusedWithItsLineAndTheLeast) {
  const std::string beach = "[terrain]\ncoast_m = [[0, 0], [9, 0]]\nbeach_size_m = 1200\n",
                    trains = "[coast]\ngrid_spacing_m = 0.5\ntrains = 16\n",
                    fault =
                        "coast.grid_spacing_m, got 0.5, allowed 0 or 1.18 to 100 m with trains = "
                        "16 over 1200 m of terrain";
  EXPECT_EQ(parse_error_of(beach + trains), "test.toml:5: column 18: " + fault);
  EXPECT_EQ(parse_error_of(trains + beach), "test.toml:2: column 18: " + fault);
  EXPECT_EQ(parse_error_of(trains + "model = \"none\"\n" + beach), "");
  EXPECT_EQ(parse_error_of(trains), "");
  EXPECT_EQ(parse_error_of(trains + "[terrain]\n"), "");  // an island has no trains of itself
  EXPECT_EQ(
      parse_error_of("[terrain]\nisland_radius_m = 600\n" + trains + "model = \"blend\""),
      "test.toml:4: column 18: coast.grid_spacing_m, got 0.5, allowed 0 or 2.41 to 100 m with "
      "trains = 16 over 2460 m of terrain");
}

TEST(CoastGrid, HasAtMost2048CellsASideAndSixteenMillionTimesTrains) {
  const auto fault = [](double size_m, int trains, double spacing_m) {
    return text_of_fault(beach_scene(trains, spacing_m).coast, size_m);
  };
  EXPECT_EQ(fault(1024.0, 4, 0.5), "");  // 2048 cells, 2^24 with 4 trains
  EXPECT_EQ(fault(1024.5, 1, 0.5),
            "coast.grid_spacing_m, got 0.5, allowed 0 or 0.51 to 100 m with trains = 1 over 1024.5 "
            "m of terrain");
  EXPECT_EQ(fault(1024.0, 5, 0.5),
            "coast.grid_spacing_m, got 0.5, allowed 0 or 0.56 to 100 m with trains = 5 over 1024 m "
            "of terrain");
  EXPECT_EQ(fault(1024.0, 16, 1.0), "");
  EXPECT_NE(fault(1024.0, 16, 0.99), "");
  EXPECT_EQ(fault(4e6, 1, 100.0),
            "coast.grid_spacing_m, got 100, allowed 0 with trains = 1 over 4e+06 m of terrain");
  EXPECT_EQ(fault(HUGE_VAL, 1, 100.0),
            "coast.grid_spacing_m, got 100, allowed 0 with trains = 1 over inf m of terrain");
}

TEST(CoastGrid, TakesTheLeastSpacingThatAFaultNames) {
  for (int trains = 1; trains <= 16; ++trains) {
    for (std::uint64_t n = 0; n < 200; ++n) {
      const double size_m = 1030.0 + std::floor(40000.0 * random_uniform(3, n)) / 4.0;
      Coast coast = beach_scene(trains, 0.25).coast;
      const std::string fault = text_of_fault(coast, size_m);
      const std::size_t at = fault.find("allowed 0 or ");
      ASSERT_NE(at, std::string::npos) << fault;
      coast.grid_spacing_m = std::stod(fault.substr(at + 13));
      ASSERT_EQ(text_of_fault(coast, size_m), "") << fault;
      coast.grid_spacing_m -= 0.01;
      ASSERT_NE(text_of_fault(coast, size_m), "") << fault;
    }
  }
}

// The spacing that is left out is always taken.
TEST(CoastGrid, OfTheDefaultSpacingHas256Cells) {
  for (const double size_m : {1.0, 600.0, 1e7})
    EXPECT_EQ(text_of_fault(beach_scene(16, 0.0).coast, size_m), "");
  EXPECT_EQ(Water(beach_scene(1, 0.0)).coast()->trains.cells_x, 256);
}

TEST(CoastGrid, IsAsFineAsTheSceneAsks) {
  for (const double spacing_m : {2.3, 5.0, 6.1, 100.0}) {
    const Water water(beach_scene(1, spacing_m));
    const terrain::Grid& grid = water.coast()->trains.grid;
    EXPECT_LE(grid.spacing_m, spacing_m);
    EXPECT_GT(grid.spacing_m, 600.0 / (600.0 / spacing_m + 1.0));
    EXPECT_DOUBLE_EQ(grid.spacing_m * (grid.samples_x - 1), 600.0);
  }
}

TEST(CoastGrid, OfAProgramsOwnSceneIsCheckedToo) {
  const auto error_of = [](double spacing_m, double wind_mps) {
    Scene scene = beach_scene(16, spacing_m);
    scene.sea.wind_speed_mps = wind_mps;
    return scene_error_of([&] { Water{scene}; });
  };
  const std::string allowed = ", allowed 0 or 0.59 to 100 m with trains = 16 over 600 m of terrain";
  // A calm as well: its wind may rise.
  for (const double wind_mps : {0.0, 8.0}) {
    EXPECT_EQ(error_of(0.55, wind_mps), "scene: coast.grid_spacing_m, got 0.55" + allowed);
  }
}

using CoastOverAnImage = terrain::HeightImage;

TEST_F(CoastOverAnImage, IsCheckedWhenItsSizeIsKnown) {
  Scene scene = beach_scene(1, 0.5);
  scene.terrain = {.height_image = write_exr("a.exr", 3, 3, std::vector<float>(9, -5.0f)),
                   .metres_per_pixel = 1000.0};
  EXPECT_EQ(scene_error_of([&] { Water{scene}; }),
            "scene: coast.grid_spacing_m, got 0.5, allowed 0 or 0.98 to 100 m with trains = 1 over "
            "2000 m of terrain");
}

TEST(CoastGrid, IsAnnouncedIfItTakesLong) {
  EXPECT_EQ(slow_coast_text(beach_scene(16, 1.0)), "making 16 wave trains on 601 x 601 points");
  EXPECT_EQ(slow_coast_text(beach_scene(16, 2.0)), "");
  EXPECT_EQ(slow_coast_text(beach_scene(16, 0.0)), "");
  Scene scene = beach_scene(16, 1.0);
  scene.sea.wind_speed_mps = 0.0;  // no waves, no trains
  EXPECT_EQ(slow_coast_text(scene), "");
  scene = beach_scene(16, 1.0);
  scene.coast.model = CoastModel::kNone;
  EXPECT_EQ(slow_coast_text(scene), "");
  scene = beach_scene(5, 2.0);
  scene.terrain = {.height_image = "not_opened.png"};
  EXPECT_EQ(slow_coast_text(scene), "making 5 wave trains on points 2 m apart");
  scene.terrain.reset();
  EXPECT_EQ(slow_coast_text(scene), "");
}

// Far from the shore, where no wave breaks.
TEST(CoastTrains, HaveTheAmplitudeScaleOfTheWindsOtherWaves) {
  Scene scene = beach_scene(3, 10.0);
  scene.sea.wind_speed_mps = 5.0;
  const Water plain(scene);
  for (const double scale : {0.0, 0.5, 2.0}) {
    scene.sea.amplitude_scale = scale;
    const Water water(scene);
    const glm::dvec2 p[] = {{-100.0, 200.0}, {0.0, 210.0}, {120.0, 220.0}};
    std::array<float, 3> height{}, expected{};
    ocean::sample_trains(water.coast()->trains, 3.0, p, height);
    ocean::sample_trains(plain.coast()->trains, 3.0, p, expected);
    for (int i = 0; i < 3; ++i)
      EXPECT_FLOAT_EQ(height[i], static_cast<float>(scale) * expected[i]) << scale;
  }
}

TEST(SceneTerrain, IsRefusedWithTheTextOfTheTerrainsFault) {
  const TerrainDescription flat{.island_radius_m = 0.0};
  std::string text;
  try {
    terrain::build_terrain(flat);
  } catch (const terrain::TerrainError& error) {
    text = error.what();
  }
  EXPECT_EQ(text, "terrain.island_radius_m, got 0, allowed finite and over 0");
  Scene scene;
  EXPECT_FALSE(build_terrain(scene));
  scene.terrain = flat;
  EXPECT_EQ(scene_error_of([&] { build_terrain(scene); }), "scene: " + text);
}

TEST(SceneTerrain, FaultsThatShowWhenItIsBuiltHaveTheirPlace) {
  Workers workers(2);
  const auto fault_of = [&](const std::string& text, std::vector<std::string> settings = {}) {
    const std::string start =
        "[terrain]\nisland_radius_m = 100\n"
        "[[lake]]\nlevel_m = -100\noutline_m = [[0, 0], [9, 0], [0, 9]]\n[[lake]]\n";
    const Scene scene = parse_scene(start + text, "test.toml", settings);
    return scene_error_of([&] { build_ground(scene, workers); });
  };
  const std::string dry =
      "lake[1].position_m, got [9000, 0], which is dry, allowed a place lower than 0 m";
  EXPECT_EQ(fault_of("position_m = [9000, 0]\n"), "test.toml:7: column 14: " + dry);
  EXPECT_EQ(fault_of("", {"lake[1].position_m=[9000, 0]"}),
            "setting lake[1].position_m=[9000, 0]: " + dry);
  // Without the key itself: its table.
  EXPECT_EQ(fault_of("level_m = -30\n"),
            "test.toml:6: column 1: lake[1].position_m, got [0, 0], which is dry, allowed a place "
            "lower than -30 m");
  EXPECT_EQ(fault_of("level_m = 400\n[[river]]\nsurface_m = [1, 0]\npath_m = [[9, 0], [9000, 0]]\n",
                     {"lake="}),
            "test.toml:10: column 10: river[0].path_m, got [225, 0], allowed points on the "
            "terrain's square");
  const Scene json = parse_scene(R"({"terrain.seed": 3, "lake": [{"level_m": -30}]})", "a.json");
  EXPECT_EQ(scene_error_of([&] { build_ground(json, workers); }),
            "a.json: lake[0].position_m, got [0, 0], which is dry, allowed a place lower than "
            "-30 m");
}

// ---- In a sea that loops

TEST(CoastLoop, TrainsAreAsTheyWereALoopAgo) {
  Scene scene = beach_scene(3, 10.0);
  scene.sea.loop_s = 31.5;
  const Water water(scene);
  Workers workers(1);
  const auto heights_at = [&](double t_s) {
    ocean::SeaFrame frame;
    const WaterSurface surface = water.at(t_s, frame, workers);
    std::vector<float> heights;
    for (int i = 0; i < 200; ++i)
      heights.push_back(surface.height(
          {500.0 * random_uniform(3, 2 * i) - 250.0, 10.0 + 200.0 * random_uniform(3, 2 * i + 1)}));
    return heights;
  };
  const std::vector<float> first = heights_at(4.125);
  EXPECT_EQ(heights_at(4.125 + 31.5), first);
  EXPECT_EQ(heights_at(4.125 - 315.0), first);
  EXPECT_NE(heights_at(4.125 + 10.0), first);
}

// By whole periods: each within half of one of what it would be.
TEST(CoastLoop, TrainsKeepTheirPeriodsAsNearlyAsTheLoopAllows) {
  Scene scene = beach_scene(4, 10.0);
  const std::vector<double> free_s = Water(scene).coast()->trains.period_s;
  scene.sea.loop_s = 60.0;
  const std::vector<double> looping_s = Water(scene).coast()->trains.period_s;
  ASSERT_EQ(looping_s.size(), free_s.size());
  for (std::size_t i = 0; i < free_s.size(); ++i) {
    const double turns = 60.0 / looping_s[i];
    EXPECT_NEAR(turns, std::round(turns), 1e-9) << i;
    EXPECT_LE(std::abs(turns - 60.0 / free_s[i]), 0.5) << i;
  }
}

}  // namespace
}  // namespace swell::scene
