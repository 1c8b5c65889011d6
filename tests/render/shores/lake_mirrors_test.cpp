// Lakes at several levels mirror what stands around them, each in its own level.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "render/labels/label_channels.h"
#include "render/shot.h"
#include "render/view/meshes.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

// From the south to the north, each lower than the one before, with a wall along its north shore.
struct Basin {
  double south_m, north_m, level_m;
};
constexpr std::array<Basin, 3> kBasins = {
    {{-205.0, -105.0, 17.5}, {-65.0, 65.0, 11.5}, {105.0, 215.0, 5.5}}};
constexpr int kHeights_px = 256;
constexpr double kWall_m = 15.0, kWallWidth_m = 12.0, kHalfWidth_m = 200.0, kPixel_m = 2.0;

double ground_m(double x, double y) {
  for (const Basin& basin : kBasins) {
    if (std::abs(x) > kHalfWidth_m) continue;
    if (y > basin.south_m && y < basin.north_m) return basin.level_m - 2.0;
    if (y >= basin.north_m && y < basin.north_m + kWallWidth_m) return basin.level_m + kWall_m;
  }
  for (const Basin& basin : kBasins)
    if (y < basin.north_m + kWallWidth_m) return basin.level_m + 0.5;
  return kBasins.back().level_m + 0.5;
}

class LakeMirrors : public testing::Test {
 protected:
  // Nothing else stands there.
  scene::Scene three_lakes() const {
    texture::ImageF heights{kHeights_px, kHeights_px, 1, {}};
    for (int row = 0; row < kHeights_px; ++row)
      for (int column = 0; column < kHeights_px; ++column)
        heights.pixels.push_back(
            static_cast<float>(ground_m(kPixel_m * (column + 0.5 - 0.5 * kHeights_px),
                                        kPixel_m * (0.5 * kHeights_px - row - 0.5))));
    folder_.write("heights.exr", texture::encode_image(heights, ".exr"));
    std::string text = R"(
[camera]
eye_m = [0, -330, 120]
pitch_deg = -20
fov_y_deg = 50
[sky]
cloud_cover = 0
[wind]
speed_mps = 0
[coast]
model = "none"
[terrain]
height_image = "heights.exr"
metres_per_pixel = 2
)";
    for (const Basin& basin : kBasins)
      text += fmt::format("[[lake]]\nlevel_m = {}\nposition_m = [0, {}]\n", basin.level_m,
                          0.5 * (basin.south_m + basin.north_m));
    scene::Scene scene = scene::parse_scene(text, folder_.path() / "lakes.toml");
    scene.round_earth = false;
    return scene;
  }

  const ScratchFolder folder_;
};

// The picture's row of a place straight ahead of the eye.
double row_of(const View& view, double y, double z) {
  const glm::vec3 rel(glm::dvec3(0.0, y, z) - view.eye_world);
  const glm::vec4 clip = view.clip_from_rel * glm::vec4(rel, 1.0f);
  return 0.5 * (1.0 - static_cast<double>(clip.y / clip.w)) * view.height_px;
}

TEST_F(LakeMirrors, AreOfThreeLevelsBesidesTheSeas) {
  const World world = world_of(three_lakes());
  FrameOptions options;
  options.labels.add(Label::kFlags);
  const Shot shot(world, view_of(world, 1.0, 200, 360), 1.0, options);
  const std::span<const RiverMirror> mirrors = shot.state().meshes.rivers.mirrors();
  ASSERT_EQ(mirrors.size(), kMostRiverMirrors);
  for (const Basin& basin : kBasins) {
    int served = 0;
    for (const RiverMirror& mirror : mirrors)
      served += std::abs(static_cast<double>(mirror.level_m) - basin.level_m) <
                static_cast<double>(kMirrorFull_m);
    EXPECT_GE(served, 1) << basin.level_m;
    // A wall's image is as high as the wall mirrored in the level of its lake, but for a pixel of
    // the image, which has half as many, and where land rises.
    const double shore = row_of(shot.view, basin.north_m, basin.level_m);
    const double top = row_of(shot.view, basin.north_m, basin.level_m - kWall_m);
    const double south = row_of(shot.view, basin.south_m, basin.level_m);
    ASSERT_GT(top, shore + 8.0);
    ASSERT_GT(south, top + 4.0);
    int mirrored = 0;
    for (int y = static_cast<int>(shore); y < static_cast<int>(south); ++y)
      mirrored += (shot.target.labels.flags[shot.at(100, y)] & kShowsMirrored) != 0;
    EXPECT_NEAR(mirrored, top - shore, 4.0) << basin.level_m;
  }
}

// One that the sea's mirror serves needs no other, and none is drawn of what is not in view.
TEST_F(LakeMirrors, AreDrawnOfWhatIsInViewAlone) {
  scene::Scene scene = three_lakes();
  scene.camera.pitch_rad = radians(-62.0);
  const World world = world_of(scene);
  const Shot near(world, view_of(world, 1.0, 200, 200), 1.0);
  ASSERT_EQ(near.state().meshes.rivers.mirror_count, 1u);
  EXPECT_NEAR(near.state().meshes.rivers.mirror[0].level_m, 17.5f, 0.01f);
  scene.camera.heading_rad = radians(180.0);
  const World turned = world_of(scene);
  const Shot away(turned, view_of(turned, 1.0, 200, 200), 1.0);
  EXPECT_EQ(away.state().meshes.rivers.mirror_count, 0u);
}

TEST_F(LakeMirrors, AreTheSamePictureWithAnyThreadsAndFramesBefore) {
  const World world = world_of(three_lakes());
  const View view = view_of(world, 1.0, 160, 120);
  const Shot one(world, view, 1.0, {}, 1);
  View aside = view;
  aside.eye_world.z = 30.0;
  Shot three(3);
  three.draw(world, aside, 0.5);
  three.draw(world, view, 1.0);
  EXPECT_EQ(three.target.rgba, one.target.rgba);
}

}  // namespace
}  // namespace swell::render
