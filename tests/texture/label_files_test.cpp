// Files for labelled pictures: EXR of many channels, PNG of 16 bits, NumPy arrays.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>

#include "math/random.h"
#include "scratch_folder.h"
#include "texture/image/exr_channels.h"
#include "texture/image/image_io.h"
#include "texture/image/npy.h"

namespace swell::texture {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A fresh folder for each test, removed afterwards.
class LabelFiles : public testing::Test {
 protected:
  const ScratchFolder scratch;
  const fs::path folder = scratch.path();
};
using ExrChannels = LabelFiles;
using Png16 = LabelFiles;
using Npy = LabelFiles;

// Any bits that are a number or an infinity.
std::vector<float> random_label_values(std::size_t count, std::uint64_t seed) {
  std::vector<float> values = {kInfinity, -kInfinity, -0.0f, 1e-42f, 65505.0f, 16777217.0f};
  for (std::uint64_t n = 0; values.size() < count; ++n) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random_bits(seed, n)));
    if (value == value) values.push_back(value);
  }
  return values;
}

std::vector<std::uint32_t> random_words(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> values = {0, 1, 2049, 16777217, 0x7fffffff, 0x80000000, 0xffffffff};
  for (std::uint64_t n = 0; values.size() < count; ++n)
    values.push_back(static_cast<std::uint32_t>(random_bits(seed, n)));
  return values;
}

std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

// What OpenImageIO reads, by the channels' names: types and bits.
struct ReadChannel {
  OIIO::TypeDesc type;
  std::vector<std::uint32_t> bits;
};
struct ReadExr {
  OIIO::ImageSpec spec;
  std::map<std::string, ReadChannel> channels;
};
ReadExr read_exr(const fs::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  ReadExr read{input->spec(), {}};
  for (int c = 0; c < read.spec.nchannels; ++c) {
    ReadChannel& channel = read.channels[read.spec.channelnames[static_cast<std::size_t>(c)]];
    channel.type = read.spec.channelformat(c);
    channel.bits.resize(std::size_t{1} * read.spec.width * read.spec.height);
    if (!input->read_image(0, 0, c, c + 1, channel.type, channel.bits.data()))
      throw std::runtime_error(input->geterror());
  }
  return read;
}

// --- EXR

TEST_F(ExrChannels, ComeBackByNameWithEveryBit) {
  constexpr int kWidth = 37, kHeight = 21;
  constexpr std::size_t kPixels = kWidth * kHeight;
  const std::vector<std::string> float_names = {"R",   "G",   "B",   "Z",        "P.X",     "P.Y",
                                                "P.Z", "N.X", "N.Z", "motion.Y", "motion.X"};
  const std::vector<std::string> word_names = {"id", "class"};
  std::map<std::string, std::vector<float>> floats;
  std::map<std::string, std::vector<std::uint32_t>> words;
  std::vector<ExrChannel> channels;
  for (const std::string& name : float_names) {
    floats[name] = random_label_values(kPixels, channels.size());
    channels.push_back({name, floats[name]});
  }
  for (const std::string& name : word_names) {
    words[name] = random_words(kPixels, channels.size());
    channels.insert(channels.begin() + 2, {name, words[name]});
  }
  write_file(folder / "a.exr", encode_exr(kWidth, kHeight, channels));
  const ReadExr read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.spec.width, kWidth);
  EXPECT_EQ(read.spec.height, kHeight);
  EXPECT_EQ(read.spec.get_string_attribute("compression"), "zip");
  ASSERT_EQ(read.channels.size(), channels.size());
  for (const auto& [name, values] : floats) {
    ASSERT_TRUE(read.channels.contains(name)) << name;
    EXPECT_EQ(read.channels.at(name).type, OIIO::TypeFloat) << name;
    EXPECT_EQ(read.channels.at(name).bits, bits_of(values)) << name;
  }
  for (const auto& [name, values] : words) {
    ASSERT_TRUE(read.channels.contains(name)) << name;
    EXPECT_EQ(read.channels.at(name).type, OIIO::TypeUInt32) << name;
    EXPECT_EQ(read.channels.at(name).bits, values) << name;
  }
}

// The list of channels as the file format has it: names in order, each with type 0 (UINT) or 2
// (FLOAT) in the four bytes after its end.
// Source: OpenEXR, "OpenEXR File Layout", channel list attribute.
TEST_F(ExrChannels, StandInTheFileInTheOrderOfTheirNames) {
  const std::vector<float> z = {1.0f, kInfinity};
  const std::vector<std::uint32_t> id = {7, 0xffffffff};
  const ExrChannel channels[] = {{"id", id}, {"Z", z}, {"A.long name", z}};
  const Bytes bytes = encode_exr(2, 1, channels);
  const std::string text(bytes.begin(), bytes.end());
  std::size_t at = text.find(std::string("channels\0chlist\0", 16));
  ASSERT_NE(at, std::string::npos);
  at += 20;
  for (const auto& [name, type] :
       {std::pair<std::string, int>{"A.long name", 2}, {"Z", 2}, {"id", 0}}) {
    ASSERT_EQ(text.substr(at, name.size() + 1), name + '\0');
    EXPECT_EQ(text[at + name.size() + 1], type) << name;
    at += name.size() + 1 + 16;
  }
  EXPECT_EQ(text[at], '\0');
}

TEST_F(ExrChannels, HoldNotes) {
  const std::vector<float> z = {1.0f};
  const ExrChannel channel{"Z", z};
  const ImageNote notes[] = {{"swell:scene_xxh3", "0123456789abcdef"},
                             {"swell:version", "1.2 \"beta\", \xc3\xa9"}};
  const Bytes bytes = encode_exr(1, 1, {&channel, 1}, {.notes = notes});
  write_file(folder / "a.exr", bytes);
  const OIIO::ImageSpec spec = read_exr(folder / "a.exr").spec;
  for (const auto& [name, text] : notes) EXPECT_EQ(spec.get_string_attribute(name), text) << name;
  EXPECT_EQ(encode_exr(1, 1, {&channel, 1}, {.notes = notes}), bytes);
}

TEST_F(ExrChannels, OurOwnReaderTakesThem) {
  const std::vector<float> z = {1.5f, -2.0f};
  const std::vector<std::uint32_t> id = {3, 16777216};
  const ExrChannel channels[] = {{"Z", z}, {"id", id}};
  write_file(folder / "a.exr", encode_exr(1, 2, channels));
  const ImageF image = read_image(folder / "a.exr");
  EXPECT_EQ(image.pixels, (std::vector<float>{1.5f, 3.0f, -2.0f, 16777216.0f}));
}

TEST(ExrChannelsDeathTest, WhatDoesNotFitIsTheCallersMistake) {
  const std::vector<float> z = {1.0f, 2.0f};
  const ExrChannel channels[] = {{"Z", z}, {"Z", z}};
  EXPECT_DEATH(encode_exr(2, 1, channels), "two Z");
  EXPECT_DEATH(encode_exr(3, 1, {channels, 1}), "Z: count=2 pixels=3");
  EXPECT_DEATH(encode_exr(2, 1, {}), "channels=0");
}

// --- PNG of 16 bits

// All samples, by OpenImageIO as 16-bit numbers.
TEST_F(Png16, GivesBackEveryNumber) {
  Image16 image{256, 256, 1, {}};
  for (int i = 0; i < 65536; ++i) image.pixels.push_back(static_cast<std::uint16_t>(i));
  const Bytes png = encode_image(image, ".png");
  EXPECT_EQ(png[24], 16);  // bits a channel
  EXPECT_EQ(png[25], 0);   // grey
  EXPECT_EQ(encode_image(image, ".png"), png);
  write_file(folder / "a.png", png);
  const auto input = OIIO::ImageInput::open((folder / "a.png").string());
  ASSERT_TRUE(input);
  std::vector<std::uint16_t> back(image.pixels.size());
  ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeUInt16, back.data()));
  EXPECT_EQ(back, image.pixels);
}

TEST_F(Png16, HoldsThreeChannelsAndTiffTheSame) {
  Image16 image{5, 3, 3, {}};
  for (std::uint64_t i = 0; i < 45; ++i)
    image.pixels.push_back(static_cast<std::uint16_t>(random_bits(9, i)));
  for (const char* name : {"a.png", "a.tif"}) {
    write_file(folder / name, encode_image(image, fs::path(name).extension().string()));
    const ImageF back = read_image(folder / name);
    ASSERT_EQ(back.channels, 3);
    for (std::size_t i = 0; i < 45; ++i)
      EXPECT_EQ(std::lround(65535.0f * back.pixels[i]), image.pixels[i]) << name;
  }
  EXPECT_THROW(encode_image(image, ".exr"), FileError);
}

// --- NumPy

// Byte by byte what numpy.save writes for numpy.array([[1, 2, 3]], dtype="<u2").
TEST_F(Npy, HasTheDocumentedLayout) {
  const std::vector<std::uint16_t> values = {1, 2, 0xabcd};
  const Bytes bytes = encode_npy(values, 1, 3);
  std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
  expected += "{'descr': '<u2', 'fortran_order': False, 'shape': (1, 3), }";
  expected.resize(127, ' ');
  expected += '\n';
  expected += std::string("\x01\x00\x02\x00\xcd\xab", 6);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), expected);
}

TEST_F(Npy, SaysTypeAndShape) {
  const std::vector<float> floats = random_label_values(24, 1);
  const std::vector<std::uint32_t> words = random_words(24, 2);
  const std::vector<std::uint8_t> small(24, 9);
  const auto head = [](const Bytes& bytes) {
    return std::string(bytes.begin(), bytes.begin() + 128);
  };
  EXPECT_NE(head(encode_npy(floats, 2, 4, 3))
                .find("'<f4', 'fortran_order': False, 'shape': (2, 4, 3), }"),
            std::string::npos);
  EXPECT_NE(
      head(encode_npy(words, 24, 1)).find("'<u4', 'fortran_order': False, 'shape': (24, 1), }"),
      std::string::npos);
  EXPECT_NE(
      head(encode_npy(small, 4, 6, 1)).find("'|u1', 'fortran_order': False, 'shape': (4, 6, 1), }"),
      std::string::npos);
  const Bytes bytes = encode_npy(floats, 2, 4, 3);
  ASSERT_EQ(bytes.size(), 128u + 96u);
  std::vector<std::uint32_t> back(24);
  std::memcpy(back.data(), &bytes[128], 96);
  EXPECT_EQ(back, bits_of(floats));
}

TEST_F(Npy, IsReadByNumPy) {
  if (std::system("python3 -c 'import numpy' 2> /dev/null") != 0)
    GTEST_SKIP() << "python3 has no numpy";
  const std::vector<float> floats = {1.0f, -2.5f, kInfinity, 4.0f, 5.0f, 6.0f};
  write_file(folder / "a.npy", encode_npy(floats, 1, 2, 3));
  const std::vector<std::uint32_t> words = {1, 2, 3, 0xffffffff};
  write_file(folder / "b.npy", encode_npy(words, 2, 2));
  const std::string program =
      "import numpy, sys\n"
      "a, b = (numpy.load(sys.argv[1] + name) for name in ('/a.npy', '/b.npy'))\n"
      "assert a.dtype == numpy.float32 and a.shape == (1, 2, 3)\n"
      "assert a.tolist() == [[[1, -2.5, float('inf')], [4, 5, 6]]]\n"
      "assert b.dtype == numpy.uint32 and b.tolist() == [[1, 2], [3, 4294967295]]\n";
  std::ofstream(folder / "check.py") << program;
  const std::string command = "python3 " + (folder / "check.py").string() + " " + folder.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(NpyDeathTest, ACountThatIsNotTheShapesIsTheCallersMistake) {
  const std::vector<std::uint8_t> values(6);
  EXPECT_DEATH(encode_npy(values, 2, 2), "count=6 shape=\\(2, 2\\)");
}

}  // namespace
}  // namespace swell::texture
