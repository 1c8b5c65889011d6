// The water boundary as a picture: written, read again, painted over.
#include "terrain/boundary.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "terrain/height_image.h"

namespace swell::terrain {
namespace {

// A round small_island of 60 m radius on 65 x 65 points, 4 m apart.
HeightGrid small_island() {
  HeightGrid land{
      {.min_world = {-128.0, -128.0}, .spacing_m = 4.0, .samples_x = 65, .samples_y = 65}};
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i)
      land.height_m.push_back(
          static_cast<float>(0.1 * (60.0 - glm::length(land.grid.point(i, j)))));
  return land;
}

class Boundary : public HeightImage {
 protected:
  std::filesystem::path write_image(const std::string& name, const texture::ImageF& image) const {
    texture::write_file(folder_ / name, texture::encode_image(image, ".exr"));
    return folder_ / name;
  }
  // A small picture of one pixel's value.
  std::filesystem::path write_flat(int side, const std::vector<float>& pixel) const {
    texture::ImageF image{side, side, static_cast<int>(pixel.size()), {}};
    for (int k = 0; k < side * side; ++k)
      image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
    return write_image("flat.exr", image);
  }
  static std::string error_of(const std::filesystem::path& path) {
    try {
      read_boundary(path, small_island());
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(Boundary, HoldsDistanceDepthAndBankWithNorthOnTop) {
  Workers workers(1);
  HeightGrid land = small_island();
  for (int j = 0; j < 65; ++j)  // land all over the north
    for (int i = 0; i < 65; ++i)
      if (land.grid.point(i, j).y > 100.0) land.height_m[land.grid.index(i, j)] = 3.0f;
  const texture::ImageF image = boundary_image(ShoreMap(land, workers));
  ASSERT_EQ(image.width, image.height);
  ASSERT_EQ(image.channels, 4);
  const int middle = image.width / 2;
  // The small_island's middle: 60 m from the line, 6 m high; the floor south of it.
  EXPECT_NEAR(image.at(middle, middle, 0), -60.0f, 2.0f);
  EXPECT_EQ(image.at(middle, middle, 1), 0.0f);
  EXPECT_NEAR(image.at(middle, middle, 2), 6.0f, 1e-4f);
  EXPECT_EQ(image.at(middle, middle, 3), 1.0f);
  const int low = middle + 25, high = middle - 29;  // 100 m south, 116 m north
  EXPECT_NEAR(image.at(middle, low, 0), 40.0f, 2.0f);
  EXPECT_NEAR(image.at(middle, low, 1), 4.0f, 0.1f);
  EXPECT_EQ(image.at(middle, low, 2), 0.0f);
  EXPECT_NEAR(image.at(middle, high, 2), 3.0f, 1e-4f);
}

TEST_F(Boundary, IsTheSameMapToTheBitWhenReadAgain) {
  Workers workers(2);
  const HeightGrid land = small_island();
  const ShoreMap made(land, workers);
  const ShoreMap read = read_boundary(write_image("a.exr", boundary_image(made)), land);
  EXPECT_EQ(read.grid().samples_x, made.grid().samples_x);
  EXPECT_EQ(read.grid().min_world, made.grid().min_world);
  EXPECT_EQ(read.grid().spacing_m, made.grid().spacing_m);
  EXPECT_EQ(read.signed_distance_m(), made.signed_distance_m());
  EXPECT_EQ(read.height_m(), made.height_m());
  EXPECT_EQ(read.has_line(), made.has_line());
  EXPECT_EQ(read.surf_at(10.0, 90.0), made.surf_at(10.0, 90.0));
}

TEST_F(Boundary, MayBeOfAnotherSizeAndPaintedOver) {
  const ShoreMap read = read_boundary(write_flat(3, {12.0f, 2.0f, 0.0f, 0.25f}), small_island());
  EXPECT_EQ(read.grid().samples_x, 3);
  EXPECT_NEAR(read.grid().size_m(),
              ShoreMap(small_island(), *std::make_unique<Workers>(1)).grid().size_m(), 1e-9);
  EXPECT_EQ(read.sample(17.0, -60.0).signed_distance_m, 12.0f);
  EXPECT_EQ(read.sample(17.0, -60.0).height_m, -2.0f);
  EXPECT_EQ(read.surf_at(17.0, -60.0), 0.25f);
  EXPECT_FALSE(read.has_line());
}

// The picture's points over the terrain's square are the ground's: minus depths, and banks.
TEST_F(Boundary, MayBeTheGround) {
  Workers workers(1);
  texture::ImageF image = boundary_image(ShoreMap(small_island(), workers));
  const auto at = [&](int x, int y, std::size_t c) -> float& {
    return image.pixels[4 * static_cast<std::size_t>(y * image.width + x) + c];
  };
  const int middle = image.width / 2;
  at(middle, middle, 2) = 11.0f;  // a hill on the island's, a pit in the sea 100 m south
  at(middle, middle + 25, 1) = 9.0f;
  const HeightGrid land = small_island();
  const HeightGrid ground =
      ground_of_boundary(read_boundary(write_image("b.exr", image), land), land);
  ASSERT_EQ(ground.grid.samples_x, 65);
  EXPECT_EQ(ground.grid.spacing_m, 4.0);
  int same = 0;
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) {
      const auto x = static_cast<int>(ground.grid.point(i, j).x / 4.0) + middle,
                 y = middle - static_cast<int>(ground.grid.point(i, j).y / 4.0);
      EXPECT_EQ(ground.height_m[ground.grid.index(i, j)], at(x, y, 2) - at(x, y, 1));
      same += ground.height_m[ground.grid.index(i, j)] == land.height_m[land.grid.index(i, j)];
    }
  EXPECT_EQ(same, 65 * 65 - 2);
  EXPECT_EQ(height_at(ground, {0.0, 0.0}), 11.0);
  EXPECT_EQ(height_at(ground, {0.0, -100.0}), -9.0);
}

// A picture with points 1 m apart, of banks that rise by 1 in 2 to the north, on heights 4 m apart:
// the ground has its points, and banks their steepness.
TEST_F(Boundary, GivesBanksTheirReliefAndSteepness) {
  texture::ImageF image{513, 513, 4, {}};
  for (int y = 0; y < 513; ++y)
    for (int x = 0; x < 513; ++x) {
      const float height_m = 0.5f * static_cast<float>(256 - y) + (x % 2 == 0 ? 0.125f : -0.125f);
      for (const float value :
           {2.0f * -height_m, std::max(-height_m, 0.0f), std::max(height_m, 0.0f), 1.0f})
        image.pixels.push_back(value);
    }
  HeightGrid land = small_island();
  land.lowest_m = -13.0f;
  land.highest_m = 6.0f;
  land.apron = {128.0, -20.0};
  const HeightGrid ground =
      ground_of_boundary(read_boundary(write_image("c.exr", image), land), land);
  EXPECT_EQ(ground.grid.samples_x, 257);
  EXPECT_EQ(ground.grid.spacing_m, 1.0);
  EXPECT_EQ(ground.grid.size_m(), land.grid.size_m());
  EXPECT_NEAR(height_at(ground, {0.0, 50.0}) - height_at(ground, {1.0, 50.0}), 0.25, 1e-5);
  std::vector<float> slope_x(ground.grid.size()), slope_y(ground.grid.size());
  sample_slopes(ground, slope_x, slope_y);
  for (const std::size_t k : {ground.grid.index(128, 128), ground.grid.index(40, 200)}) {
    EXPECT_NEAR(slope_x[k], 0.0f, 1e-5f);
    EXPECT_NEAR(slope_y[k], 0.5f, 1e-5f);
  }
}

// A plane bank: its normal is (3, -4, 12) / 13, and the picture has it within half a step.
TEST_F(Boundary, NormalsOfAPlaneBankAreThoseOfItsSlope) {
  const Grid grid{{-8.0, -8.0}, 2.0, 9, 9};
  std::vector<float> distance_m(grid.size(), -1.0f), height_m(grid.size());
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) {
      const glm::dvec2 p = grid.point(i, j);
      height_m[grid.index(i, j)] = static_cast<float>(20.0 - 0.25 * p.x + p.y / 3.0);
    }
  const texture::Image8 image = bank_normals({grid, distance_m, height_m, {}});
  ASSERT_EQ(image.width, 9);
  ASSERT_EQ(image.channels, 3);
  const std::array<double, 3> normal = {3.0 / 13.0, -4.0 / 13.0, 12.0 / 13.0};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(image.pixels[i] / 127.5 - 1.0, normal[i % 3], 0.5 / 127.5 + 1e-6);
}

TEST_F(Boundary, IsTheGroundOfATerrainThatAsksForIt) {
  TerrainDescription description;
  description.coast_m = {{-100.0, 0.0}, {100.0, 0.0}};
  description.beach_size_m = 256.0;
  description.boundary = write_flat(5, {12.0f, 3.25f, 0.0f, 1.0f});
  EXPECT_GT(build_terrain(description).highest_m, 1.0f);
  description.ground_from_boundary = true;
  const HeightGrid land = build_terrain(description);
  EXPECT_EQ(land.lowest_m, -3.25f);
  EXPECT_EQ(land.highest_m, -3.25f);
  EXPECT_EQ(height_at(land, {60.0, -90.0}), -3.25);
  EXPECT_EQ(land.apron.width_m, 128.0);
  description.boundary.clear();
  EXPECT_EQ(HeightImage::error_of(description),
            "terrain.ground, got \"boundary\" without terrain.boundary, allowed \"heights\", or "
            "\"boundary\" with its file");
}

TEST_F(Boundary, RefusesWhatIsNone) {
  const auto is_line = [](const std::string& error, const std::string& end) {
    return error.ends_with(end) && error.find('\n') == std::string::npos;
  };
  EXPECT_PRED2(is_line, error_of(write_flat(4, {1.0f, 1.0f, 0.0f})),
               "flat.exr: water boundary, got 3 channels, allowed 4: distance to the water line, "
               "depth, height of the bank, part of surf");
  EXPECT_PRED2(is_line, error_of(write_image("b.exr", {3, 2, 4, std::vector<float>(24, 0.0f)})),
               "b.exr: water boundary, got 3 x 2 pixels, allowed a square of 2 to 1025 a side");
  EXPECT_PRED2(is_line, error_of(write_flat(2, {1.0f, -1.0f, 0.0f, 1.0f})),
               "flat.exr: depth at pixel (0, 0), got -1, allowed 0 to 12000 m");
  EXPECT_PRED2(is_line, error_of(write_flat(2, {1.0f, 1.0f, 0.0f, 1.5f})),
               "flat.exr: part of surf at pixel (0, 0), got 1.5, allowed 0 to 1");
  EXPECT_PRED2(is_line, error_of(folder_ / "a.png"),
               "a.png: water boundary, got no EXR file, allowed files whose names end in .exr");
  EXPECT_NE(error_of(folder_ / "none.exr").find("none.exr"), std::string::npos);
  EXPECT_NE(error_of(write_flat(1026, {1.0f, 1.0f, 0.0f, 1.0f})).find("1025"), std::string::npos);
}

}  // namespace
}  // namespace swell::terrain
