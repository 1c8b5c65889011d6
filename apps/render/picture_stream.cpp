#include "apps/render/picture_stream.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace swell::apps {
namespace {

void append_text(const std::string& text, std::vector<std::uint8_t>& bytes) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void append_rgb(const render::Target& target, std::vector<std::uint8_t>& bytes) {
  for (const std::uint32_t pixel : target.rgba)
    for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(pixel >> (8 * c)));
}

}  // namespace

void append_yuv(const render::Target& target, std::vector<std::uint8_t>& bytes) {
  // BT.709 times 2^16, with 16 to 235 for black to white, and 128 for grey.
  struct Row {
    int r, g, b, offset;
  };
  constexpr Row kRows[] = {
      {11966, 40254, 4064, 16}, {-6596, -22189, 28785, 128}, {28785, -26146, -2639, 128}};
  for (const Row& row : kRows)
    for (const std::uint32_t pixel : target.rgba) {
      const int r = pixel & 255, g = pixel >> 8 & 255, b = pixel >> 16 & 255;
      const int value = (row.r * r + row.g * g + row.b * b + (1 << 15) + (row.offset << 16)) >> 16;
      bytes.push_back(static_cast<std::uint8_t>(value));
    }
}

std::string frame_rate_text(double fps) {
  for (const long denominator : {1L, 1001L, 1'000'000L}) {
    const double numerator = std::round(fps * static_cast<double>(denominator));
    if (std::abs(numerator / static_cast<double>(denominator) - fps) > 1e-7 * fps) continue;
    const long divisor = std::gcd(static_cast<long>(numerator), denominator);
    return fmt::format("{}:{}", static_cast<long>(numerator) / divisor, denominator / divisor);
  }
  return fmt::format("{}:1", std::lround(fps));
}

PictureStream::PictureStream(std::string format, double fps)
    : format_(std::move(format)), fps_(fps) {}

void PictureStream::add(const render::Target& target) {
  if (format_.empty()) return;
  bytes_.clear();
  if (format_ == "ppm") {
    append_text(fmt::format("P6\n{} {}\n255\n", target.width_px, target.height_px), bytes_);
    append_rgb(target, bytes_);
  } else {
    if (!has_begun_)
      // FFmpeg reads the range and skips the matrix, a tag of ours; it takes 95 bytes at most.
      append_text(fmt::format("YUV4MPEG2 W{} H{} F{} Ip A1:1 C444 XCOLORRANGE=LIMITED "
                              "XCOLORMATRIX=BT709\n",
                              target.width_px, target.height_px, frame_rate_text(fps_)),
                  bytes_);
    append_text("FRAME\n", bytes_);
    append_yuv(target, bytes_);
  }
  has_begun_ = true;
  if (std::fwrite(bytes_.data(), 1, bytes_.size(), stdout) != bytes_.size() ||
      std::fflush(stdout) != 0)
    throw std::runtime_error("cannot write to standard output");
}

}  // namespace swell::apps
