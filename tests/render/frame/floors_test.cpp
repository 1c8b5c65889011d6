// Floors that nobody meant: every one that is not refused gives a finite sea and the same picture
// on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "math/random.h"
#include "ocean/water_surface.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "scratch_folder.h"
#include "terrain/height_grid.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;

// Grey levels of a floor's picture.
enum class Grey { kBlack, kWhite, kNoise };

struct Floor {
  std::string name;
  int image_side = 0;  // 0: no picture
  Grey grey = Grey::kBlack;
  scene::TerrainDescription terrain = {};
  double grid_spacing_m = 0.0;
  scene::CoastModel model = scene::CoastModel::kBlend;
  bool eikonal = true;
};
std::ostream& operator<<(std::ostream& out, const Floor& floor) { return out << floor.name; }

class OddFloor : public testing::TestWithParam<Floor> {
 protected:
  fs::path write_picture(int side, Grey grey) const {
    texture::Image8 image{side, side, 1, {}};
    for (int n = 0; n < side * side; ++n) {
      const double level = grey == Grey::kNoise ? random_uniform(1, static_cast<std::uint64_t>(n))
                                                : static_cast<int>(grey);
      image.pixels.push_back(static_cast<std::uint8_t>(255.0 * level));
    }
    texture::write_file(folder_ / "floor.png", texture::encode_image(image, ".png"));
    return folder_ / "floor.png";
  }

  const ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
};

scene::Scene windy_scene(const Floor& floor) {
  scene::Scene scene;
  scene.camera.eye_m = {0.0, -20.0, 6.0};
  scene.camera.pitch_rad = radians(-12.0);
  scene.sea.resolution = 32;
  scene.sea.wind_speed_mps = 9.0;
  scene.detail.water_triangles = scene.detail.terrain_triangles = 3000;
  scene.terrain = floor.terrain;
  scene.coast.model = floor.model;
  scene.coast.trains = 3;
  scene.coast.eikonal = floor.eikonal;
  scene.coast.grid_spacing_m = floor.grid_spacing_m;
  return scene;
}

TEST_P(OddFloor, GivesAFiniteSea) {
  scene::Scene scene = windy_scene(GetParam());
  if (GetParam().image_side > 0)
    scene.terrain->height_image = write_picture(GetParam().image_side, GetParam().grey);
  const World world = world_of(scene);
  const View view = view_of(world, 3.0, 64, 36);
  const Shot shot(world, view, 3.0, {.keep_linear = true}, 3);
  const Surface& water = shot.state().meshes.water;
  const float bound_m = world.state().water_bounds().height_m;
  EXPECT_LT(bound_m, 20.0f);
  EXPECT_TRUE(std::ranges::all_of(water.height_m, [&](float z) { return std::abs(z) <= bound_m; }));
  EXPECT_TRUE(
      std::ranges::all_of(shot.target.linear, [](float c) { return c >= 0.0f && c < 1e6f; }));
  const Shot fresh(world, view, 3.0, {.tile_size_px = 16, .keep_linear = true}, 1);
  EXPECT_EQ(picture_hash(fresh.target), picture_hash(shot.target));
}

std::vector<Floor> odd_floors() {
  std::vector<Floor> floors;
  const auto picture = [&](const std::string& name, int side, Grey grey,
                           const scene::TerrainDescription& terrain) {
    floors.push_back({.name = name, .image_side = side, .grey = grey, .terrain = terrain});
  };
  picture("AllLand", 8, Grey::kWhite, {});
  picture("AllDeep", 8, Grey::kBlack, {.low_m = -12000.0});
  picture("OnePixelOfSea", 1, Grey::kBlack, {});
  picture("SmallestScale", 32, Grey::kNoise, {.metres_per_pixel = 0.01});
  picture("LargestScale", 32, Grey::kNoise, {.metres_per_pixel = 1000.0});
  picture("Needles", 32, Grey::kNoise,
          {.metres_per_pixel = 0.01, .low_m = -12000.0, .high_m = 12000.0});
  floors.push_back(floors.back());
  floors.back().name = "StraightThroughNeedles";
  floors.back().eikonal = false;
  const auto coast = [&](const std::string& name, std::vector<glm::dvec2> line, double size_m,
                         double spacing_m, scene::CoastModel model) {
    floors.push_back({.name = name,
                      .terrain = {.coast_m = std::move(line), .beach_size_m = size_m},
                      .grid_spacing_m = spacing_m,
                      .model = model});
  };
  using enum scene::CoastModel;
  coast("CoastThatCrossesItself", {{-300, 0}, {300, 0}, {300, 100}, {-100, -200}, {0, 300}}, 800.0,
        5.0, kBlend);
  coast("CoastThereAndBack", {{-10, 0}, {10, 0}, {-10, 0}, {10, 0}}, 400.0, 5.0, kTrains);
  coast("ClosedCoast", {{-90, -90}, {90, -90}, {90, 90}, {-90, 90}, {-90, -90}}, 400.0, 5.0,
        kBlend);
  coast("ShortestCoast", {{0, 0}, {1e-3, 0}}, 400.0, 5.0, kTrains);
  coast("FinestGrid", {{-90, 0}, {90, 10}}, 100.0, 0.5, kTrains);
  coast("OneCell", {{-90, 0}, {90, 10}}, 50.0, 100.0, kTrains);
  return floors;
}

INSTANTIATE_TEST_SUITE_P(All, OddFloor, testing::ValuesIn(odd_floors()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace swell::render
