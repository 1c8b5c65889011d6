#include "apps/jpeg/jpeg.h"

#include <turbojpeg.h>

#include <memory>
#include <stdexcept>

namespace swell::apps {

bool has_jpeg() { return true; }

std::vector<std::uint8_t> jpeg_bytes(std::span<const std::uint8_t> pixels, int width_px,
                                     int height_px, const JpegSettings& settings) {
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitCompress(), &tjDestroy);
  if (!handle) throw std::runtime_error("cannot start libjpeg-turbo");
  const auto row_bytes = static_cast<int>(pixels.size() / static_cast<std::size_t>(height_px));
  const int format = row_bytes == 4 * width_px ? TJPF_RGBA : TJPF_RGB;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(handle.get(), pixels.data(), width_px, row_bytes, height_px,
                                 format, &bytes, &size, TJSAMP_420, settings.quality,
                                 settings.is_fast ? TJFLAG_FASTDCT : TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owned(bytes, &tjFree);
  if (failed) throw std::runtime_error(tjGetErrorStr2(handle.get()));
  return {bytes, bytes + size};
}

}  // namespace swell::apps
