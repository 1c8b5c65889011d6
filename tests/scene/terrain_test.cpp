#include "scene/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <thread>

#include "math/random.h"
#include "scene/coast.h"
#include "scene/scene.h"
#include "scene/water_surface.h"
#include "texture/image_io.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

class TerrainImage : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "swell_terrain_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  // A float image of one channel.
  fs::path write_exr(const std::string& name, int width, int height,
                     std::vector<float> pixels) const {
    const texture::ImageF image{width, height, 1, std::move(pixels)};
    texture::write_file(folder_ / name, texture::encode_image(image, ".exr"));
    return folder_ / name;
  }

  static std::string error_of(const TerrainDescription& description) {
    try {
      build_terrain(description);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(TerrainImage, GreyLevelsGoFromLowToHighAboveTheSeaLevel) {
  // Binary PGM of 2 x 2: top row black and white, bottom row 51 and 102 of 255.
  const fs::path path = write("a.pgm", std::string("P5\n2 2\n255\n\x00\xff\x33\x66", 15));
  const Terrain terrain = build_terrain({.height_image = path,
                                         .metres_per_pixel = 10.0,
                                         .low_m = -20.0,
                                         .high_m = 80.0,
                                         .sea_level_m = 5.0,
                                         .centre_m = {100.0, 200.0}});
  ASSERT_EQ(terrain.samples, 2);
  EXPECT_EQ(terrain.size_m(), 10.0);
  EXPECT_EQ(terrain.min_world, glm::dvec2(95.0, 195.0));
  const std::vector<float> expected = {-5.0f, 15.0f, -25.0f, 75.0f};  // south first
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(terrain.height_m[k], expected[k], 1e-5f) << k;
  EXPECT_EQ(terrain.lowest_m, terrain.height_m[2]);
  EXPECT_EQ(terrain.highest_m, terrain.height_m[3]);
}

TEST_F(TerrainImage, SixteenBitImagesKeepTheirSteps) {
  // A PNG of 0, 1 in the top row and 2, 65535 in the bottom row.
  constexpr std::array<unsigned char, 75> kPng = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x07,
      0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x12, 0x49, 0x44, 0x41, 0x54, 0x08, 0xd7, 0x63, 0x60,
      0x60, 0x60, 0x60, 0x64, 0x60, 0x60, 0xfa, 0xff, 0x1f, 0x00, 0x03, 0x13, 0x02, 0x02, 0x41,
      0x43, 0x5b, 0x09, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const fs::path path = write("a.png", std::string(kPng.begin(), kPng.end()));
  const Terrain terrain = build_terrain({.height_image = path, .low_m = 0.0, .high_m = 65535.0});
  const std::vector<float> expected = {2.0f, 65535.0f, 0.0f, 1.0f};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(terrain.height_m[k], expected[k], 4e-3f) << k;
}

TEST_F(TerrainImage, FloatImagesHoldMetres) {
  const fs::path path = write_exr("a.exr", 2, 2, {1.5f, -2.5f, 300.0f, -11999.0f});
  const Terrain terrain =
      build_terrain({.height_image = path, .low_m = 7.0, .high_m = 9.0, .sea_level_m = 0.5});
  EXPECT_EQ(terrain.height_m, (std::vector<float>{299.5f, -11999.5f, 1.0f, -3.0f}));
}

TEST_F(TerrainImage, OnePixelIsAFlatSquareOfItsSize) {
  const Terrain terrain =
      build_terrain({.height_image = write_exr("a.exr", 1, 1, {3.25f}), .metres_per_pixel = 4.0});
  EXPECT_EQ(terrain.samples, 2);
  EXPECT_EQ(terrain.size_m(), 4.0);
  EXPECT_EQ(terrain.height_m, std::vector<float>(4, 3.25f));
  const glm::dvec2 p(0.3, -0.7);
  float height = 0.0f;
  sample_heights(terrain, {&p, 1}, {&height, 1});
  EXPECT_EQ(height, 3.25f);
}

TEST_F(TerrainImage, AnySideWorks) {
  for (const int side : {2, 3, 5, 17, 100}) {
    std::vector<float> pixels(static_cast<std::size_t>(side) * side);
    for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<float>(k);
    const Terrain terrain =
        build_terrain({.height_image = write_exr("a.exr", side, side, std::move(pixels))});
    EXPECT_EQ(terrain.samples, side);
    EXPECT_EQ(terrain.height_m[0], static_cast<float>(side * (side - 1)));  // south west corner
  }
}

TEST_F(TerrainImage, ImagesThatAreNotSquareAreRefused) {
  const fs::path path = write_exr("a.exr", 3, 2, std::vector<float>(6, 0.0f));
  EXPECT_EQ(
      error_of({.height_image = path}),
      path.string() + ": height image, got 3 x 2 pixels, allowed a square of 1 to 4096 a side");
}

TEST_F(TerrainImage, HeightsOutOfRangeAreRefusedWithTheirPixel) {
  const fs::path path = write_exr("a.exr", 2, 2, {0.0f, 0.0f, 0.0f, 12001.0f});
  EXPECT_EQ(error_of({.height_image = path}),
            path.string() + ": height at pixel (1, 1), got 12001, allowed -12000 to 12000 m");
}

TEST_F(TerrainImage, HeightsThatAreNoNumberAreRefusedWithTheirPixel) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    const fs::path path = write_exr("a.exr", 2, 2, {0.0f, bad, 0.0f, 0.0f});
    const std::string error = error_of({.height_image = path});
    EXPECT_NE(error.find(path.string()), std::string::npos) << error;
    EXPECT_NE(error.find("1, 0"), std::string::npos) << error;
  }
}

TEST_F(TerrainImage, ValuesThatMakeNoTerrainAreRefused) {
  EXPECT_EQ(error_of({.island_radius_m = 0.0}),
            "terrain.island_radius_m, got 0, allowed finite and over 0");
  EXPECT_EQ(error_of({.floor_depth_m = -1.0}),
            "terrain.floor_depth_m, got -1, allowed finite and over 0");
  EXPECT_EQ(error_of({.island_height_m = std::nan("")}),
            "terrain.island_height_m, got nan, allowed finite and over -inf");
}

TEST_F(TerrainImage, BrokenFilesAreRefusedByName) {
  const fs::path path = write("a.png", "\x89PNG\r\n\x1a\nrubbish");
  EXPECT_NE(error_of({.height_image = path}).find(path.string()), std::string::npos);
  EXPECT_NE(error_of({.height_image = folder_ / "none.png"}).find("none.png"), std::string::npos);
}

Terrain small_terrain() {
  // 3 x 3, 2 m apart, from (10, 20): heights i + 10 j, but 100 in the middle.
  Terrain terrain{.min_world = {10.0, 20.0}, .spacing_m = 2.0, .samples = 3};
  terrain.height_m = {0, 1, 2, 10, 100, 12, 20, 21, 22};
  return terrain;
}

float height_at(const Terrain& terrain, glm::dvec2 p) {
  float height = 0.0f;
  sample_heights(terrain, {&p, 1}, {&height, 1});
  return height;
}

TEST(TerrainHeights, AreBilinearBetweenSamples) {
  const Terrain terrain = small_terrain();
  EXPECT_EQ(height_at(terrain, {10, 20}), 0.0f);
  EXPECT_EQ(height_at(terrain, {12, 22}), 100.0f);
  EXPECT_EQ(height_at(terrain, {14, 24}), 22.0f);
  EXPECT_EQ(height_at(terrain, {11, 20}), 0.5f);
  EXPECT_EQ(height_at(terrain, {10, 20.5}), 2.5f);
  EXPECT_EQ(height_at(terrain, {11, 21}), 27.75f);   // (0 + 1 + 10 + 100) / 4
  EXPECT_EQ(height_at(terrain, {13.5, 22}), 34.0f);  // 100 + (12 - 100) 3 / 4
}

TEST(TerrainHeights, AreThoseOfTheBorderOutside) {
  const Terrain terrain = small_terrain();
  EXPECT_EQ(height_at(terrain, {-1e9, -1e9}), 0.0f);
  EXPECT_EQ(height_at(terrain, {1e300, 20}), 2.0f);
  EXPECT_EQ(height_at(terrain, {12, 1e6}), 21.0f);
  EXPECT_EQ(height_at(terrain, {9, 23}), 15.0f);
}

TEST(TerrainHeights, AreTheSameOnManyThreads) {
  const Terrain terrain = build_terrain({});
  std::vector<glm::dvec2> points;
  for (int n = 0; n < 20000; ++n)
    points.push_back(1000.0 * glm::dvec2(random_uniform(1, 2 * n), random_uniform(1, 2 * n + 1)) -
                     500.0);
  std::vector<float> alone(points.size());
  sample_heights(terrain, points, alone);
  std::vector<std::vector<float>> together(4, std::vector<float>(points.size()));
  std::vector<std::thread> threads;
  for (auto& heights : together)
    threads.emplace_back([&] { sample_heights(terrain, points, heights); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& heights : together) EXPECT_EQ(heights, alone);
}

TEST(TerrainSlopes, AreCentralDifferences) {
  const Terrain terrain = small_terrain();
  std::vector<float> x(9), y(9);
  terrain_slopes(terrain, x, y);
  EXPECT_EQ(x, (std::vector<float>{0.5f, 0.5f, 0.5f, 45.0f, 0.5f, -44.0f, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(y, (std::vector<float>{5.0f, 49.5f, 5.0f, 5.0f, 5.0f, 5.0f, 5.0f, -39.5f, 5.0f}));
}

// Share of the samples whose height lies in [low, high].
double share(const Terrain& terrain, float low, float high) {
  const auto inside = [&](float h) { return h >= low && h <= high; };
  return static_cast<double>(std::ranges::count_if(terrain.height_m, inside)) /
         static_cast<double>(terrain.height_m.size());
}

const Terrain& island(std::uint64_t seed) {
  static std::map<std::uint64_t, Terrain> islands;
  const auto found = islands.find(seed);
  return found != islands.end()
             ? found->second
             : islands.emplace(seed, build_terrain({.seed = seed})).first->second;
}

class Island : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  const Terrain& terrain_ = island(GetParam());
};

TEST_P(Island, HasLandLagoonAndDeepFloor) {
  EXPECT_GT(share(terrain_, 0.0f, 1e9f), 0.08);
  EXPECT_GT(share(terrain_, -4.0f, -1.0f), 0.12);
  EXPECT_GT(share(terrain_, -14.0f, -13.9f), 0.2);
  EXPECT_EQ(terrain_.lowest_m, -14.0f);
  EXPECT_GT(terrain_.highest_m, 20.0f);
  EXPECT_LT(terrain_.highest_m, 60.0f);
}

TEST_P(Island, LiesInTheMiddleWithinItsFloor) {
  const int n = terrain_.samples;
  for (int k = 0; k < n; ++k) {
    for (const std::size_t border : {k, (n - 1) * n + k, k * n, k * n + n - 1})
      ASSERT_EQ(terrain_.height_m[border], -14.0f);
  }
  const glm::dvec2 middle = terrain_.min_world + 0.5 * terrain_.size_m();
  EXPECT_NEAR(middle.x, 0.0, 1e-9);
  EXPECT_NEAR(middle.y, 0.0, 1e-9);
  EXPECT_GT(height_at(terrain_, {0, 0}), 5.0f);
}

// Walking out from the middle, every direction meets a beach, then a belt of shallow water.
TEST_P(Island, IsRingedByShallowWater) {
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / 64.0;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    double shore = 0.0, shallow = 0.0;
    for (double r = 500.0; r > 0.0 && shore == 0.0; r -= 0.5) {
      const float height = height_at(terrain_, r * direction);
      if (height > 2.0f) shore = r;
      if (height >= -4.0f && height <= -0.5f) shallow += 0.5;
    }
    EXPECT_GT(shore, 60.0) << angle;
    EXPECT_LT(shore, 300.0) << angle;
    EXPECT_GT(shallow, 40.0) << angle;
  }
}

TEST_P(Island, HasGentleBeaches) {
  std::vector<float> x(terrain_.height_m.size()), y(x);
  terrain_slopes(terrain_, x, y);
  std::vector<float> slopes;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::abs(terrain_.height_m[k]) < 1.0f) slopes.push_back(std::hypot(x[k], y[k]));
  std::ranges::sort(slopes);
  ASSERT_FALSE(slopes.empty());
  EXPECT_GT(slopes[slopes.size() / 2], 1.0f / 40.0f);
  EXPECT_LT(slopes[slopes.size() / 2], 1.0f / 15.0f);
  EXPECT_LT(slopes[slopes.size() * 9 / 10], 1.0f / 7.0f);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Island, ::testing::Values(0, 1, 3));

// A square of 512 m with samples 1 m apart. The coast goes north along x = 20: sea in the west.
TerrainDescription straight_beach() {
  return {.floor_depth_m = 4.0,
          .coast_m = {{20.0, -50.0}, {20.0, 78.0}},
          .beach_slope = 0.03125,
          .beach_size_m = 512.0};
}

TEST(Beach, FillsItsSquareAroundTheMiddle) {
  TerrainDescription description = straight_beach();
  description.centre_m = {100.0, -30.0};
  const Terrain terrain = build_terrain(description);
  EXPECT_EQ(terrain.samples, 513);
  EXPECT_EQ(terrain.spacing_m, 1.0);
  EXPECT_EQ(terrain.min_world, glm::dvec2(-156.0, -286.0));
  EXPECT_EQ(terrain.height_m.size(), 513u * 513u);
}

TEST(Beach, IsOnePlaneUpToHalfAMetreAboveTheWater) {
  const Terrain terrain = build_terrain(straight_beach());
  for (const double y : {-256.0, -100.0, 0.0, 33.0, 256.0}) {
    EXPECT_EQ(height_at(terrain, {20, y}), 0.0f);
    EXPECT_EQ(height_at(terrain, {4, y}), -0.5f);  // 16 m out, 1:32
    EXPECT_EQ(height_at(terrain, {-76, y}), -3.0f);
    EXPECT_EQ(height_at(terrain, {36, y}), 0.5f);
    EXPECT_EQ(height_at(terrain, {21, y}), 0.03125f);
  }
}

TEST(Beach, EndsAtTheDepthOfTheFloor) {
  const Terrain terrain = build_terrain(straight_beach());
  EXPECT_EQ(terrain.lowest_m, -4.0f);
  EXPECT_EQ(height_at(terrain, {-107, 5}), -3.96875f);  // 1 m before
  EXPECT_EQ(height_at(terrain, {-108, 5}), -4.0f);
  EXPECT_EQ(height_at(terrain, {-256, 5}), -4.0f);
}

// A coast that turns by a right angle at the origin: west of x = 0 and south of y = 0 is land.
TEST(Beach, HasTheDepthOfTheNearestPointOfABrokenCoast) {
  const Terrain terrain = build_terrain({.floor_depth_m = 50.0,
                                         .coast_m = {{0.0, 60.0}, {0.0, 0.0}, {60.0, 0.0}},
                                         .beach_slope = 0.125,
                                         .beach_size_m = 512.0});
  EXPECT_EQ(height_at(terrain, {30, 8}), -1.0f);    // 8 m from the southern stretch
  EXPECT_EQ(height_at(terrain, {16, 100}), -2.0f);  // 16 m from the western one, beyond its end
  EXPECT_EQ(height_at(terrain, {-2, 30}), 0.25f);
  EXPECT_FLOAT_EQ(height_at(terrain, {-2, -2}), 0.35355339f);  // sqrt(8) m from the corner
}

TEST(Beach, RisesToLowDunesWithoutPools) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    TerrainDescription description = straight_beach();
    description.seed = seed;
    const Terrain terrain = build_terrain(description);
    EXPECT_GT(terrain.highest_m, 4.0f);
    EXPECT_LT(terrain.highest_m, 8.0f);
    for (int j = 0; j < terrain.samples; ++j)
      for (int i = 293; i < terrain.samples; ++i)  // x >= 37
        ASSERT_GT(terrain.height_m[static_cast<std::size_t>(j) * terrain.samples + i], 0.5f);
  }
}

TEST(Beach, KeepsItsPlaneForEverySeedOfTheDunes) {
  TerrainDescription description = straight_beach();
  const Terrain a = build_terrain(description);
  EXPECT_EQ(build_terrain(description).height_m, a.height_m);
  ++description.seed;
  const Terrain b = build_terrain(description);
  int different = 0;
  for (std::size_t k = 0; k < a.height_m.size(); ++k) {
    if (a.height_m[k] == b.height_m[k]) continue;
    ++different;
    ASSERT_GT(a.height_m[k], 0.5f);
  }
  EXPECT_GT(different, 10000);
}

TEST(Beach, BendsIntoTheDunesWithoutAnEdge) {
  const Terrain terrain = build_terrain(straight_beach());
  std::vector<float> x(terrain.height_m.size()), y(x);
  terrain_slopes(terrain, x, y);
  for (std::size_t k = 0; k < x.size(); ++k) {
    ASSERT_LT(std::hypot(x[k], y[k]), 0.2f) << k;
    if (std::abs(terrain.height_m[k] - 0.5f) < 0.05f) {
      ASSERT_NEAR(x[k], 0.03125f, 0.003f) << k;
    }
  }
}

TEST(Beach, IsFiniteAtTheEndsOfTheRanges) {
  for (const double slope : {0.001, 1.0}) {
    for (const double size : {50.0, 20000.0}) {
      const Terrain terrain = build_terrain({.centre_m = {1e6, 1e6},
                                             .floor_depth_m = 10000.0,
                                             .coast_m = {{-1e6, -1e6}, {-1e6, 1e6}},
                                             .beach_slope = slope,
                                             .beach_size_m = size});
      EXPECT_GT(terrain.lowest_m, 0.5f);  // false for NaN: all of it lies inland
      EXPECT_LT(terrain.highest_m, 8.0f);
    }
  }
}

TEST_F(TerrainImage, CoastsThatMakeNoBeachAreRefused) {
  EXPECT_EQ(error_of({.coast_m = {{1, 2}}}), "terrain.coast_m, got 1 point, allowed 2 or more");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}, {3, 4}}}),
            "terrain.coast_m[2], got [3, 4], allowed a point 0.001 m or more from the one "
            "before");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, HUGE_VAL}}}),
            "terrain.coast_m, north, got inf, allowed finite and over -inf");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}}, .beach_slope = 0.0}),
            "terrain.beach_slope, got 0, allowed finite and over 0");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}}, .beach_size_m = std::nan("")}),
            "terrain.beach_size_m, got nan, allowed finite and over 0");
  EXPECT_EQ(
      error_of({.height_image = write_exr("a.exr", 1, 1, {0.0f}), .coast_m = {{1, 2}, {3, 4}}}),
      "terrain.coast_m, got it besides height_image, allowed one of them");
}

TEST(IslandShape, IsAFunctionOfTheSeed) {
  EXPECT_EQ(build_terrain({.seed = 3}).height_m, island(3).height_m);
  EXPECT_NE(island(3).height_m, island(1).height_m);
}

TEST(IslandShape, IsFiniteAtTheEndsOfTheRanges) {
  struct Ends {
    double radius, height, depth;
  };
  for (const Ends& ends : {Ends{5, 5000, 0.5}, {5, 0, 10000}, {20000, 0, 0.5}}) {
    const Terrain terrain = build_terrain({.island_radius_m = ends.radius,
                                           .island_height_m = ends.height,
                                           .floor_depth_m = ends.depth});
    EXPECT_EQ(terrain.lowest_m, static_cast<float>(-ends.depth));
    EXPECT_GT(terrain.highest_m, 0.0f);
    EXPECT_LT(terrain.highest_m, 2.0 * ends.height + 10.0);  // false for NaN
  }
}

// ---- The grid of a coast's trains

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
    const ocean::FloorGrid& grid = water.coast()->trains.grid;
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

TEST_F(TerrainImage, ACoastsGridOverAnImageIsCheckedWhenItsSizeIsKnown) {
  Scene scene = beach_scene(1, 0.5);
  scene.terrain = {.height_image = write_exr("a.exr", 3, 3, std::vector<float>(9, -5.0f)),
                   .metres_per_pixel = 1000.0};
  EXPECT_EQ(scene_error_of([&] { Water{scene}; }),
            "coast.grid_spacing_m, got 0.5, allowed 0 or 0.98 to 100 m with trains = 1 over 2000 m "
            "of terrain");
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

TEST(CoastGrid, KnowsTheSizeOfATerrainBeforeItIsMade) {
  TerrainDescription island{.island_radius_m = 431.0};
  EXPECT_EQ(described_size_m(island), build_terrain(island).size_m());
  TerrainDescription beach{.coast_m = {{0.0, 0.0}, {9.0, 0.0}}, .beach_size_m = 777.7};
  EXPECT_EQ(described_size_m(beach), build_terrain(beach).size_m());
  EXPECT_EQ(described_size_m({.height_image = "a.png"}), std::nullopt);
}

}  // namespace
}  // namespace swell::scene
