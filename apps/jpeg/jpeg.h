// Pictures in JPEG.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swell::apps {

// False where the program was built without libjpeg-turbo.
bool has_jpeg();

struct JpegSettings {
  int quality = 95;      // [1, 100]
  bool is_fast = false;  // a less exact transform
};

// A picture of 8-bit sRGB, rows from the top: RGB, or RGBA without its alpha, by how many bytes
// there are. Chroma has half the picture's width and height. The same bytes each time, with one
// version of libjpeg-turbo. Throws std::runtime_error, without one always.
std::vector<std::uint8_t> jpeg_bytes(std::span<const std::uint8_t> pixels, int width_px,
                                     int height_px, const JpegSettings& settings);

}  // namespace swell::apps
