// One binary, one picture: threads, SIMD target, tile size, history and process do not matter.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "apps/render/picture_runs.h"
#include "apps/shared/program_runner.h"
#include "math/simd_target.h"

namespace swell::apps {
namespace {

struct SceneCase {
  const char* name;
  std::string (*text)();
};

class SameBits : public testing::TestWithParam<SceneCase> {
 protected:
  SameBits() { write_text(scene_, GetParam().text()); }

  PictureRun pictures(const Arguments& more) { return run_pictures(scene_, folder_, more); }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("scene.toml");
};

TEST_P(SameBits, ForAnyNumberOfThreads) {
  const PictureRun expected = pictures({"--time", "7.25", "--threads", "1"});
  EXPECT_EQ(expected.hashes.at(0).size(), std::string("0123456789abcdef").size());
  for (const std::string threads : {"2", "3", "7", "16"})
    expect_same_pictures(pictures({"--time", "7.25", "--threads", threads}), expected,
                         threads + "_threads");
}

TEST_P(SameBits, ForEverySimdTarget) {
  const SimdTarget plainest = simd_targets().front(), best = current_simd_target();
  if (plainest == best) GTEST_SKIP() << "this CPU has one SIMD target";
  const auto drawn_on = [&](SimdTarget target) {
    const std::string name(simd_target_name(target));
    return pictures({"--frames", "0-4", "--fps", "0.01", "--simd", name});
  };
  expect_same_pictures(drawn_on(best), drawn_on(plainest), "simd");
}

TEST_P(SameBits, ForEveryTileSize) {
  const PictureRun expected = pictures({"--time", "7.25", "--tile", "64"});
  for (const std::string tile : {"16", "32"})
    expect_same_pictures(pictures({"--time", "7.25", "--tile", tile}), expected, "tile_" + tile);
}

TEST_P(SameBits, ForAFrameAloneAndInASequence) {
  const PictureRun sequence = pictures({"--frames", "0-50", "--fps", "30"});
  for (const int frame : {0, 1, 50}) {
    const PictureRun alone = pictures({"--frames", fmt::format("{0}-{0}", frame), "--fps", "30"});
    expect_same_picture(alone, frame, sequence, frame, fmt::format("alone_{}", frame));
  }
}

TEST_P(SameBits, ForAFrameAndItsTime) {
  const PictureRun frame = pictures({"--frames", "45-45", "--fps", "30"});
  expect_same_picture(frame, 45, pictures({"--time", "1.5"}), 0, "time");
}

// The checks above are blind if nothing decides the picture.
TEST_P(SameBits, ButOtherTimesAndSeedsGiveOtherPictures) {
  const PictureRun picture = pictures({"--time", "7.25"});
  EXPECT_NE(pictures({"--time", "7.3"}).hashes, picture.hashes);
  std::string other_seed = GetParam().text();
  other_seed.insert(other_seed.find("[sea]\n") + 6, "seed = 99\n");
  write_text(scene_, other_seed);
  EXPECT_NE(pictures({"--time", "7.25"}).hashes, picture.hashes);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits,
                         testing::Values(SceneCase{"Sea", sea_scene_text},
                                         SceneCase{"Island", island_scene_text}),
                         [](const auto& test) { return test.param.name; });

// A check that only says "different" helps nobody.
TEST(PictureDifference, NamesTheFirstPixelAndItsTileAndKeepsThePictures) {
  const ScratchFolder folder;
  texture::Image8 expected{160, 90, 3, std::vector<std::uint8_t>(160 * 90 * 3, 100)};
  EXPECT_EQ(picture_difference(expected, expected, folder.path(), "none"), "");
  EXPECT_TRUE(folder.names().empty());
  texture::Image8 actual = expected;
  actual.pixels[3 * (70 * 160 + 130) + 1] = 102;
  actual.pixels[3 * (80 * 160 + 3)] = 0;
  const std::string text = picture_difference(actual, expected, folder.path(), "two");
  EXPECT_TRUE(
      text.starts_with("2 pixels differ, first (130, 70) in tile (2, 1): "
                       "is 100 102 100, expected 100 100 100"))
      << text;
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"two_actual.png", "two_difference.png", "two_expected.png"}));
}

}  // namespace
}  // namespace swell::apps
