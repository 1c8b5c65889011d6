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
      EXPECT_NEAR(frame.detail[64 * 5 + x], detail, 0.005) << f << " " << x;
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
  for (std::size_t n = 0; n < first.detail.size(); ++n)
    EXPECT_NEAR(between.detail[n], 0.25f * last.detail[n] + 0.75f * first.detail[n], 1e-5f);
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

  std::string error_of(int frames) const {
    try {
      read_bump_sequence(pattern(), frames);
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
