#include "apps/shared/picture_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "apps/shared/output_file.h"
#include "texture/image/image.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

}  // namespace

FrameFilePattern parse_file_pattern(const fs::path& path) {
  const std::string text = path.string();
  const std::size_t name = text.size() - path.filename().string().size();
  for (std::size_t i = text.find('%', name); i != std::string::npos; i = text.find('%', i + 1)) {
    const std::string_view rest = std::string_view(text).substr(i + 1);
    if (rest.starts_with('d')) return {text.substr(0, i), text.substr(i + 2), 1, true};
    if (rest.size() >= 3 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9' && rest[2] == 'd')
      return {text.substr(0, i), text.substr(i + 4), rest[1] - '0', true};
  }
  return {text, "", 0, false};
}

fs::path frame_file(const FrameFilePattern& pattern, int frame) {
  if (!pattern.numbered) return pattern.before;
  return fmt::format("{}{:0{}}{}", pattern.before, frame, pattern.digits, pattern.after);
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_picture_file(const fs::path& path) {
  constexpr std::array kExtensions = {".png", ".exr", ".tif", ".tiff"};
  const std::string extension = lower_extension(path);
  if (std::ranges::find(kExtensions, extension) == kExtensions.end())
    refuse_output(path,
                  fmt::format("picture format, got '{}', allowed .png .exr .tif .tiff", extension));
  check_output_place(path);
}

bool stores_linear_light(const fs::path& path) { return lower_extension(path) == ".exr"; }

texture::Image8 rgb_image(const render::Target& target) {
  texture::Image8 image{target.width_px, target.height_px, 3, {}};
  image.pixels.resize(target.rgba.size() * 3);
  for (std::size_t i = 0; i < target.rgba.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = static_cast<std::uint8_t>(target.rgba[i] >> (8 * c));
  return image;
}

void write_picture(const render::Target& target, const fs::path& path,
                   const texture::ImageExtras& extras) {
  const std::string extension = lower_extension(path);
  if (!stores_linear_light(path)) {
    write_output(path, texture::encode_image(rgb_image(target), extension, extras));
    return;
  }
  const texture::ImageF image{target.width_px, target.height_px, 3, target.linear};
  const std::array<std::string, 3> names = {"R", "G", "B"};
  write_output(path, texture::encode_image(image, extension, names, extras));
}

}  // namespace swell::apps
