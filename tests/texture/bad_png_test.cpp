// Broken PNGs with right check sums: refused in the one line that the exception has, whatever
// libpng would print.
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>

#include "math/random.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::texture {
namespace {

namespace fs = std::filesystem;

std::string u32(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return u32(static_cast<std::uint32_t>(data.size())) + body + u32(static_cast<std::uint32_t>(sum));
}

std::string header(int width, int height, int bits, int colour_type, int interlacing = 0) {
  std::string data =
      u32(static_cast<std::uint32_t>(width)) + u32(static_cast<std::uint32_t>(height));
  for (const int byte : {bits, colour_type, 0, 0, interlacing}) data += static_cast<char>(byte);
  return chunk("IHDR", data);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

std::string pixels(const std::string& rows) { return chunk("IDAT", deflated(rows)); }

// Rows of random bytes, each after the byte that names its filter (0 to 4).
std::string random_rows(int width, int height, int pixel_bits) {
  std::string rows;
  for (int y = 0; y < height; ++y) {
    rows += static_cast<char>(y % 5);
    for (int i = 0; i < (width * pixel_bits + 7) / 8; ++i)
      rows += static_cast<char>(random_bits(static_cast<std::uint64_t>(y), i));
  }
  return rows;
}

const std::string kSignature = "\x89PNG\r\n\x1a\n", kEnd = chunk("IEND", "");

class BadPng : public testing::Test {
 protected:
  // Reads the file; "" if it could be read, else the refusal without the file's name. Nothing may
  // be printed.
  std::string refusal(const std::string& chunks) {
    std::ofstream(path_, std::ios::binary) << kSignature << chunks << kEnd;
    testing::internal::CaptureStderr();
    std::string line;
    try {
      read_image(path_);
    } catch (const FileError& error) {
      line = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << line;
    if (line.empty()) return line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_TRUE(line.starts_with(path_.string() + ": ")) << line;
    return line.substr(path_.string().size() + 2);
  }
  void expect_refused(const std::string& chunks, const std::string& piece) {
    const std::string line = refusal(chunks);
    EXPECT_NE(line.find(piece), std::string::npos) << "'" << line << "' lacks '" << piece << "'";
    EXPECT_NE(line, "");
  }

  const ScratchFolder folder_;
  const fs::path path_ = folder_.path() / "bad.png";
};

constexpr int kPngWidth = 13, kPngHeight = 9;
const std::string kRgb = header(kPngWidth, kPngHeight, 8, 2),
                  kPalette = header(kPngWidth, kPngHeight, 8, 3);

TEST_F(BadPng, PixelsThatCannotBeInflatedAreRefused) {
  const std::string rows = random_rows(kPngWidth, kPngHeight, 24), stream = deflated(rows);
  EXPECT_EQ(refusal(kRgb + chunk("IDAT", stream)), "");
  for (std::size_t i = 0; i < stream.size(); ++i) {
    constexpr std::size_t kStoredBlock = 2;  // whose first byte has five bits that mean nothing
    std::string broken = stream;
    broken[i] = static_cast<char>(broken[i] ^ (i == kStoredBlock ? 2 : 1 << random_bits(7, i) % 8));
    EXPECT_NE(refusal(kRgb + chunk("IDAT", broken)), "") << i;
    EXPECT_NE(refusal(kRgb + chunk("IDAT", stream.substr(0, i))), "") << i;
  }
  EXPECT_EQ(refusal(kRgb + chunk("IDAT", stream + "more")), "");
}

TEST_F(BadPng, PixelsInPiecesAreOneStream) {
  const std::string stream = deflated(random_rows(kPngWidth, kPngHeight, 24));
  const std::string first = chunk("IDAT", stream.substr(0, 20)),
                    second = chunk("IDAT", stream.substr(20)), none = chunk("IDAT", "");
  EXPECT_EQ(refusal(kRgb + none + first + none + second + none), "");
  expect_refused(kRgb + first + chunk("tEXt", std::string("a\0b", 3)) + second, "not in one place");
  expect_refused(kRgb + second + first, "inflated");
  expect_refused(kRgb + none, "cut short");
  expect_refused(kRgb, "no pixels");
}

TEST_F(BadPng, TooFewRowsAndUnknownFiltersAreRefused) {
  const std::string rows = random_rows(kPngWidth, kPngHeight, 24);
  expect_refused(kRgb + pixels(rows.substr(0, rows.size() - 1)), "cut short");
  EXPECT_EQ(refusal(kRgb + pixels(rows + "more")), "");
  for (int y = 0; y < kPngHeight; ++y) {
    std::string filtered = rows;
    filtered[static_cast<std::size_t>(y * (1 + 3 * kPngWidth))] =
        static_cast<char>(5 + 50 * y % 251);
    expect_refused(kRgb + pixels(filtered), "filter");
  }
}

// Pictures have every colour type and depth, interlaced and not, and sizes where passes are empty.
TEST_F(BadPng, EveryKindIsReadWholeAndRefusedAByteShort) {
  struct Kind {
    int colour_type, channels;
    std::vector<int> bits;
  };
  const Kind kinds[] = {{0, 1, {1, 2, 4, 8, 16}},
                        {2, 3, {8, 16}},
                        {3, 1, {1, 2, 4, 8}},
                        {4, 2, {8, 16}},
                        {6, 4, {8, 16}}};
  const int grids[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                           {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};  // x, y, dx, dy
  for (const Kind& kind : kinds) {
    for (const int bits : kind.bits) {
      for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 2), std::pair(13, 9)}) {
        SCOPED_TRACE(testing::Message() << "type " << kind.colour_type << " bits " << bits
                                        << " size " << width << "x" << height);
        std::string passes;
        for (const auto& [x, y, dx, dy] : grids)
          if (width > x && height > y)
            passes += random_rows((width - x + dx - 1) / dx, (height - y + dy - 1) / dy,
                                  bits * kind.channels);
        const std::string colours(static_cast<std::size_t>(3 << bits), 'c');
        const std::string palette = kind.colour_type == 3 ? chunk("PLTE", colours) : "";
        const std::string rows = random_rows(width, height, bits * kind.channels);
        for (const auto& [interlacing, data] : {std::pair(0, rows), std::pair(1, passes)}) {
          const std::string head = header(width, height, bits, kind.colour_type, interlacing);
          EXPECT_EQ(refusal(head + palette + pixels(data)), "");
          expect_refused(head + palette + pixels(data.substr(0, data.size() - 1)), "cut short");
        }
      }
    }
  }
}

TEST_F(BadPng, PalettesThatDoNotFitAreRefused) {
  const std::string indices = pixels(random_rows(kPngWidth, kPngHeight, 8));
  const auto palette = [](std::size_t bytes) { return chunk("PLTE", std::string(bytes, 'c')); };
  EXPECT_EQ(refusal(kPalette + palette(768) + indices), "");
  EXPECT_EQ(refusal(kPalette + palette(30) + indices), "");  // what is missing is black
  for (const std::size_t bytes : {0u, 1u, 31u, 771u})
    expect_refused(kPalette + palette(bytes) + indices, "palette has");
  expect_refused(header(kPngWidth, kPngHeight, 1, 3) + palette(9) + indices, "palette has 9");
  expect_refused(kPalette + indices, "no palette");
  expect_refused(kPalette + indices + palette(768), "no palette");
  expect_refused(kPalette + palette(768) + palette(768) + indices, "two palettes");
  // The transparency of a palette, or of one colour, is never worth an error.
  for (const std::size_t bytes : {0u, 5u, 6u, 256u, 300u}) {
    const std::string transparency = chunk("tRNS", std::string(bytes, 't'));
    EXPECT_EQ(refusal(kPalette + palette(768) + transparency + indices), "");
    EXPECT_EQ(refusal(kPalette + transparency + palette(768) + indices), "");
    EXPECT_EQ(refusal(kRgb + transparency + pixels(random_rows(kPngWidth, kPngHeight, 24))), "");
  }
}

TEST_F(BadPng, OtherChunksAreReadOrRefusedWithoutAWord) {
  const std::string rgb = pixels(random_rows(kPngWidth, kPngHeight, 24));
  for (const char* type : {"gAMA", "cHRM", "sRGB", "iCCP", "sBIT", "bKGD", "hIST", "pHYs", "sPLT",
                           "tIME", "tEXt", "zTXt", "iTXt", "oFFs", "pCAL", "sCAL", "eXIf", "abCd"})
    for (const std::size_t bytes : {0u, 1u, 4u, 9u, 32u}) {
      const std::string odd = chunk(type, std::string(bytes, '\xff'));
      EXPECT_EQ(refusal(kRgb + odd + rgb), "") << type;
      EXPECT_EQ(refusal(kRgb + odd + odd + rgb + odd), "") << type;
    }
  expect_refused(kRgb + chunk("ABCD", "x") + rgb, "'ABCD'");
  expect_refused(kRgb + chunk("a1Cd", "x") + rgb, "letters");
  expect_refused(kRgb + kRgb + rgb, "two headers");
}

}  // namespace
}  // namespace swell::texture
