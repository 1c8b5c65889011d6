// Finished pictures as files: names of sequences, early checks, encoding.
#pragma once

#include <filesystem>
#include <string>

#include "render/frame.h"
#include "texture/image/image.h"
#include "texture/image/image_note.h"

namespace swell::apps {

// A file name with at most one place for the frame number, written %d or %04d.
struct FrameFilePattern {
  std::string before, after;
  int digits = 0;  // the number is padded with zeros to this length
  bool numbered = false;
};

// Splits at the first %d or %0Nd (N in 1 to 9) of the file name; anything else is kept as it is.
FrameFilePattern parse_file_pattern(const std::filesystem::path& path);

// The file of one frame.
std::filesystem::path frame_file(const FrameFilePattern& pattern, int frame);

// The extension with its dot, in small letters: ".png".
std::string lower_extension(const std::filesystem::path& path);

// check_output_place() for pictures, whose extension must be .png, .exr, .tif or .tiff.
void check_picture_file(const std::filesystem::path& path);

// True if the file stores linear light (.exr): render_frame must fill Target::linear.
bool stores_linear_light(const std::filesystem::path& path);

// The picture without its alpha.
texture::Image8 rgb_image(const render::Target& target);

// Writes the picture: 8-bit sRGB, or linear float RGB for .exr. The file is whole or not there.
// Throws texture::FileError.
void write_picture(const render::Target& target, const std::filesystem::path& path,
                   const texture::ImageExtras& extras = {});

}  // namespace swell::apps
