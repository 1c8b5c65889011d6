// Golden pictures: small PNGs that frames are compared with, bit by bit.
// To accept new pictures: SWELL_UPDATE_GOLDEN=1 build/release/bin/render_golden_test
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

#include "math/value_hash.h"
#include "render/sameness_version.h"
#include "render/shot.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;
const fs::path kGoldenFolder = fs::path(SWELL_SOURCE_DIR) / "tests/golden";
const fs::path kFailureFolder = fs::path(SWELL_BINARY_DIR) / "golden-failures";

using enum scene::ShadingRate;

struct Case {
  const char* scene;
  double t_s;
  bool wireframe = false;
  scene::ShadingRate shading = kFull;
  ProjectionKind projection = ProjectionKind::kPerspective;
};

constexpr Case kCases[] = {{"open_ocean", 0.0},
                           {"open_ocean", 37.0},
                           {"open_ocean", 37.0, false, kAdaptive},
                           {"open_ocean", 0.0, true},
                           {"lagoon", 5.0},
                           {"sines", 3.0},
                           {"beach", 4.0},
                           {"beach", 4.0, false, kAdaptive},
                           {"buoys", 4.0},
                           {"lagoon", 5.0, false, kFull, ProjectionKind::kFisheye},
                           {"buoys", 4.0, false, kFull, ProjectionKind::kEquirectangular}};

class Golden : public testing::TestWithParam<Case> {};
std::string case_name(const Case& c) {
  return std::string(c.scene) + "_t" + std::to_string(static_cast<int>(c.t_s)) +
         (c.wireframe ? "_wireframe" : "") + (c.shading == kAdaptive ? "_adaptive" : "") +
         (c.projection == ProjectionKind::kFisheye ? "_fisheye" : "") +
         (c.projection == ProjectionKind::kEquirectangular ? "_equirectangular" : "");
}
INSTANTIATE_TEST_SUITE_P(Pictures, Golden, testing::ValuesIn(kCases),
                         [](const auto& test) { return case_name(test.param); });

// Through the scene's own camera, which may have another projection.
View view_of(const Case& c, const World& world) {
  scene::Camera camera = world.scene().camera;
  camera.projection = c.projection;
  return scene::camera_view(camera, c.t_s, 320, 180);
}

texture::Image8 rgb_image(const Target& target) {
  texture::Image8 image{target.width_px, target.height_px, 3, {}};
  for (const std::uint32_t p : target.rgba)
    for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<std::uint8_t>(p >> (8 * c)));
  return image;
}

void write_png(const fs::path& path, const texture::Image8& image) {
  fs::create_directories(path.parent_path());
  texture::write_file(path, texture::encode_image(image, ".png"));
}

texture::Image8 read_png(const fs::path& path) {
  const texture::ImageF read = texture::read_image(path);
  texture::Image8 image{read.width, read.height, read.channels, {}};
  for (const float x : read.pixels)
    image.pixels.push_back(static_cast<std::uint8_t>(std::lround(x * 255.0f)));
  return image;
}

// Writes expected, actual and difference pictures; returns where they first differ.
std::string report_difference(const std::string& name, const texture::Image8& actual,
                              const texture::Image8& golden) {
  write_png(kFailureFolder / (name + "_actual.png"), actual);
  write_png(kFailureFolder / (name + "_expected.png"), golden);
  if (golden.pixels.size() != actual.pixels.size()) return "sizes differ";
  texture::Image8 difference = actual;
  std::size_t first = actual.pixels.size();
  for (std::size_t i = actual.pixels.size(); i-- > 0;) {
    const int delta = std::abs(int{actual.pixels[i]} - int{golden.pixels[i]});
    difference.pixels[i] = static_cast<std::uint8_t>(std::min(255, 8 * delta));
    if (delta != 0) first = i;
  }
  write_png(kFailureFolder / (name + "_difference.png"), difference);
  const auto pixel = static_cast<int>(first / 3);
  return "first at pixel (" + std::to_string(pixel % actual.width) + ", " +
         std::to_string(pixel / actual.width) + "); pictures in " + kFailureFolder.string();
}

TEST_P(Golden, PictureIsTheStoredOneToTheBit) {
  const Case& c = GetParam();
  const std::string name = case_name(c);
  const World& world = shipped_world(c.scene);
  const Shot shot(world, view_of(c, world), c.t_s,
                  {.wireframe = c.wireframe, .shading = c.shading});
  const texture::Image8 actual = rgb_image(shot.target);
  const fs::path file = kGoldenFolder / (name + ".png");
  if (std::getenv("SWELL_UPDATE_GOLDEN")) {
    write_png(file, actual);
    GTEST_SKIP() << "stored " << name;
  }
  const texture::Image8 golden = read_png(file);
  const bool equal = golden.width == actual.width && golden.height == actual.height &&
                     golden.channels == actual.channels && golden.pixels == actual.pixels;
  EXPECT_TRUE(equal) << report_difference(name, actual, golden);
}

// A picture without a test would never be looked at again.
TEST(GoldenFolder, HoldsNothingButTheTestedPictures) {
  for (const auto& entry : fs::directory_iterator(kGoldenFolder)) {
    const bool tested = std::ranges::any_of(
        kCases, [&](const Case& c) { return entry.path().filename() == case_name(c) + ".png"; });
    EXPECT_TRUE(tested) << entry.path();
  }
}

// Who accepts other pictures raises the version: programs that say the same number draw the same.
TEST(SamenessVersion, IsRaisedWithTheGoldenPictures) {
  ValueBytes pictures;
  for (const Case& c : kCases) {
    const texture::Image8 image = read_png(kGoldenFolder / (case_name(c) + ".png"));
    pictures.add(std::string(image.pixels.begin(), image.pixels.end()));
  }
  std::ostringstream line;
  line << kSamenessVersion << ' ' << std::hex << std::setfill('0') << std::setw(16)
       << pictures.hash().low;
  std::ifstream file(fs::path(SWELL_SOURCE_DIR) / "tests/sameness_version.txt");
  std::string recorded;
  std::getline(file, recorded);
  EXPECT_EQ(recorded, line.str())
      << "raise kSamenessVersion, and write the new line into tests/sameness_version.txt";
}

}  // namespace
}  // namespace swell::render
