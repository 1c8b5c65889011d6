// Golden pictures: the frame's exact hash, and a small PNG beside it for people.
// To accept new pictures: SWELL_UPDATE_GOLDEN=1 build/release/bin/render_golden_test
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "render/frame.h"
#include "scene/scene.h"
#include "texture/image_io.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;
const fs::path kGoldenFolder = fs::path(SWELL_SOURCE_DIR) / "tests/golden";
const fs::path kFailureFolder = fs::path(SWELL_BINARY_DIR) / "golden-failures";

struct Case {
  const char* scene;
  double t_s;
  bool wireframe;
};

class Golden : public testing::TestWithParam<Case> {};
std::string case_name(const Case& c) {
  return std::string(c.scene) + "_t" + std::to_string(static_cast<int>(c.t_s)) +
         (c.wireframe ? "_wireframe" : "");
}
INSTANTIATE_TEST_SUITE_P(Pictures, Golden,
                         testing::Values(Case{"open_ocean", 0.0, false},
                                         Case{"open_ocean", 37.0, false},
                                         Case{"open_ocean", 0.0, true}, Case{"lagoon", 5.0, false},
                                         Case{"sines", 3.0, false}, Case{"beach", 4.0, false},
                                         Case{"buoys", 4.0, false}),
                         [](const auto& test) { return case_name(test.param); });

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

// Writes expected, actual and difference pictures; returns where they first differ.
std::string report_difference(const std::string& name, const texture::Image8& actual) {
  write_png(kFailureFolder / (name + "_actual.png"), actual);
  const texture::ImageF expected = texture::read_image(kGoldenFolder / (name + ".png"));
  if (expected.width != actual.width || expected.height != actual.height) return "sizes differ";
  texture::Image8 golden = actual, difference = actual;
  std::string first = "the stored picture is equal: only its hash is stale";
  for (std::size_t i = actual.pixels.size(); i-- > 0;) {
    golden.pixels[i] = static_cast<std::uint8_t>(expected.pixels[i] * 255.0f + 0.5f);
    const int delta = std::abs(int{actual.pixels[i]} - int{golden.pixels[i]});
    difference.pixels[i] = static_cast<std::uint8_t>(std::min(255, 8 * delta));
    if (delta != 0) {
      const auto pixel = static_cast<int>(i / 3);
      first = "first at pixel (" + std::to_string(pixel % actual.width) + ", " +
              std::to_string(pixel / actual.width) + ")";
    }
  }
  write_png(kFailureFolder / (name + "_expected.png"), golden);
  write_png(kFailureFolder / (name + "_difference.png"), difference);
  return first + "; pictures in " + kFailureFolder.string();
}

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

TEST_P(Golden, PictureHasTheStoredHash) {
  const Case& c = GetParam();
  const std::string name = case_name(c);
  const World world(
      scene::load_scene(fs::path(SWELL_SOURCE_DIR) / "scenes" / (std::string(c.scene) + ".toml")));
  Workers workers(2);
  Workspace workspace;
  Target target;
  FrameOptions options;
  options.wireframe = c.wireframe;
  const View view = scene::camera_view(world.scene().camera, c.t_s, 320, 180);
  render_frame(world, view, c.t_s, options, workspace, target, workers);

  const std::string actual = hash_text(picture_hash(target));
  const fs::path hash_file = kGoldenFolder / (name + ".xxh3");
  if (std::getenv("SWELL_UPDATE_GOLDEN")) {
    write_png(kGoldenFolder / (name + ".png"), rgb_image(target));
    std::ofstream(hash_file) << actual << '\n';
    GTEST_SKIP() << "stored " << name << ' ' << actual;
  }
  std::string expected;
  std::ifstream(hash_file) >> expected;
  EXPECT_EQ(actual, expected) << report_difference(name, rgb_image(target));
}

}  // namespace
}  // namespace swell::render
