// What image_io.cpp checks of a file's structure itself, because the decoders behind OpenImageIO
// print to stderr (PNG) or do not notice (PNM).
#pragma once

#include <filesystem>
#include <string_view>

#include "texture/image/image_io.h"

namespace swell::texture {

// Whatever libpng would end in an error for, after printing it: every chunk whole with the right
// check sum and in its place, a possible header within the limits, a palette that fits it, pixels
// that can be inflated, all of them. Throws FileError. Inflates the pixels: 4 ms a megabyte.
void check_png_structure(const std::filesystem::path& path, std::string_view bytes,
                         const ReadLimits& limits);

// A header of positive numbers and as many bytes as it promises. Throws FileError.
void check_pnm_structure(const std::filesystem::path& path, std::string_view bytes);

}  // namespace swell::texture
