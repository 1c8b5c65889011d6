// Picture files that are broken, too large or none: refused quickly, in one line that names them.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "texture/image_files.h"

namespace swell::texture {
namespace {

using BadImages = Files;

long peak_memory_kb() {
  rusage usage;
  if (getrusage(RUSAGE_SELF, &usage) != 0) throw std::runtime_error("no resource usage");
  return usage.ru_maxrss;
}

// Reads a file that must be refused: quickly, in one line that names it. Returns the line.
std::string refusal(const fs::path& path, const ReadLimits& limits = {}) {
  const auto start = std::chrono::steady_clock::now();
  std::string line = "(read without an error)";
  try {
    read_image(path, limits);
    ADD_FAILURE() << path << " was read";
  } catch (const FileError& error) {
    line = error.what();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << path;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  EXPECT_EQ(line.rfind(path.string(), 0), 0u) << line;
  EXPECT_NE(line.find(", allowed"), std::string::npos) << line;
  return line;
}

void expect_in(const std::string& line, const std::string& part) {
  EXPECT_NE(line.find(part), std::string::npos) << line;
}

// One small valid file of each format; noise, so that every sixteenth of a file matters.
std::vector<std::pair<std::string, Bytes>> valid_files() {
  std::string ppm = "P6\n40 30\n255\n", pgm = "P2\n40 30\n255\n",
              hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30 +X 40\n";
  for (int i = 0; i < 3600; ++i) ppm += static_cast<char>(random_bits(3, i));
  for (int i = 0; i < 1200; ++i) pgm += std::to_string(random_bits(4, i) % 256) + "\n";
  for (int i = 0; i < 4800; ++i) hdr += static_cast<char>(16 + random_bits(5, i) % 128);
  return {{"a.png", encode_image(random_image8(40, 30, 3), ".png")},
          {"a.exr", encode_image(random_imagef(40, 30, 3), ".exr")},
          {"a.tif", encode_image(random_image8(40, 30, 3), ".tif")},
          {"b.tif", encode_image(random_imagef(40, 30, 1), ".tif")},
          {"a.ppm", bytes_of(ppm)},
          {"a.pgm", bytes_of(pgm)},
          {"a.hdr", bytes_of(hdr)}};
}

TEST_F(BadImages, TheCorpusStartsFromReadableFiles) {
  for (const auto& [name, bytes] : valid_files()) EXPECT_NO_THROW(read_image(put(name, bytes)));
}

TEST_F(BadImages, TruncatedFilesAreRefused) {
  for (const auto& [name, bytes] : valid_files()) {
    for (std::size_t sixteenths = 1; sixteenths < 16; ++sixteenths) {
      const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * sixteenths / 16);
      SCOPED_TRACE(std::to_string(sixteenths) + "/16 of " + name);
      refusal(put(name, Bytes(bytes.begin(), end)));
    }
  }
}

TEST_F(BadImages, BrokenBytesNeverCrashNorPrint) {
  testing::internal::CaptureStderr();
  for (const auto& [name, bytes] : valid_files()) {
    for (std::uint64_t n = 0; n < 60; ++n) {
      Bytes broken = bytes;
      for (std::uint64_t hit = 0; hit < 1 + n % 4; ++hit) {
        // Mostly in the header, where sizes and offsets are.
        const std::uint64_t where = random_bits(6 + hit, n);
        const std::size_t range =
            n % 3 == 0 ? broken.size() : std::min<std::size_t>(200, broken.size());
        broken[where % range] = static_cast<std::uint8_t>(where >> 32);
      }
      try {
        const ImageF image = read_image(put(name, broken));
        for (const float value : image.pixels) ASSERT_TRUE(std::isfinite(value));
      } catch (const FileError&) {
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(BadImages, EmptyAndTinyFilesAreRefused) {
  for (const char* name : {"a.png", "a.exr", "a.hdr", "a.tif", "a.ppm"}) {
    expect_in(refusal(put(name, {})), "empty");
    refusal(put(name, {0x89}));
    refusal(put(name, {'P', '6', '\n'}));
  }
}

TEST_F(BadImages, NameAndContentMustAgreeOnAnAllowedFormat) {
  const Bytes png = encode_image(random_image8(4, 4, 3), ".png");
  expect_in(refusal(put("a.exr", png)), "the content says png");
  expect_in(refusal(put("a.dpx", png)), "not readable");
  expect_in(refusal(put("png", png)), "not readable");
  refusal(put("a.psd", bytes_of("8BPS")));
  expect_in(refusal(put("a.png", bytes_of("SDPX0000000000000000000"))), "no image of");
  expect_in(refusal(put("a.png", bytes_of("SIMPLE  =                    T"))), "no image of");
}

TEST_F(BadImages, ThingsThatAreNoFilesAreRefused) {
  fs::create_directory(folder / "folder.png");
  expect_in(refusal(folder / "folder.png"), "directory");
  ASSERT_EQ(mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  expect_in(refusal(folder / "pipe.png"), "not a regular file");
  fs::create_symlink(folder / "loop.png", folder / "loop.png");
  refusal(folder / "loop.png");
  refusal(folder / "missing.png");
  refusal(folder / "no-folder" / "a.png");
  fs::create_symlink("/dev/zero", folder / "zero.png");
  expect_in(refusal(folder / "zero.png"), "not a regular file");
  refusal(folder / (std::string(300, 'x') + ".png"));
  if (geteuid() != 0) {
    const fs::path secret = put("secret.png", encode_image(random_image8(4, 4, 3), ".png"));
    fs::permissions(secret, fs::perms::none);
    refusal(secret);
  }
}

TEST_F(BadImages, SamplesThatWouldBeMisreadAreRefused) {
  const auto expect_kind = [&](OIIO::TypeDesc type, const auto& row, const std::string& kind) {
    expect_in(refusal(put("a.tif", encoded("tiff", type, row))), "channel 0 holds " + kind);
  };
  expect_kind(OIIO::TypeDesc::UINT32, std::vector<std::uint32_t>{0, 7}, "32-bit unsigned");
  expect_kind(OIIO::TypeDesc::INT8, std::vector<std::int8_t>{0, 7}, "8-bit signed");
  expect_kind(OIIO::TypeDesc::INT16, std::vector<std::int16_t>{0, 7}, "16-bit signed");
  expect_kind(OIIO::TypeDesc::INT32, std::vector<std::int32_t>{0, 7}, "32-bit signed");
  // OpenImageIO 2.4 reads zeros.
  expect_kind(OIIO::TypeDesc::DOUBLE, std::vector<double>{0.0, 7.0}, "64-bit floats");
}

TEST_F(BadImages, WholeNumbersThatNoFloatHoldsAreNamed) {
  for (const std::uint32_t number : {16777217u, 4294967295u, 2147483649u}) {
    const std::vector<std::uint32_t> row{0, 1, number};
    expect_in(refusal(put("a.exr", encoded("openexr", OIIO::TypeUInt32, row))),
              "pixel (2, 0) channel 0 is " + std::to_string(number));
  }
}

// CRC-32 as PNG uses it.
std::uint32_t crc_of(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

void put_u32_big_endian(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

Bytes png_with_header(std::uint32_t width, std::uint32_t height, int bits, int colour_type) {
  Bytes png = encode_image(random_image8(8, 8, 3), ".png");
  put_u32_big_endian(png, 16, width);
  put_u32_big_endian(png, 20, height);
  png[24] = static_cast<std::uint8_t>(bits);
  png[25] = static_cast<std::uint8_t>(colour_type);
  put_u32_big_endian(png, 29, crc_of(&png[12], 17));
  return png;
}

Bytes exr_with_window(int x0, int y0, int x1, int y1) {
  Bytes exr = encode_image(random_imagef(8, 8, 3), ".exr");
  const std::string name("dataWindow\0box2i\0", 17);
  const auto at = std::search(exr.begin(), exr.end(), name.begin(), name.end());
  const int window[4] = {x0, y0, x1, y1};
  std::memcpy(&*at + name.size() + 4, window, sizeof(window));
  return exr;
}

Bytes tiff_with_tag(std::uint16_t tag, std::uint32_t value) {
  Bytes tiff = encode_image(random_image8(8, 8, 3), ".tif");
  std::uint32_t directory;
  std::memcpy(&directory, &tiff[4], 4);
  std::uint16_t entries;
  std::memcpy(&entries, &tiff[directory], 2);
  for (std::size_t i = 0; i < entries; ++i) {
    std::uint8_t* const entry = &tiff[directory + 2 + 12 * i];
    if (std::memcmp(entry, &tag, 2) != 0) continue;
    const std::uint16_t type_u32 = 4;
    std::memcpy(entry + 2, &type_u32, 2);
    std::memcpy(entry + 8, &value, 4);
  }
  return tiff;
}

TEST_F(BadImages, ImpossibleSizesAreRefusedBeforeAllocating) {
  constexpr std::uint32_t kBillion = 1000000000;
  const long peak_before_kb = peak_memory_kb();
  refusal(put("a.png", png_with_header(kBillion, kBillion, 8, 2)));
  refusal(put("a.png", png_with_header(0, 5, 8, 2)));
  refusal(put("a.png", png_with_header(0xfffffffd, 5, 8, 2)));
  expect_in(refusal(put("a.png", png_with_header(20000, 5, 8, 2))), "20000x5");
  refusal(put("a.png", png_with_header(8, 8, 16, 3)));  // palettes have no 16 bits
  refusal(put("a.exr", exr_with_window(0, 0, kBillion, kBillion)));
  refusal(put("a.exr", exr_with_window(0, 0, -1, 4)));
  refusal(put("a.exr", exr_with_window(5, 5, -9, -9)));
  refusal(put("a.exr", exr_with_window(std::numeric_limits<int>::min(), 0, 2147483647, 7)));
  refusal(put("a.tif", tiff_with_tag(256, kBillion)));
  refusal(put("a.tif", tiff_with_tag(257, kBillion)));
  refusal(put("a.tif", tiff_with_tag(256, 0)));
  refusal(put("a.hdr",
              bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000000 +X 1000000000\n0000")));
  refusal(put("a.hdr", bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 5\n0000")));
  refusal(put("a.hdr", bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -3 +X -5\n0000")));
  refusal(put("a.ppm", bytes_of("P6 1000000000 1000000000 255\n0000")));
  refusal(put("a.ppm", bytes_of("P6 0 5 255\n0000")));
  refusal(put("a.ppm", bytes_of("P6 -3 5 255\n0000")));
  refusal(put("a.ppm", bytes_of("P3 99999999999999999999 5 255\n0000")));
  refusal(put("a.ppm", bytes_of("P6 2 2 0\n000000000000")));
  refusal(put("a.ppm", bytes_of("P6 2 2 255\n00000000000")));
  refusal(put("a.pgm", bytes_of("P5 2 2 65535\n0000000")));
  refusal(put("a.pbm", bytes_of("P4 9 2\n000")));
  refusal(put("a.ppm", bytes_of("P6 # no end")));
  // Any of the impossible sizes would take gigabytes.
  EXPECT_LT(peak_memory_kb() - peak_before_kb, 100 * 1024);
}

TEST_F(BadImages, TextInPlaceOfNumbersIsSaid) {
  const std::string line = refusal(put("a.pgm", bytes_of("P2\n3 2\n255\n1 2 3\n4 text 6\n")));
  expect_in(line, "cannot decode the pixels: they are not as the file's header says");
}

TEST_F(BadImages, LimitsAreKept) {
  const fs::path path = put("a.png", encode_image(random_image8(40, 30, 3), ".png"));
  EXPECT_NO_THROW(read_image(path, {.max_side_px = 40, .max_bytes = 40 * 30 * 3 * 4}));
  expect_in(refusal(path, {.max_side_px = 39}), "40x30");
  expect_in(refusal(path, {.max_bytes = 40 * 30 * 3 * 4 - 1}), "14400 bytes");
}

TEST_F(BadImages, TooManyChannelsAreRefused) {
  for (const int channels : {5, 17}) {
    std::vector<std::string> names;
    for (int c = 0; c < channels; ++c) names.emplace_back(1, static_cast<char>('a' + c));
    const Bytes exr = encode_image(random_imagef(3, 3, channels), ".exr", names);
    expect_in(refusal(put("a.exr", exr)), std::to_string(channels) + " channels");
  }
}

TEST_F(BadImages, PixelsThatAreNoNumbersAreNamed) {
  for (const char* name : {"a.exr", "a.tif"}) {
    ImageF image = random_imagef(20, 10, 3);
    image.at(7, 4, 2) = std::nanf("");
    const std::string extension = fs::path(name).extension().string();
    expect_in(refusal(put(name, encode_image(image, extension))), "pixel (7, 4) channel 2 is nan");
    image.at(3, 1, 0) = -std::numeric_limits<float>::infinity();
    expect_in(refusal(put(name, encode_image(image, extension))), "pixel (3, 1) channel 0 is -inf");
  }
}

}  // namespace
}  // namespace swell::texture
