#include "texture/image_structure.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "texture/file_bytes.h"

namespace swell::texture {
namespace {

// CRC-32 as in the PNG specification, annex D.
constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}

std::uint32_t crc32(std::string_view bytes) {
  static constexpr auto kTable = make_crc_table();
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) c = kTable[(c ^ static_cast<std::uint8_t>(byte)) & 0xff] ^ (c >> 8);
  return ~c;
}

std::uint32_t big_endian_u32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

// The bits per channel that a PNG colour type allows, as a set: bit n stands for n bits.
std::uint32_t allowed_png_bits(int colour_type) {
  constexpr std::uint32_t k8And16 = 1u << 8 | 1u << 16, kPacked = 1u << 1 | 1u << 2 | 1u << 4;
  switch (colour_type) {
    case 0:
      return kPacked | k8And16;
    case 3:
      return kPacked | 1u << 8;
    case 2:
    case 4:
    case 6:
      return k8And16;
    default:
      return 0;
  }
}

void check_png_header(const std::filesystem::path& path, std::string_view data) {
  if (data.size() != 13) fail(path, "the PNG header has {} bytes, allowed: 13", data.size());
  const std::uint32_t width = big_endian_u32(data), height = big_endian_u32(data.substr(4));
  constexpr std::uint32_t kLargest = 1000000;  // libpng's own limit
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    fail(path, "the size is {}x{}, allowed: 1x1 to {}x{}", width, height, kLargest, kLargest);
  }
  const int bits = static_cast<std::uint8_t>(data[8]), type = static_cast<std::uint8_t>(data[9]);
  if (bits > 16 || (allowed_png_bits(type) >> bits & 1) == 0) {
    fail(path, "{} bits a channel with colour type {} is no PNG", bits, type);
  }
  if (data[10] != 0 || data[11] != 0 || data[12] < 0 || data[12] > 1) {
    fail(path, "the PNG header names an unknown compression, filter or interlacing");
  }
}

// A number of a PNM header: after white space and comments.
std::uint64_t read_pnm_number(const std::filesystem::path& path, std::string_view& rest,
                              const char* what, std::uint64_t largest) {
  while (!rest.empty() && std::string_view(" \t\r\n#").find(rest[0]) != std::string_view::npos) {
    const std::size_t skip = rest[0] == '#' ? rest.find('\n') : 1;
    rest.remove_prefix(std::min(skip, rest.size()));
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || value < 1 || value > largest) {
    fail(path, "the {} in the PNM header is '{}', allowed: 1 to {}", what,
         rest.substr(0, std::min(rest.find_first_of(" \t\r\n"), std::size_t{20})), largest);
  }
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return value;
}

}  // namespace

void check_png_structure(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type, check sum
  std::string_view rest = bytes.substr(kSignature);
  for (bool first = true;; first = false) {
    if (rest.size() < kFrame || big_endian_u32(rest) > rest.size() - kFrame) {
      fail(path, "the file is cut short");
    }
    const std::size_t length = big_endian_u32(rest);
    const std::string_view type = rest.substr(4, 4);
    if (crc32(rest.substr(4, 4 + length)) != big_endian_u32(rest.substr(8 + length))) {
      fail(path, "the check sum of PNG chunk '{}' is wrong", type);
    }
    if (first != (type == "IHDR")) fail(path, "the PNG header is not the first chunk");
    if (first) check_png_header(path, rest.substr(8, length));
    if (type == "IEND") return;
    rest.remove_prefix(kFrame + length);
  }
}

void check_pnm_structure(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::uint64_t kLargestSide = 1u << 24;
  const int kind = bytes[1] - '0';  // 1, 2, 3: text; 4, 5, 6: binary bits, greys, colours
  std::string_view rest = bytes.substr(2);
  const std::uint64_t width = read_pnm_number(path, rest, "width", kLargestSide);
  const std::uint64_t height = read_pnm_number(path, rest, "height", kLargestSide);
  const bool bitmap = kind == 1 || kind == 4;
  const std::uint64_t brightest = bitmap ? 1 : read_pnm_number(path, rest, "maximum", 65535);
  const std::uint64_t row = width * (kind % 3 == 0 ? 3 : 1);
  std::uint64_t needed = 0;  // with the one white space after the header
  if (kind == 4) needed = 1 + (width + 7) / 8 * height;
  if (kind > 4) needed = 1 + row * height * (brightest > 255 ? 2 : 1);
  if (kind == 1) needed = row * height;
  if (kind == 2 || kind == 3) needed = 2 * row * height;  // a digit and a space each
  if (rest.size() < needed) fail(path, "the file is cut short");
}

}  // namespace swell::texture
