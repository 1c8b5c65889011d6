#include "texture/image/image_structure.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "texture/image/file_bytes.h"

namespace swell::texture {
namespace {

const Bytef* zlib_bytes(std::string_view bytes) {
  return reinterpret_cast<const Bytef*>(bytes.data());
}

std::uint32_t crc32_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, zlib_bytes(bytes), bytes.size()));
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

struct PngHeader {
  int width = 0, height = 0, bits = 0, colour_type = 0;
  bool is_interlaced = false;
};
constexpr int kPaletteColours = 3;  // colour type

PngHeader read_png_header(const std::filesystem::path& path, std::string_view data,
                          const ReadLimits& limits) {
  if (data.size() != 13) fail(path, "the PNG header has {} bytes, allowed: 13", data.size());
  const std::uint32_t width = big_endian_u32(data), height = big_endian_u32(data.substr(4));
  const std::uint32_t largest = static_cast<std::uint32_t>(limits.max_side_px);
  if (width < 1 || height < 1 || width > largest || height > largest) {
    fail(path, "the size is {}x{}, allowed: 1x1 to {}x{}", width, height, largest, largest);
  }
  const int bits = static_cast<std::uint8_t>(data[8]), type = static_cast<std::uint8_t>(data[9]);
  if (bits > 16 || (allowed_png_bits(type) >> bits & 1) == 0) {
    fail(path, "{} bits a channel with colour type {} is no PNG", bits, type);
  }
  if (data[10] != 0 || data[11] != 0 || data[12] < 0 || data[12] > 1) {
    fail(path, "the PNG header names an unknown compression, filter or interlacing");
  }
  return {static_cast<int>(width), static_cast<int>(height), bits, type, data[12] == 1};
}

// What the chunks before one were.
struct PngChunks {
  PngHeader header;
  bool has_palette = false;
  std::vector<std::string_view> pixels;  // compressed, in pieces
  bool pixels_have_ended = false;
};

void check_png_palette(const std::filesystem::path& path, std::string_view data,
                       const PngChunks& before) {
  const PngHeader& header = before.header;
  if (before.has_palette) fail(path, "the PNG has two palettes, allowed: one");
  if (header.colour_type != kPaletteColours) return;  // only a hint
  if (!before.pixels.empty()) fail(path, "the PNG palette comes after the pixels");
  const std::size_t largest = std::size_t{3} << header.bits;
  if (data.empty() || data.size() % 3 != 0 || data.size() > largest) {
    fail(path, "the PNG palette has {} bytes, allowed: 3 to {}, 3 a colour", data.size(), largest);
  }
}

void check_png_chunk(const std::filesystem::path& path, std::string_view type,
                     std::string_view data, PngChunks& before) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  if (!std::ranges::all_of(type, is_letter)) fail(path, "a PNG chunk has no letters for a name");
  if (type == "IDAT") {
    if (before.header.colour_type == kPaletteColours && !before.has_palette)
      fail(path, "the PNG has no palette before its pixels");
    if (before.pixels_have_ended) fail(path, "the PNG's pixels are not in one place");
    before.pixels.push_back(data);
    return;
  }
  before.pixels_have_ended = !before.pixels.empty();
  if (type == "PLTE") {
    check_png_palette(path, data, before);
    before.has_palette = true;
  } else if (type == "IHDR") {
    fail(path, "the PNG has two headers, allowed: one");
  } else if (type[0] >= 'A' && type[0] <= 'Z' && type != "IEND") {
    fail(path, "PNG chunk '{}' is unknown and needed for reading the file", type);
  }
}

// The rows of one pass over an interlaced image, or of all the image.
struct PngPass {
  std::size_t row_bytes = 0, rows = 0;  // with the byte that names the row's filter
};

std::vector<PngPass> png_passes(const PngHeader& header) {
  struct Grid {
    int x, y, dx, dy;
  };
  // Adam7: PNG specification, 8.2.
  constexpr std::array<Grid, 7> kAdam7 = {{{0, 0, 8, 8},
                                           {4, 0, 8, 8},
                                           {0, 4, 4, 8},
                                           {2, 0, 4, 4},
                                           {0, 2, 2, 4},
                                           {1, 0, 2, 2},
                                           {0, 1, 1, 2}}};
  constexpr std::array<Grid, 1> kAll = {{{0, 0, 1, 1}}};
  constexpr std::array<int, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};  // of the colour types
  const std::size_t pixel_bits = static_cast<std::size_t>(header.bits) *
                                 kChannels[static_cast<std::size_t>(header.colour_type)];
  std::vector<PngPass> passes;
  for (const Grid& g : header.is_interlaced ? std::span<const Grid>(kAdam7) : kAll) {
    const int columns = (header.width - g.x + g.dx - 1) / g.dx;
    const int rows = (header.height - g.y + g.dy - 1) / g.dy;
    if (columns < 1 || rows < 1) continue;
    passes.push_back({1 + (static_cast<std::size_t>(columns) * pixel_bits + 7) / 8,
                      static_cast<std::size_t>(rows)});
  }
  return passes;
}

// Reads a zlib stream that lies in pieces.
class Inflater {
 public:
  Inflater(const std::filesystem::path& path, std::span<const std::string_view> pieces)
      : path_(path), pieces_(pieces) {
    if (::inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  // Fills `out` as far as the stream goes; returns the count. Throws FileError.
  std::size_t read(std::span<Bytef> out) {
    stream_.next_out = out.data();
    stream_.avail_out = static_cast<uInt>(out.size());
    while (stream_.avail_out > 0 && !has_ended_) {
      if (stream_.avail_in == 0 && !next_piece()) break;
      const int result = ::inflate(&stream_, Z_NO_FLUSH);
      has_ended_ = result == Z_STREAM_END;
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
        fail(path_, "the PNG's pixels cannot be inflated: {}",
             stream_.msg ? stream_.msg : "a dictionary is needed");
    }
    return out.size() - stream_.avail_out;
  }
  bool has_ended() const { return has_ended_; }

 private:
  bool next_piece() {
    if (pieces_.empty()) return false;
    stream_.next_in = const_cast<Bytef*>(zlib_bytes(pieces_[0]));
    stream_.avail_in = static_cast<uInt>(pieces_[0].size());
    pieces_ = pieces_.subspan(1);
    return true;
  }

  const std::filesystem::path& path_;
  std::span<const std::string_view> pieces_;
  z_stream stream_{};
  bool has_ended_ = false;
};

void check_png_pixels(const std::filesystem::path& path, const PngChunks& chunks) {
  constexpr Bytef kLastFilter = 4;
  Inflater inflater(path, chunks.pixels);
  std::vector<Bytef> row;
  for (const PngPass& pass : png_passes(chunks.header)) {
    row.resize(pass.row_bytes);
    for (std::size_t y = 0; y < pass.rows; ++y) {
      if (inflater.read(row) < row.size()) fail(path, "the PNG's pixels are cut short");
      if (row[0] > kLastFilter) fail(path, "a row has PNG filter {}, allowed: 0 to 4", row[0]);
    }
  }
  // What else there may be is left out by libpng, but the check sum in the end is not.
  std::array<Bytef, 1024> rest;
  if (inflater.read(rest) < rest.size() && !inflater.has_ended())
    fail(path, "the PNG's pixels have no end");
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

void check_png_structure(const std::filesystem::path& path, std::string_view bytes,
                         const ReadLimits& limits) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type, check sum
  std::string_view rest = bytes.substr(kSignature);
  PngChunks chunks;
  for (bool first = true;; first = false) {
    if (rest.size() < kFrame || big_endian_u32(rest) > rest.size() - kFrame) {
      fail(path, "the file is cut short");
    }
    const std::size_t length = big_endian_u32(rest);
    const std::string_view type = rest.substr(4, 4), data = rest.substr(8, length);
    if (crc32_of(rest.substr(4, 4 + length)) != big_endian_u32(rest.substr(8 + length))) {
      fail(path, "the check sum of PNG chunk '{}' is wrong", type);
    }
    if (first && type != "IHDR") fail(path, "the PNG header is not the first chunk");
    if (first)
      chunks.header = read_png_header(path, data, limits);
    else
      check_png_chunk(path, type, data, chunks);
    if (type == "IEND") break;
    rest.remove_prefix(kFrame + length);
  }
  if (chunks.pixels.empty()) fail(path, "the PNG has no pixels");
  check_png_pixels(path, chunks);
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
