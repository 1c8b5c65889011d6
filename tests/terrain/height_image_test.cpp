// Land from height images.
#include "terrain/height_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "terrain/terrain.h"

namespace fs = std::filesystem;

namespace swell::terrain {
namespace {

TEST_F(HeightImage, GreyLevelsGoFromLowToHighAboveTheSeaLevel) {
  // Binary PGM of 2 x 2: top row black and white, bottom row 51 and 102 of 255.
  const fs::path path = write("a.pgm", std::string("P5\n2 2\n255\n\x00\xff\x33\x66", 15));
  const HeightGrid terrain = build_terrain({.height_image = path,
                                            .metres_per_pixel = 10.0,
                                            .low_m = -20.0,
                                            .high_m = 80.0,
                                            .sea_level_m = 5.0,
                                            .centre_m = {100.0, 200.0}});
  ASSERT_EQ(terrain.grid.samples_x, 2);
  EXPECT_EQ(terrain.grid.size_m(), 10.0);
  EXPECT_EQ(terrain.grid.min_world, glm::dvec2(95.0, 195.0));
  const std::vector<float> expected = {-5.0f, 15.0f, -25.0f, 75.0f};  // south first
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(terrain.height_m[k], expected[k], 1e-5f) << k;
  EXPECT_EQ(terrain.lowest_m, terrain.height_m[2]);
  EXPECT_EQ(terrain.highest_m, terrain.height_m[3]);
}

TEST_F(HeightImage, SixteenBitImagesKeepTheirSteps) {
  // A PNG of 0, 1 in the top row and 2, 65535 in the bottom row.
  constexpr std::array<unsigned char, 75> kPng = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x07,
      0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x12, 0x49, 0x44, 0x41, 0x54, 0x08, 0xd7, 0x63, 0x60,
      0x60, 0x60, 0x60, 0x64, 0x60, 0x60, 0xfa, 0xff, 0x1f, 0x00, 0x03, 0x13, 0x02, 0x02, 0x41,
      0x43, 0x5b, 0x09, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const fs::path path = write("a.png", std::string(kPng.begin(), kPng.end()));
  const HeightGrid terrain = build_terrain({.height_image = path, .low_m = 0.0, .high_m = 65535.0});
  const std::vector<float> expected = {2.0f, 65535.0f, 0.0f, 1.0f};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(terrain.height_m[k], expected[k], 4e-3f) << k;
}

TEST_F(HeightImage, FloatImagesHoldMetres) {
  const fs::path path = write_exr("a.exr", 2, 2, {1.5f, -2.5f, 300.0f, -11999.0f});
  const HeightGrid terrain =
      build_terrain({.height_image = path, .low_m = 7.0, .high_m = 9.0, .sea_level_m = 0.5});
  EXPECT_EQ(terrain.height_m, (std::vector<float>{299.5f, -11999.5f, 1.0f, -3.0f}));
}

TEST_F(HeightImage, OnePixelIsAFlatSquareOfItsSize) {
  const HeightGrid terrain =
      build_terrain({.height_image = write_exr("a.exr", 1, 1, {3.25f}), .metres_per_pixel = 4.0});
  EXPECT_EQ(terrain.grid.samples_x, 2);
  EXPECT_EQ(terrain.grid.size_m(), 4.0);
  EXPECT_EQ(terrain.height_m, std::vector<float>(4, 3.25f));
  const glm::dvec2 p(0.3, -0.7);
  float height = 0.0f;
  sample_heights(terrain, {&p, 1}, {&height, 1});
  EXPECT_EQ(height, 3.25f);
}

TEST_F(HeightImage, AnySideWorks) {
  for (const int side : {2, 3, 5, 17, 100}) {
    std::vector<float> pixels(static_cast<std::size_t>(side) * side);
    for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<float>(k);
    const HeightGrid terrain =
        build_terrain({.height_image = write_exr("a.exr", side, side, std::move(pixels))});
    EXPECT_EQ(terrain.grid.samples_x, side);
    EXPECT_EQ(terrain.height_m[0], static_cast<float>(side * (side - 1)));  // south west corner
  }
}

TEST_F(HeightImage, ImagesThatAreNotSquareAreRefused) {
  const fs::path path = write_exr("a.exr", 3, 2, std::vector<float>(6, 0.0f));
  EXPECT_EQ(
      error_of({.height_image = path}),
      path.string() + ": height image, got 3 x 2 pixels, allowed a square of 1 to 4096 a side");
}

TEST_F(HeightImage, ImagesOf20000ASideAreRefused) {
  // The header of a PNG, of which nothing else is read.
  constexpr std::array<unsigned char, 33> kPng = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00,
      0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x4e, 0x20, 0x00, 0x00,
      0x4e, 0x20, 0x08, 0x00, 0x00, 0x00, 0x00, 0xc6, 0x1b, 0x19, 0xe5};
  const fs::path path = write("a.png", std::string(kPng.begin(), kPng.end()));
  EXPECT_EQ(error_of({.height_image = path}),
            path.string() + ": the size is 20000x20000, allowed: 1x1 to 4096x4096");
}

TEST_F(HeightImage, HeightsOutOfRangeAreRefusedWithTheirPixel) {
  const fs::path path = write_exr("a.exr", 2, 2, {0.0f, 0.0f, 0.0f, 12001.0f});
  EXPECT_EQ(error_of({.height_image = path}),
            path.string() + ": height at pixel (1, 1), got 12001, allowed -12000 to 12000 m");
}

TEST_F(HeightImage, HeightsThatAreNoNumberAreRefusedWithTheirPixel) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    const fs::path path = write_exr("a.exr", 2, 2, {0.0f, bad, 0.0f, 0.0f});
    const std::string error = error_of({.height_image = path});
    EXPECT_NE(error.find(path.string()), std::string::npos) << error;
    EXPECT_NE(error.find("1, 0"), std::string::npos) << error;
  }
}

TEST_F(HeightImage, ValuesThatMakeNoTerrainAreRefused) {
  EXPECT_EQ(error_of({.island_radius_m = 0.0}),
            "terrain.island_radius_m, got 0, allowed finite and over 0");
  EXPECT_EQ(error_of({.floor_depth_m = -1.0}),
            "terrain.floor_depth_m, got -1, allowed finite and over 0");
  EXPECT_EQ(error_of({.island_height_m = std::nan("")}),
            "terrain.island_height_m, got nan, allowed finite and over -inf");
}

TEST_F(HeightImage, BrokenFilesAreRefusedByName) {
  const fs::path path = write("a.png", "\x89PNG\r\n\x1a\nrubbish");
  EXPECT_NE(error_of({.height_image = path}).find(path.string()), std::string::npos);
  EXPECT_NE(error_of({.height_image = folder_ / "none.png"}).find("none.png"), std::string::npos);
}

}  // namespace
}  // namespace swell::terrain
