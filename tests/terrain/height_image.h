// What the tests of land from images have in common.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scratch_folder.h"
#include "terrain/terrain.h"
#include "texture/image/image_io.h"

namespace swell::terrain {

// A folder for images, gone after the test.
class HeightImage : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    return scratch_.write(name, bytes);
  }

  // A float image of one channel.
  std::filesystem::path write_exr(const std::string& name, int width, int height,
                                  std::vector<float> pixels) const {
    const texture::ImageF image{width, height, 1, std::move(pixels)};
    texture::write_file(folder_ / name, texture::encode_image(image, ".exr"));
    return folder_ / name;
  }

  // what() of the error that a description is refused with; empty if it is taken.
  static std::string error_of(const TerrainDescription& description) {
    try {
      build_terrain(description);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

}  // namespace swell::terrain
