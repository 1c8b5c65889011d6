// The pictures of a data set on one sheet, with the boxes of their objects, to look at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "texture/image/image.h"

namespace swell::apps {

struct SheetBox {
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;  // in the picture
  int category = 0;                                     // its colour
};

// Up to 64 of the samples, evenly spread over them.
class ContactSheet {
 public:
  ContactSheet(int samples, int width_px, int height_px);  // of a sample's picture

  bool shows(int sample) const;

  // Puts a sample's picture, an 8-bit PNG file, in its place. Throws texture::FileError.
  void add(int sample, const std::filesystem::path& picture, std::span<const SheetBox> boxes);

  std::vector<std::uint8_t> encode() const;  // PNG

 private:
  int place_of(int sample) const;  // -1: none

  int samples_, shown_, columns_;
  int cell_width_px_, cell_height_px_;
  texture::Image8 sheet_;
};

}  // namespace swell::apps
