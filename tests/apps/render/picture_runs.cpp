#include "apps/render/picture_runs.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;
constexpr int kTilePx = 64;  // the default

texture::Image8 read_picture(const fs::path& path) {
  const texture::ImageF image = texture::read_image(path);
  texture::Image8 picture{image.width, image.height, image.channels, {}};
  for (const float value : image.pixels)
    picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(value * 255.0f)));
  return picture;
}

void write_picture(const fs::path& path, const texture::Image8& picture) {
  fs::create_directories(path.parent_path());
  texture::write_file(path, texture::encode_image(picture, ".png"));
}

std::string pixel_text(const texture::Image8& picture, std::size_t pixel) {
  std::string text;
  for (int c = 0; c < picture.channels; ++c)
    text += fmt::format(" {}", picture.pixels[pixel * picture.channels + c]);
  return text;
}

std::string explain(const PictureRun& actual, int actual_frame, const PictureRun& expected,
                    int expected_frame, const std::string& name) {
  const std::string text = picture_difference(read_picture(actual.pictures.at(actual_frame)),
                                              read_picture(expected.pictures.at(expected_frame)),
                                              difference_folder(), picture_name(name));
  return text.empty() ? "the pictures are equal: the hash is wrong" : text;
}

}  // namespace

PictureRun run_pictures(const std::string& scene, const ScratchFolder& folder,
                        const Arguments& more) {
  const std::string prefix = fmt::format("run{}_", folder.names().size());
  Arguments arguments = {
      "--scene", scene, "--size", "160x90", "--hash", "--out", folder.file(prefix + "%d.png")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run_render(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  PictureRun run;
  std::istringstream lines(outcome.out);
  std::string frame_word, xxh3_word, hash;
  for (int frame; lines >> frame_word >> frame >> xxh3_word >> hash;) {
    run.hashes[frame] = hash;
    run.pictures[frame] = folder.file(fmt::format("{}{}.png", prefix, frame));
  }
  EXPECT_FALSE(run.hashes.empty()) << outcome.out;
  return run;
}

void expect_same_picture(const PictureRun& actual, int actual_frame, const PictureRun& expected,
                         int expected_frame, const std::string& name) {
  if (!actual.hashes.contains(actual_frame) || !expected.hashes.contains(expected_frame)) {
    ADD_FAILURE() << name << ": frame " << actual_frame << " or " << expected_frame << " is absent";
    return;
  }
  EXPECT_EQ(actual.hashes.at(actual_frame), expected.hashes.at(expected_frame))
      << name << ", frame " << actual_frame << ": "
      << explain(actual, actual_frame, expected, expected_frame, name);
}

void expect_same_pictures(const PictureRun& actual, const PictureRun& expected,
                          const std::string& name) {
  EXPECT_EQ(actual.hashes.size(), expected.hashes.size()) << name;
  for (const auto& [frame, hash] : expected.hashes)
    expect_same_picture(actual, frame, expected, frame, name);
}

std::string picture_difference(const texture::Image8& actual, const texture::Image8& expected,
                               const fs::path& folder, const std::string& name) {
  if (actual.width != expected.width || actual.height != expected.height ||
      actual.channels != expected.channels)
    return "sizes differ";
  texture::Image8 difference = actual;
  const std::size_t channels = static_cast<std::size_t>(actual.channels);
  std::size_t count = 0, first = 0;
  for (std::size_t pixel = actual.pixels.size() / channels; pixel-- > 0;) {
    bool equal = true;
    for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
      const int delta = std::abs(int{actual.pixels[i]} - int{expected.pixels[i]});
      difference.pixels[i] = static_cast<std::uint8_t>(std::min(255, 8 * delta));
      equal = equal && delta == 0;
    }
    if (equal) continue;
    ++count;
    first = pixel;
  }
  if (count == 0) return "";
  write_picture(folder / (name + "_actual.png"), actual);
  write_picture(folder / (name + "_expected.png"), expected);
  write_picture(folder / (name + "_difference.png"), difference);
  const int x = static_cast<int>(first) % actual.width, y = static_cast<int>(first) / actual.width;
  return fmt::format(
      "{} pixels differ, first ({}, {}) in tile ({}, {}): is{}, expected{}; pictures in {}", count,
      x, y, x / kTilePx, y / kTilePx, pixel_text(actual, first), pixel_text(expected, first),
      (folder / (name + "_*.png")).string());
}

fs::path difference_folder() { return fs::path(SWELL_BINARY_DIR) / "same-bits-failures"; }

std::string picture_name(const std::string& name) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string text = fmt::format("{}_{}_{}", test.test_suite_name(), test.name(), name);
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return text;
}

}  // namespace swell::apps
