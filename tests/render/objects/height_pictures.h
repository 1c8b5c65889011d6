// Pictures of heights for tests, in a folder that goes with them.
#pragma once

#include <string>

#include "scene/file/implicit_file.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::render {

// Writes EXR files of height(u, v) [m], u and v in [-1, 1] to the right and upwards in the picture.
class HeightPictures {
 public:
  template <class Height>
  void write(const std::string& name, int columns, int rows, const Height& height) const {
    texture::ImageF image{columns, rows, 1, {}};
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        image.pixels.push_back(
            static_cast<float>(height(2.0 * x / (columns - 1) - 1.0, 1.0 - 2.0 * y / (rows - 1))));
    texture::write_file(folder_.path() / name, texture::encode_image(image, ".exr"));
  }

  // An implicit surface whose file lies beside the pictures.
  scene::ImplicitSurface parse(const std::string& toml) const {
    return scene::parse_implicit(toml, folder_.file("form.toml"));
  }

  const ScratchFolder& folder() const { return folder_; }

 private:
  ScratchFolder folder_;
};

}  // namespace swell::render
