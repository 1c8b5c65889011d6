#include "texture/image/exr_channels.h"

#include <algorithm>
#include <bit>

#include "math/check.h"
#include "texture/image/image_codec.h"

namespace swell::texture {
namespace {

void check_channels(std::size_t pixels, std::span<const ExrChannel> channels) {
  SWELL_CHECK(!channels.empty(), "channels={}", channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::string& name = channels[c].name;
    SWELL_CHECK(!name.empty() && name.find('\0') == std::string::npos, "name of channel {}", c);
    SWELL_CHECK(std::ranges::count(channels.first(c), name, &ExrChannel::name) == 0, "two {}",
                name);
    const std::size_t count =
        std::visit([](const auto& samples) { return samples.size(); }, channels[c].samples);
    SWELL_CHECK(count == pixels, "{}: count={} pixels={}", name, count, pixels);
  }
}

}  // namespace

std::vector<std::uint8_t> encode_exr(int width, int height, std::span<const ExrChannel> channels,
                                     const ImageExtras& extras) {
  SWELL_CHECK(width >= 1 && height >= 1, "size={}x{}", width, height);
  const std::size_t pixels = std::size_t{1} * width * height;
  check_channels(pixels, channels);
  EncodeRequest request{.format = "openexr",
                        .width = width,
                        .height = height,
                        .channels = static_cast<int>(channels.size())};

  // Planes side by side, the bits as they are.
  std::vector<std::uint32_t> bits(pixels * channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::visit(
        [&](const auto& samples) {
          for (std::size_t i = 0; i < pixels; ++i)
            bits[i * channels.size() + c] = std::bit_cast<std::uint32_t>(samples[i]);
        },
        channels[c].samples);
    const bool is_float = std::holds_alternative<std::span<const float>>(channels[c].samples);
    request.kinds.push_back(is_float ? SampleKind::kFloat : SampleKind::kUnsigned32);
    request.names.push_back(channels[c].name);
  }
  request.bits = bits.data();
  request.notes = extras.notes;
  request.exr_compression = extras.exr_compression;
  return encode(request);
}

}  // namespace swell::texture
