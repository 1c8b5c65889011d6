// PNG files by libpng, which starts in a thousandth of the time that OpenImageIO takes.
#pragma once

#include <cstdint>
#include <vector>

#include "texture/image/image_codec.h"

namespace swell::texture {

// The file of 8-bit or 16-bit samples, 1 to 4 channels: Y, YA, RGB or RGBA. It holds the picture
// and the notes alone, so the same ones give the same bytes. Throws FileError, std::bad_alloc.
std::vector<std::uint8_t> encode_png(const EncodeRequest& request);

}  // namespace swell::texture
