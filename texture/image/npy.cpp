#include "texture/image/npy.h"

#include <fmt/core.h>

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "math/check.h"

namespace swell::texture {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view type_name(std::span<const float>) { return "<f4"; }
constexpr std::string_view type_name(std::span<const std::uint32_t>) { return "<u4"; }
constexpr std::string_view type_name(std::span<const std::uint16_t>) { return "<u2"; }
constexpr std::string_view type_name(std::span<const std::uint8_t>) { return "|u1"; }

// Magic bytes, version, the header's length in two bytes, and the header: a Python dictionary,
// spaces so that the samples begin at a multiple of 64 bytes, and a line's end.
std::string file_head(std::string_view type, const std::string& shape) {
  constexpr std::size_t kBefore = 10, kAlignment = 64;
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  while ((kBefore + header.size() + 1) % kAlignment != 0) header += ' ';
  header += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(header.size() & 0xff);
  head += static_cast<char>(header.size() >> 8);
  return head + header;
}

}  // namespace

std::vector<std::uint8_t> encode_npy(NpySamples samples, int height, int width, int channels) {
  SWELL_CHECK(height >= 1 && width >= 1 && channels >= 0, "shape=({}, {}, {})", height, width,
              channels);
  const std::string shape = channels == 0 ? fmt::format("({}, {})", height, width)
                                          : fmt::format("({}, {}, {})", height, width, channels);
  const std::string_view type = std::visit([](auto span) { return type_name(span); }, samples);
  const std::string head = file_head(type, shape);
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  std::visit(
      [&](const auto& values) {
        const std::size_t count = std::size_t{1} * height * width * (channels == 0 ? 1 : channels);
        SWELL_CHECK(values.size() == count, "count={} shape={}", values.size(), shape);
        bytes.resize(head.size() + values.size_bytes());
        std::memcpy(bytes.data() + head.size(), values.data(), values.size_bytes());
      },
      samples);
  return bytes;
}

}  // namespace swell::texture
