#include "mesh_import/asset_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "texture/image/file_bytes.h"
#include "texture/image/image_codec.h"

namespace swell::mesh_import {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr std::uint64_t kMostImageBytes = 256ull << 20;

std::string_view format_of(std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kFormats = {
      {{"\x89PNG\r\n\x1a\n"sv, "png"sv},
       {"\xff\xd8\xff"sv, "jpeg"sv},
       {"II*\0"sv, "tiff"sv},
       {"MM\0*"sv, "tiff"sv},
       {"\x76\x2f\x31\x01"sv, "openexr"sv},
       {"#?R"sv, "hdr"sv}}};
  for (const auto& [begin, format] : kFormats)
    if (bytes.starts_with(begin)) return format;
  throw Refused("a texture that is no PNG, JPEG, TIFF, EXR or HDR picture");
}

std::uint32_t texel_of(std::span<const float> channels) {
  const auto code = [&](std::size_t c) {
    const float x = channels[std::min(c, channels.size() - 1)];
    return static_cast<std::uint32_t>(std::lround(255.0f * (x > 0.0f ? std::min(x, 1.0f) : 0.0f)));
  };
  // One channel, or one with alpha, is grey.
  const bool grey = channels.size() < 3;
  return code(0) | code(grey ? 0 : 1) << 8 | code(grey ? 0 : 2) << 16 | 0xff000000u;
}

shapes::FlatTexture decode(std::span<const char> bytes, std::uint64_t most_texels,
                           const InputCounter& count_inputs) {
  const texture::ImageCodec& codec = texture::image_codec();
  void* image = nullptr;
  texture::ImageInfo info;
  std::string error;
  const auto check = [&](texture::CodecResult result) {
    if (result != texture::CodecResult::kDone)
      throw Refused(fmt::format("a texture that cannot be read ({})", error));
  };
  check(codec.open(format_of({bytes.data(), bytes.size()}), bytes, image, info, error));
  const std::unique_ptr<void, void (*)(void*)> owner(image, codec.close);
  const auto is_side = [](int side) { return side >= 1 && side <= shapes::kMostTextureSide_px; };
  if (!is_side(info.width) || !is_side(info.height) || info.depth != 1 || info.is_deep ||
      info.channels < 1 || info.channels > 4)
    throw Refused(fmt::format("a texture of {} x {} with {} channels, allowed {} a side and 4",
                              info.width, info.height, info.channels, shapes::kMostTextureSide_px));
  const std::size_t texels = static_cast<std::size_t>(info.width) * info.height;
  if (texels > most_texels)
    throw Refused(
        fmt::format("over {0} texels in its textures, allowed {0}", shapes::kMostMeshTexels));
  count_inputs(texels);
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> pixels(texels * channels);
  check(codec.read(image, pixels, error));
  shapes::FlatTexture texture{
      static_cast<std::uint32_t>(info.width), static_cast<std::uint32_t>(info.height), {}};
  texture.texels.reserve(texels);
  for (std::size_t i = 0; i < texels; ++i)
    texture.texels.push_back(texel_of(std::span(pixels).subspan(i * channels, channels)));
  return texture;
}

std::vector<char> read_picture(const fs::path& path, const fs::path& folder,
                               const InputCounter& count_inputs) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  const fs::path inside = fs::weakly_canonical(folder);
  if (error || std::ranges::mismatch(inside, real).in1 != inside.end())
    throw Refused(fmt::format("a texture '{}' that is not in the file's folder or below",
                              path.filename().string()));
  const std::uint64_t bytes = fs::file_size(real, error);
  if (!error) count_inputs(std::min(bytes, kMostImageBytes));
  return texture::read_bytes(real, kMostImageBytes);
}

}  // namespace

std::vector<shapes::FlatTexture> decode_textures(std::span<const TextureSource> sources,
                                                 const fs::path& folder,
                                                 const InputCounter& count_inputs) {
  std::vector<shapes::FlatTexture> textures;
  std::uint64_t left = shapes::kMostMeshTexels;
  for (const TextureSource& source : sources) {
    if (!source.texels.empty())
      textures.push_back({source.width, source.height, source.texels});
    else if (!source.path.empty())
      textures.push_back(
          decode(read_picture(source.path, folder, count_inputs), left, count_inputs));
    else
      textures.push_back(decode(source.bytes, left, count_inputs));
    const std::uint64_t taken = textures.back().texels.size();
    if (taken > left)
      throw Refused(
          fmt::format("over {0} texels in its textures, allowed {0}", shapes::kMostMeshTexels));
    left -= taken;
  }
  return textures;
}

}  // namespace swell::mesh_import
