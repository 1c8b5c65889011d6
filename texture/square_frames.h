// Files of square pictures of one size, that repeat beyond their edges: one, or a sequence whose
// files a number tells apart.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "texture/image/image.h"
#include "texture/image/image_io.h"

namespace swell::texture {

// Most texels of all frames, and sides of a frame.
inline constexpr std::size_t kMostFrameTexels = std::size_t{1} << 24;
inline constexpr int kLeastFrameSize = 32, kMostFrameSize = 512;

// The number of a frame in the path of its file.
inline constexpr std::string_view kFrameNumber = "%04d";

// A path with the number in place of kFrameNumber, which it has.
std::string path_of_frame(std::string_view path, int frame);

// Reads frames 0 to frames - 1, row 0 in the south: the first channel, or three of them, of PNG,
// EXR, HDR, TIFF or PNM files, north on top. what: the name of such a picture in errors; size: what
// all have to have, 0: as the first. Throws FileError for what read_image() refuses, for frames
// that are no squares of one size (a power of two in [32, 512]) or more than kMostFrameTexels, and
// where three channels are wanted of fewer.
std::vector<ImageF> read_square_frames(const std::vector<std::string>& paths, std::string_view what,
                                       int channels, int size = 0);

// Pixels of an image.
inline std::size_t texels_of(const ImageF& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

// The paths of frames 0 to frames - 1.
std::vector<std::string> paths_of_frames(std::string_view path, int frames);

// Colours that tint a surface, as parts of their mean: what is too far for its texels has the mean.
struct ColourFrames {
  int size = 0;
  glm::vec3 mean{1.0f};        // linear RGB of all frames
  std::vector<Image8> frames;  // RGB: 127.5 colour / mean, at most 255; row 0 in the south
};

// Reads colours: integers as sRGB, EXR and HDR as linear light of at least 0. Throws as
// read_square_frames(), and for values below 0.
ColourFrames read_colour_frames(const std::vector<std::string>& paths, int size = 0);

}  // namespace swell::texture
