// Pictures written and read again.
#include <unistd.h>

#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "texture/image_files.h"

namespace swell::texture {
namespace {

using ImageFiles = Files;

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

// OpenImageIO 2.5 ends processes whose threads set it up at once.
TEST(ImageFilesDeathTest, AreReadByThreadsAtOnce) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // in a process that has not set it up
  const ScratchFolder folder;
  const std::string file = folder.write("a.ppm", "P6 2 1 255\nabcdef").string();
  const auto read = [&] {
    std::vector<std::thread> threads;
    for (int n = 0; n < 8; ++n) threads.emplace_back([&] { read_image(file); });
    for (std::thread& thread : threads) thread.join();
    std::exit(0);
  };
  for (int n = 0; n < 5; ++n) EXPECT_EXIT(read(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace swell::texture
