// Where there is no libjpeg-turbo to build with.
#include <stdexcept>

#include "apps/jpeg/jpeg.h"

namespace swell::apps {

bool has_jpeg() { return false; }

std::vector<std::uint8_t> jpeg_bytes(std::span<const std::uint8_t>, int, int, const JpegSettings&) {
  throw std::runtime_error("built without libjpeg-turbo");
}

}  // namespace swell::apps
