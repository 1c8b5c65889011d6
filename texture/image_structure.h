// What image_io.cpp checks of a file's structure itself, because the decoders behind OpenImageIO
// print to stderr (PNG) or do not notice (PNM).
#pragma once

#include <filesystem>
#include <string_view>

namespace swell::texture {

// Every chunk whole with the right check sum, a possible header, an end. Throws FileError.
void check_png_structure(const std::filesystem::path& path, std::string_view bytes);

// A header of positive numbers and as many bytes as it promises. Throws FileError.
void check_pnm_structure(const std::filesystem::path& path, std::string_view bytes);

}  // namespace swell::texture
