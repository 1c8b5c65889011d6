// Image files: a letter for what the file's name ends with, then the file.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/expect.h"
#include "fuzz/scratch_parent.h"
#include "texture/image/image_io.h"

namespace swell::fuzz {
namespace {

// Small ones, so that time goes into reading many.
constexpr texture::ReadLimits kLimits = {.max_side_px = 512, .max_bytes = 1 << 20};

std::string name_of(char letter) {
  switch (letter) {
    case 'e':
      return "image.exr";
    case 'h':
      return "image.hdr";
    case 't':
      return "image.tif";
    case 'n':
      return "image.pnm";
    default:
      return "image.png";
  }
}

void read_image(std::span<const char> input) {
  static const ScratchFolder folder(scratch_parent());
  if (input.empty()) return;
  const auto file =
      folder.write(name_of(input[0]), std::string_view(input.begin() + 1, input.end()));
  try {
    const texture::ImageF image = texture::read_image(file, kLimits);
    expect(image.width >= 1 && image.width <= kLimits.max_side_px && image.height >= 1 &&
               image.height <= kLimits.max_side_px && image.channels >= 1 && image.channels <= 4,
           "an image's size lies within the limits");
    expect(image.pixels.size() == std::size_t{1} * image.width * image.height * image.channels,
           "an image has all of its samples");
    expect(std::ranges::all_of(image.pixels, [](float x) { return std::isfinite(x); }),
           "an image's samples are finite");
  } catch (const texture::FileError& error) {
    const std::string_view text = error.what();
    expect(text.find('\n') == std::string_view::npos && !text.ends_with(": "),
           "what an image is refused with is one line that says something");
  }
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::read_image({reinterpret_cast<const char*>(data), size});
  return 0;
}
