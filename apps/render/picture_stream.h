// Pictures of a sequence on standard output, one after the other, as encoders of films read them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/frame.h"

namespace swell::apps {

// Y4M is YUV 4:4:4 of 8 bits by BT.709, which players take for films of these sizes, with video
// levels; its header says both, and the frames a second. PPM is 8-bit RGB, a file after the other.
class PictureStream {
 public:
  // `format` is "y4m", "ppm" or empty: writes nothing. fps over 0.
  PictureStream(std::string format, double fps);

  // Throws std::runtime_error if standard output does not take it.
  void add(const render::Target& target);

 private:
  std::string format_;
  double fps_;
  bool has_begun_ = false;
  std::vector<std::uint8_t> bytes_;
};

// One frame of Y4M without its header: the planes Y, U and V. BT.709, rounded.
void append_yuv(const render::Target& target, std::vector<std::uint8_t>& bytes);

// "30:1", "30000:1001", "2997:100": fps in [0.001, 1e6] to a ten-millionth, or the nearest whole
// number.
std::string frame_rate_text(double fps);

}  // namespace swell::apps
