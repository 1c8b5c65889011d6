// What an image file says besides its picture.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace swell::texture {

// A note in the file's header, such as "swell:scene_xxh3": a text of PNG (iTXt), an attribute of
// EXR. In UTF-8; the name has 1 to 79 ASCII characters.
struct ImageNote {
  std::string name, text;
};

// Those that lose nothing.
inline constexpr std::array<std::string_view, 5> kExrCompressions = {"none", "rle", "zips", "zip",
                                                                     "piz"};

struct ImageExtras {
  std::span<const ImageNote> notes = {};     // TIFF files have none
  std::string_view exr_compression = "zip";  // of kExrCompressions
};

}  // namespace swell::texture
