// Sequences of bump images: their pairs, what lies between two frames, and files that are none.
#include "texture/bump_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constants.h"
#include "texture/image_files.h"

namespace swell::texture {
namespace {

// Waves along x, three to a picture, that go on by a quarter of a wave from frame to frame.
std::vector<ImageF> waves(int size, int frames, double height) {
  std::vector<ImageF> heights;
  for (int f = 0; f < frames; ++f) {
    ImageF image{size, size, 1, std::vector<float>(static_cast<std::size_t>(size) * size)};
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        image.at(x, y, 0) =
            static_cast<float>(height * std::sin(kTurn * (3.0 * x / size - 0.25 * f)));
    heights.push_back(image);
  }
  return heights;
}

// A sine's slopes are a cosine of root 2 times their root mean square; 8 bits are good to 1/127.
TEST(BumpSequence, HasTheSlopesOfItsHeights) {
  const BumpSequence sequence = make_bump_sequence(waves(64, 4, 17.0));
  BumpFrame frame;
  for (const int f : {0, 1, 3}) {
    blend_frames(sequence, 0.25 * f, frame);
    for (int x = 0; x < 64; ++x) {
      const double turns = kTurn * (3.0 * x / 64 - 0.25 * f);
      const double slope = std::sqrt(2.0) * static_cast<double>(kBumpSlope) * std::cos(turns);
      EXPECT_NEAR(frame.slope_x[64 * 5 + x], slope, 0.012) << f << " " << x;
      EXPECT_NEAR(frame.slope_y[64 * 5 + x], 0.0, 0.006) << f << " " << x;
      const double detail = std::sqrt(2.0) * static_cast<double>(kBumpDetail) * std::sin(turns);
      EXPECT_NEAR(frame.detail[0][64 * 5 + x], detail, 0.005) << f << " " << x;
    }
  }
}

TEST(BumpSequence, DoesNotDependOnTheUnitOfHeights) {
  const BumpSequence a = make_bump_sequence(waves(32, 3, 1e-3)),
                     b = make_bump_sequence(waves(32, 3, 4096e-3));
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(a.normals[f].pixels, b.normals[f].pixels);
    EXPECT_EQ(a.details[f].pixels, b.details[f].pixels);
  }
}

TEST(BumpSequence, GoesOverFromTheLastFrameToTheFirst) {
  const BumpSequence sequence = make_bump_sequence(waves(32, 3, 1.0));
  BumpFrame first, last, between, again;
  blend_frames(sequence, 0.0, first);
  blend_frames(sequence, 1.0, again);
  EXPECT_EQ(again.slope_x, first.slope_x);
  EXPECT_EQ(again.slope_y, first.slope_y);
  EXPECT_EQ(again.detail, first.detail);
  blend_frames(sequence, 2.0 / 3.0 + 1e-12, last);
  blend_frames(sequence, 2.75 / 3.0, between);
  for (std::size_t n = 0; n < first.detail[0].size(); ++n)
    EXPECT_NEAR(between.detail[0][n], 0.25f * last.detail[0][n] + 0.75f * first.detail[0][n],
                1e-5f);
}

TEST(BumpSequence, NumbersItsFiles) {
  EXPECT_EQ(path_of_frame("a/waves_%04d.png", 7), "a/waves_0007.png");
  EXPECT_EQ(path_of_frame("%04d", 12345), "12345");
}

// ---- Files

class BumpFiles : public Files {
 protected:
  // Frames as 8-bit pictures, north on top.
  std::string write(const std::vector<ImageF>& heights) const {
    for (std::size_t f = 0; f < heights.size(); ++f) {
      const ImageF& image = heights[f];
      Image8 picture{image.width, image.height, 1, {}};
      for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x)
          picture.pixels.push_back(static_cast<std::uint8_t>(
              std::lround(127.5 + 120.0 * static_cast<double>(image.at(x, y, 0)))));
      write_file(path_of_frame(pattern(), static_cast<int>(f)), encode_image(picture, ".png"));
    }
    return pattern();
  }
  std::string pattern() const { return (folder / "bump_%04d.png").string(); }

  // A picture with row 0 in the south as frame f.
  void write_picture(const Image8& image, int f) const {
    Image8 picture{image.width, image.height, image.channels, {}};
    const auto row = static_cast<std::ptrdiff_t>(image.width) * image.channels;
    for (int y = image.height - 1; y >= 0; --y)
      picture.pixels.insert(picture.pixels.end(), image.pixels.begin() + y * row,
                            image.pixels.begin() + (y + 1) * row);
    write_file(path_of_frame(pattern(), f), encode_image(picture, ".png"));
  }

  std::string error_of(int frames, BumpPictures pictures = BumpPictures::kHeights) const {
    try {
      read_bump_sequence(pattern(), frames, pictures);
    } catch (const FileError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(BumpFiles, AreReadAsTheyWereWritten) {
  std::vector<ImageF> heights = waves(32, 3, 1.0);
  for (ImageF& image : heights) image.at(4, 9, 0) = 0.0f;  // not alike to the north and the south
  const BumpSequence read = read_bump_sequence(write(heights), 3),
                     made = make_bump_sequence(heights);
  ASSERT_EQ(read.size, 32);
  ASSERT_EQ(read.normals.size(), 3u);
  for (std::size_t f = 0; f < 3; ++f)
    for (std::size_t n = 0; n < made.normals[f].pixels.size(); ++n)
      EXPECT_NEAR(read.normals[f].pixels[n], made.normals[f].pixels[n], 3) << f << " " << n;
}

// The paper's pairs: the same waves as heights and as the normals that its tangents give.
TEST_F(BumpFiles, OfNormalsGiveTheSlopesOfTheirHeights) {
  const std::vector<ImageF> heights = waves(64, 3, 1.0);
  const BumpSequence made = make_bump_sequence(heights);
  for (int f = 0; f < 3; ++f) write_picture(made.normals[f], f);
  const BumpSequence read = read_bump_sequence(pattern(), 3, BumpPictures::kNormals);
  BumpFrame of_heights, of_normals;
  for (const double part : {0.0, 0.5, 0.9}) {
    blend_frames(made, part, of_heights);
    blend_frames(read, part, of_normals);
    for (std::size_t n = 0; n < of_heights.slope_x.size(); n += 7) {
      EXPECT_NEAR(of_normals.slope_x[n], of_heights.slope_x[n], 0.02) << n;
      EXPECT_NEAR(of_normals.slope_y[n], of_heights.slope_y[n], 0.02) << n;
      EXPECT_NEAR(of_normals.detail[0][n], 0.0, 0.01);
    }
  }
}

// A code of 188 is half of the light of 255: (188 / 255) of sRGB is 0.503.
TEST_F(BumpFiles, OfColoursTintByThemAsPartsOfTheirMean) {
  BumpSequence sequence = make_bump_sequence(waves(32, 2, 1.0));
  Image8 picture{32, 32, 3, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (const int code : {y < 16 ? 255 : 0, 188, 0})
        picture.pixels.push_back(static_cast<std::uint8_t>(code));
  // The first row of the file is the north, of the sequence the south.
  for (const int f : {0, 1}) write_file(path_of_frame(pattern(), f), encode_image(picture, ".png"));
  read_bump_details(pattern(), sequence);
  EXPECT_NEAR(sequence.tint.x, 0.5 / 0.503, 0.006);
  EXPECT_EQ(sequence.tint.y, 1.0f);
  EXPECT_EQ(sequence.tint.z, 0.0f);
  BumpFrame frame;
  blend_frames(sequence, 0.25, frame);
  ASSERT_EQ(frame.detail.size(), 3u);
  EXPECT_NEAR(frame.detail[0][0], -1.0, 1e-6);
  EXPECT_NEAR(frame.detail[0][31 * 32], 1.0, 1e-6);
  for (std::size_t n = 0; n < 32 * 32; ++n) EXPECT_NEAR(frame.detail[1][n], 0.0, 0.005);
}

TEST_F(BumpFiles, OfColoursOrNormalsThatAreNoneAreRefused) {
  write(waves(32, 2, 1.0));
  BumpSequence sequence = read_bump_sequence(pattern(), 2);
  const auto error_of_details = [&] {
    try {
      read_bump_details(pattern(), sequence);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(error_of_details().find("got a picture of 1 channels, allowed 3 and more"),
            std::string::npos);
  EXPECT_NE(error_of(2, BumpPictures::kNormals).find("allowed 3 and more"), std::string::npos);
  for (const int f : {0, 1})
    write_picture({32, 32, 3, std::vector<std::uint8_t>(3 * 32 * 32, 128)}, f);
  EXPECT_EQ(error_of_details(), "");
  EXPECT_NE(error_of(2, BumpPictures::kNormals).find("got normals with slopes of 0,"),
            std::string::npos);
  for (const int f : {0, 1})
    write_picture({64, 64, 3, std::vector<std::uint8_t>(3 * 64 * 64, 128)}, f);
  EXPECT_NE(error_of_details().find("got 64 x 64 pixels, allowed a square of 32, as the first"),
            std::string::npos);
}

TEST_F(BumpFiles, ThatAreNoSequenceAreRefused) {
  EXPECT_NE(error_of(2).find("bump_0000.png"), std::string::npos);
  write(waves(32, 2, 1.0));
  EXPECT_EQ(error_of(2), "");
  EXPECT_NE(error_of(3).find("bump_0002.png"), std::string::npos);
  std::vector<ImageF> mixed = waves(64, 1, 1.0);
  mixed.push_back(waves(32, 1, 1.0)[0]);
  write(mixed);
  EXPECT_NE(error_of(2).find("got 32 x 32 pixels, allowed a square of 64, as the first"),
            std::string::npos);
  write({{32, 16, 1, std::vector<float>(512)}});
  EXPECT_NE(error_of(1).find("got 32 x 16 pixels, allowed a square of 32 to 512"),
            std::string::npos);
  write({{48, 48, 1, std::vector<float>(48 * 48)}});
  EXPECT_NE(error_of(1).find("a power of two"), std::string::npos);
  write({{32, 32, 1, std::vector<float>(1024)}});
  EXPECT_NE(error_of(1).find("heights that differ by 0"), std::string::npos);
  write(waves(512, 1, 1.0));
  EXPECT_NE(error_of(65).find("got 65 frames of 512 pixels a side, allowed 64"), std::string::npos);
}

}  // namespace
}  // namespace swell::texture
