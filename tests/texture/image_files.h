// Files of pictures for tests: a folder for each test, noise, rows of any kind of sample.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "math/random.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::texture {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

// A fresh folder for each test, removed afterwards.
class Files : public testing::Test {
 protected:
  fs::path put(const std::string& name, const Bytes& bytes) const {
    return scratch.write(name, bytes);
  }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  const ScratchFolder scratch;
  const fs::path folder = scratch.path();
};
inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

inline Image8 random_image8(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(random_bits(1, i)));
  }
  return image;
}

inline ImageF random_imagef(int width, int height, int channels) {
  ImageF image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) {
    image.pixels.push_back(static_cast<float>(random_uniform(2, i) * 2e4 - 1e4));
  }
  return image;
}

// A file of one row as OpenImageIO writes it; a type for all channels, or for each.
inline Bytes encoded(const std::string& format, const std::vector<OIIO::TypeDesc>& types,
                     OIIO::TypeDesc pixel_type, const void* row, int width) {
  OIIO::ImageSpec spec(width, 1, static_cast<int>(types.size()), types[0]);
  if (types.size() > 1) spec.channelformats = types;
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->set_ioproxy(&memory) || !output->open("image." + format, spec) ||
      !output->write_image(pixel_type, row) || !output->close())
    throw std::runtime_error("cannot encode " + format);
  return bytes;
}

template <class T>
Bytes encoded(const std::string& format, OIIO::TypeDesc type, const std::vector<T>& row) {
  return encoded(format, {type}, type, row.data(), static_cast<int>(row.size()));
}

}  // namespace swell::texture
