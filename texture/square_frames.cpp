#include "texture/square_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/check.h"
#include "texture/srgb.h"

namespace swell::texture {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& text) {
  throw FileError(fmt::format("{}: {}", path, text));
}

// size: 0, or what it has to have; frames: how many there are to be.
void check_frame(const std::string& path, std::string_view what, const ImageF& image, int size,
                 std::size_t frames) {
  const auto side = static_cast<unsigned>(image.width);
  const bool fits = image.width == image.height && image.width >= kLeastFrameSize &&
                    image.width <= kMostFrameSize && std::has_single_bit(side);
  if (!fits || (size > 0 && image.width != size))
    refuse(path, fmt::format("{}, got {} x {} pixels, allowed a square of {}", what, image.width,
                             image.height,
                             size > 0 ? fmt::format("{}, as the first", size)
                                      : fmt::format("{} to {} a side, a power of two",
                                                    kLeastFrameSize, kMostFrameSize)));
  if (texels_of(image) * frames > kMostFrameTexels)
    refuse(path, fmt::format("{}, got {} frames of {} pixels a side, allowed {}", what, frames,
                             image.width, kMostFrameTexels / texels_of(image)));
}

}  // namespace

std::string path_of_frame(std::string_view path, int frame) {
  const std::size_t at = path.find(kFrameNumber);
  SWELL_CHECK(at != std::string_view::npos, "path={}", path);
  return fmt::format("{}{:04d}{}", path.substr(0, at), frame,
                     path.substr(at + kFrameNumber.size()));
}

std::vector<std::string> paths_of_frames(std::string_view path, int frames) {
  std::vector<std::string> paths;
  for (int frame = 0; frame < frames; ++frame) paths.push_back(path_of_frame(path, frame));
  return paths;
}

std::vector<ImageF> read_square_frames(const std::vector<std::string>& paths, std::string_view what,
                                       int channels, int size) {
  std::vector<ImageF> frames;
  for (const std::string& path : paths) {
    const ImageF image = read_image(path, {.max_side_px = kMostFrameSize});
    check_frame(path, what, image, frames.empty() ? size : frames[0].width, paths.size());
    if (image.channels < channels)
      refuse(path, fmt::format("{}, got a picture of {} channels, allowed {} and more", what,
                               image.channels, channels));
    ImageF& frame = frames.emplace_back(image.width, image.height, channels);
    for (int y = image.height - 1; y >= 0; --y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < channels; ++c) frame.pixels.push_back(image.at(x, y, c));
  }
  return frames;
}

ColourFrames read_colour_frames(const std::vector<std::string>& paths, int size) {
  std::vector<ImageF> frames = read_square_frames(paths, "picture of colours", 3, size);
  glm::dvec3 sum(0.0);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const bool linear = holds_floats(paths[f]);
    for (std::size_t n = 0; n < frames[f].pixels.size(); ++n) {
      float& value = frames[f].pixels[n];
      if (value < 0.0f)
        refuse(paths[f], fmt::format("picture of colours, got {}, allowed 0 and more", value));
      if (!linear) value = static_cast<float>(linear_of_srgb(static_cast<double>(value)));
      sum[static_cast<int>(n % 3)] += static_cast<double>(value);
    }
  }
  ColourFrames colours{frames[0].width, {}, {}};
  const double texels =
      static_cast<double>(texels_of(frames[0])) * static_cast<double>(frames.size());
  colours.mean = glm::vec3(sum / texels);
  for (const ImageF& frame : frames) {
    Image8& bytes = colours.frames.emplace_back(frame.width, frame.height, 3);
    for (std::size_t n = 0; n < frame.pixels.size(); ++n) {
      const float mean = colours.mean[static_cast<int>(n % 3)];
      const float part = mean > 0.0f ? frame.pixels[n] / mean : 1.0f;
      bytes.pixels.push_back(
          static_cast<std::uint8_t>(std::nearbyint(std::min(127.5f * part, 255.0f))));
    }
  }
  return colours;
}

}  // namespace swell::texture
