#include "texture/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "math/random.h"

namespace swell::texture {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

// A fresh folder for each test, removed afterwards.
class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "swell-texture-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path put(const std::string& name, const Bytes& bytes) const {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return folder / name;
  }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder;
};
using ImageFiles = Files;
using BadImages = Files;
using WriteFile = Files;

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

Bytes content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

long peak_memory_kb() {
  rusage usage;
  if (getrusage(RUSAGE_SELF, &usage) != 0) throw std::runtime_error("no resource usage");
  return usage.ru_maxrss;
}

Image8 random_image8(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(random_bits(1, i)));
  }
  return image;
}

ImageF random_imagef(int width, int height, int channels) {
  ImageF image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) {
    image.pixels.push_back(static_cast<float>(random_uniform(2, i) * 2e4 - 1e4));
  }
  return image;
}

// --- Round trips

TEST_F(ImageFiles, PngAndTiffGiveBackEveryByte) {
  for (const char* extension : {".png", ".tif", ".tiff", ".PNG"}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const Image8 image = random_image8(37, 21, channels);
      const ImageF back =
          read_image(put(std::string("a") + extension, encode_image(image, extension)));
      ASSERT_EQ(back.width, 37);
      ASSERT_EQ(back.height, 21);
      ASSERT_EQ(back.channels, channels);
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_NEAR(back.pixels[i], image.pixels[i] / 255.0, 1e-7) << extension << channels;
      }
    }
  }
}

TEST_F(ImageFiles, ExrAndTiffGiveBackEveryFloat) {
  for (const char* extension : {".exr", ".tif"}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const ImageF image = random_imagef(19, 33, channels);
      const ImageF back =
          read_image(put(std::string("a") + extension, encode_image(image, extension)));
      ASSERT_EQ(back.width, 19);
      ASSERT_EQ(back.channels, channels);
      ASSERT_EQ(back.pixels, image.pixels) << extension << channels;
    }
  }
}

TEST_F(ImageFiles, ExrHoldsTheGivenChannelNames) {
  const std::vector<std::string> names{"depth.Z", "id", "normal.X"};
  const Bytes exr = encode_image(random_imagef(4, 4, 3), ".exr", names);
  const std::string text(exr.begin(), exr.end());
  for (const std::string& name : names) EXPECT_NE(text.find(name), std::string::npos);
}

TEST_F(ImageFiles, OnePixelWorks) {
  const Image8 image{1, 1, 3, {0, 128, 255}};
  const ImageF back = read_image(put("one.png", encode_image(image, ".png")));
  EXPECT_EQ(back.at(0, 0, 0), 0.0f);
  EXPECT_FLOAT_EQ(back.at(0, 0, 1), 128.0f / 255);
  EXPECT_EQ(back.at(0, 0, 2), 1.0f);
}

TEST_F(ImageFiles, PnmAndHdrAreRead) {
  const ImageF ppm = read_image(put("a.ppm", bytes_of("P6 2 1 255\n\xff\x80\x01\x02\x03\x04")));
  EXPECT_EQ(ppm.channels, 3);
  EXPECT_EQ(ppm.at(0, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(ppm.at(1, 0, 2), 4.0f / 255);
  const ImageF pgm = read_image(put("a.pgm", bytes_of("P2\n# text\n3 1\n10\n0 5 10\n")));
  EXPECT_EQ(pgm.at(2, 0, 0), 1.0f);
  EXPECT_NEAR(pgm.at(1, 0, 0), 0.5, 0.003);
  // One run of flat pixels: (128, 64, 32) / 256 with exponent 129 = 2^1.
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n";
  hdr += std::string("\x80\x40\x20\x81\x80\x40\x20\x82", 8);
  const ImageF light = read_image(put("a.hdr", bytes_of(hdr)));
  EXPECT_NEAR(light.at(0, 0, 0), 1.0f, 0.01);
  EXPECT_NEAR(light.at(0, 1, 1), 1.0f, 0.02);
}

TEST_F(ImageFiles, SamePictureIsSameBytesWithoutNotes) {
  const Image8 image = random_image8(64, 48, 3);
  const Bytes png = encode_image(image, ".png");
  EXPECT_EQ(encode_image(image, ".png"), png);
  const std::string text(png.begin(), png.end());
  for (const char* chunk : {"tIME", "tEXt", "iTXt", "zTXt"}) {
    EXPECT_EQ(text.find(chunk), std::string::npos);
  }
  EXPECT_EQ(png[24], 8);  // bits a channel
  EXPECT_EQ(png[25], 2);  // RGB
  const ImageF floats = random_imagef(8, 8, 3);
  const Bytes exr = encode_image(floats, ".exr");
  ::usleep(1100000);  // notes of the time have seconds
  EXPECT_EQ(encode_image(floats, ".exr"), exr);
  EXPECT_EQ(encode_image(image, ".png"), png);
}

TEST_F(ImageFiles, OtherExtensionsAreNotEncoded) {
  EXPECT_THROW(encode_image(random_image8(2, 2, 3), ".exr"), FileError);
  EXPECT_THROW(encode_image(random_image8(2, 2, 3), ".jpg"), FileError);
  EXPECT_THROW(encode_image(random_image8(2, 2, 3), ""), FileError);
  EXPECT_THROW(encode_image(random_imagef(2, 2, 3), ".png"), FileError);
  EXPECT_THROW(encode_image(random_imagef(2, 2, 3), ".hdr"), FileError);
}

// --- Kinds of samples

// A file of one row as OpenImageIO writes it; a type for all channels, or for each.
Bytes encoded(const std::string& format, const std::vector<OIIO::TypeDesc>& types,
              OIIO::TypeDesc pixel_type, const void* row, int width) {
  OIIO::ImageSpec spec(width, 1, static_cast<int>(types.size()), types[0]);
  if (types.size() > 1) spec.channelformats = types;
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->set_ioproxy(&memory) || !output->open("image." + format, spec) ||
      !output->write_image(pixel_type, row) || !output->close())
    throw std::runtime_error("cannot encode " + format);
  return bytes;
}

template <class T>
Bytes encoded(const std::string& format, OIIO::TypeDesc type, const std::vector<T>& row) {
  return encoded(format, {type}, type, row.data(), static_cast<int>(row.size()));
}

TEST_F(ImageFiles, WholeNumbersOfExrAreTakenAsTheyAre) {
  const std::vector<std::uint32_t> row{0, 1, 255, 65535, 16777216, 16777218, 0xffffff00u};
  const ImageF image = read_image(put("a.exr", encoded("openexr", OIIO::TypeUInt32, row)));
  ASSERT_EQ(image.channels, 1);
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_EQ(image.pixels[i], row[i]);
}

TEST_F(ImageFiles, ExrChannelsOfDifferentKindsAreEachTakenAsStored) {
  struct Pixel {
    std::uint16_t half;
    std::uint32_t whole;
    float real;
    std::uint32_t other;
  } __attribute__((packed));
  const Pixel row[] = {{0x3800, 7, -2.25f, 1000}, {0x3400, 65536, 3.5f, 4000000}};
  const Bytes exr =
      encoded("openexr", {OIIO::TypeHalf, OIIO::TypeUInt32, OIIO::TypeFloat, OIIO::TypeUInt32},
              OIIO::TypeUnknown, row, 2);
  const ImageF image = read_image(put("a.exr", exr));
  EXPECT_EQ(image.pixels,
            (std::vector<float>{0.5f, 7.0f, -2.25f, 1000.0f, 0.25f, 65536.0f, 3.5f, 4e6f}));
}

TEST_F(ImageFiles, SamplesOf8And16BitsAreSharesAndFloatsAreTakenAsTheyAre) {
  const std::vector<std::uint8_t> bytes{0, 51, 255};
  const std::vector<std::uint16_t> words{0, 13107, 65535};
  const std::vector<float> floats{-3.5f, 0.2f, 1e6f};
  const std::vector<std::uint16_t> halves{0xc300, 0x3400, 0x7bff};  // -3.5, 0.25, 65504
  const std::vector<float> shares{0.0f, 0.2f, 1.0f};
  const std::pair<std::string, Bytes> files[] = {
      {"8.png", encoded("png", OIIO::TypeUInt8, bytes)},
      {"16.png", encoded("png", OIIO::TypeUInt16, words)},
      {"8.tif", encoded("tiff", OIIO::TypeUInt8, bytes)},
      {"16.tif", encoded("tiff", OIIO::TypeUInt16, words)}};
  for (const auto& [name, file] : files) {
    const ImageF image = read_image(put(name, file));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(image.pixels[i], shares[i]) << name;
  }
  EXPECT_EQ(read_image(put("32f.tif", encoded("tiff", OIIO::TypeFloat, floats))).pixels, floats);
  EXPECT_EQ(read_image(put("32f.exr", encoded("openexr", OIIO::TypeFloat, floats))).pixels, floats);
  EXPECT_EQ(read_image(put("16f.exr", encoded("openexr", OIIO::TypeHalf, halves))).pixels,
            (std::vector<float>{-3.5f, 0.25f, 65504.0f}));
}

// --- Bad files

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
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t count) {
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
  put_u32_big_endian(png, 29, crc32(&png[12], 17));
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

// --- Writing

TEST_F(WriteFile, WritesAndReplaces) {
  const fs::path path = folder / "a.bin";
  write_file(path, bytes_of("first"));
  EXPECT_EQ(content(path), bytes_of("first"));
  write_file(path, bytes_of("second, longer"));
  EXPECT_EQ(content(path), bytes_of("second, longer"));
  write_file(path, {});
  EXPECT_EQ(content(path), Bytes());
  EXPECT_EQ(file_count(), 1u);
  write_file(folder / std::string(250, 'n'), bytes_of("a long name"));
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(WriteFile, FollowsALinkToItsFile) {
  const fs::path file = put("file", bytes_of("old"));
  fs::create_symlink(file, folder / "link");
  write_file(folder / "link", bytes_of("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(file), bytes_of("new"));
}

void expect_write_fails(const fs::path& path) {
  try {
    write_file(path, bytes_of("content"));
    ADD_FAILURE() << path << " was written";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST_F(WriteFile, PlacesThatCannotBeWrittenAreRefused) {
  put("file", bytes_of("old"));
  fs::create_directory(folder / "folder");
  fs::create_symlink(folder / "loop", folder / "loop");
  const std::size_t before = file_count();
  expect_write_fails(folder / "missing" / "a.png");
  expect_write_fails(folder / "file" / "a.png");  // below a file
  expect_write_fails(folder / "folder");
  expect_write_fails(folder / std::string(300, 'x'));
  expect_write_fails(folder / "loop");
  expect_write_fails("/proc/swell.png");
  expect_write_fails("/dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(file_count(), before);
  EXPECT_TRUE(fs::is_empty(folder / "folder"));
  EXPECT_EQ(content(folder / "file"), bytes_of("old"));
}

TEST_F(WriteFile, FullDiskLeavesTheOldFileAndNoOther) {
  const fs::path path = put("a.bin", bytes_of("old"));
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(3);
    try {
      write_file(path, Bytes(5000, 'x'));
    } catch (const FileError&) {
      _exit(7);
    }
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(content(path), bytes_of("old"));
  EXPECT_EQ(file_count(), 1u);
}

}  // namespace
}  // namespace swell::texture
