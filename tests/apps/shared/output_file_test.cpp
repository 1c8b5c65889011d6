// Files that swell-render and swell-bench write: whole or not there, and what was asked for.
#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <xxhash.h>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  OutputFile() { write_text(scene_, sea_scene_text()); }

  Outcome render(const Arguments& more, const Surroundings& surroundings = {}) {
    Arguments arguments = {"--scene", scene_, "--size", "64x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments, surroundings);
  }

  ScratchFolder scene_folder_, folder_;
  std::string scene_ = scene_folder_.file("sea.toml");
};

struct Picture {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<std::uint8_t> bytes;  // as 8 bit
};

Picture read_picture(const fs::path& path) {
  // On this thread: the library's own pools are not built for the thread checks.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) return {};
  const OIIO::ImageSpec spec = input->spec();
  Picture picture{spec.width, spec.height, spec.channelnames, {}};
  picture.bytes.resize(spec.image_pixels() * spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, picture.bytes.data()))
    picture.bytes.clear();
  return picture;
}

std::string hash_line(int frame, const Picture& picture) {
  return fmt::format("frame {} xxh3 {:016x}\n", frame,
                     XXH3_64bits(picture.bytes.data(), picture.bytes.size()));
}

TEST_F(OutputFile, ThePngHoldsThePixelsThatTheHashNames) {
  const Outcome outcome = render({"--time", "3.5", "--hash", "--out", folder_.file("sea.png")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Picture picture = read_picture(folder_.file("sea.png"));
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(picture.height, 36);
  ASSERT_EQ(picture.bytes.size(), 64u * 36u * 3u);
  EXPECT_EQ(hash_line(0, picture), outcome.out);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"sea.png"});
}

// Linear light is that of every pixel, so of full shading.
TEST_F(OutputFile, TiffHoldsTheSamePixelsAndExrLinearLight) {
  const Outcome tiff = render({"--shading", "full", "--hash", "--out", folder_.file("sea.TIF")});
  ASSERT_EQ(tiff.exit_code, 0) << tiff.err;
  EXPECT_EQ(hash_line(0, read_picture(folder_.file("sea.TIF"))), tiff.out);

  const Outcome exr = render({"--hash", "--out", folder_.file("sea.exr")});
  ASSERT_EQ(exr.exit_code, 0) << exr.err;
  EXPECT_EQ(exr.out, tiff.out) << "the file's format changed the picture";
  const Picture picture = read_picture(folder_.file("sea.exr"));
  EXPECT_EQ(picture.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(picture.bytes.size(), 64u * 36u * 3u);
}

TEST_F(OutputFile, ASequenceWritesOneNumberedFileAFrame) {
  const Outcome outcome =
      render({"--frames", "8-11", "--fps", "24", "--hash", "--out", folder_.file("f_%04d.png")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(folder_.names(),
            (std::vector<std::string>{"f_0008.png", "f_0009.png", "f_0010.png", "f_0011.png"}));
  std::string expected;
  for (int k = 8; k <= 11; ++k)
    expected += hash_line(k, read_picture(folder_.file(fmt::format("f_{:04d}.png", k))));
  EXPECT_EQ(outcome.out, expected);
}

TEST_F(OutputFile, FormatDirectivesOtherThanTheFrameNumberAreOnlyText) {
  const Outcome outcome =
      render({"--frames", "3-4", "--out", folder_.file("100%_%s%n_%02d_%d.png")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(folder_.names(),
            (std::vector<std::string>{"100%_%s%n_03_%d.png", "100%_%s%n_04_%d.png"}));
}

TEST_F(OutputFile, AManyFrameSequenceNeedsAPlaceForTheNumber) {
  const Outcome outcome = render({"--frames", "0-1", "--out", folder_.file("one.png")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"--out", "%04d"})) << outcome.err;
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(OutputFile, ImpossiblePlacesAreRefusedBeforeAnythingIsRead) {
  fs::create_directory(folder_.file("is_a_directory.png"));
  struct Case {
    std::string path, piece;
  };
  const Case places[] = {{folder_.file("missing/x.png"), "a folder that is not there"},
                         {folder_.file("is_a_directory.png"), "directory"},
                         {folder_.file(std::string(300, 'n') + ".png"), "too long"}};
  const Case formats[] = {{folder_.file("x.bmp"), "'.bmp'"}, {folder_.file("x"), ".png"}};
  const auto expect_refused = [](const Outcome& outcome, const Case& c) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(outcome.err, {c.path, c.piece})) << outcome.err;
  };
  for (const Case& c : places) {
    expect_refused(run_render({"--scene", "no_such_scene.toml", "--out", c.path}), c);
    expect_refused(run_bench({"frame", "--scene", "no_such_scene.toml", "--json", c.path}), c);
    expect_refused(run_bench({"frame", "--scene", "no_such_scene.toml", "--trace", c.path}), c);
  }
  for (const Case& c : formats)
    expect_refused(run_render({"--scene", "no_such_scene.toml", "--out", c.path}), c);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(OutputFile, AReadOnlyDirectoryIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = render({"--out", folder_.file("x.png")});
  fs::permissions(folder_.path(), fs::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"writable"})) << outcome.err;
}

// A disk that fills up in the middle: the old file stays, nothing half-written is left.
TEST_F(OutputFile, AFailedWriteLeavesTheOldFileAndNoTemporaryOne) {
  for (const char* name : {"sea.png", "sea.exr", "sea.tif"}) {
    SCOPED_TRACE(name);
    const std::string path = folder_.file(name);
    write_text(path, "old");
    const Outcome outcome = render({"--out", path}, {.max_file_bytes = 1024});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(outcome.err, {path})) << outcome.err;
    EXPECT_EQ(read_text(path), "old");
    EXPECT_EQ(folder_.names(), std::vector<std::string>{name});
    fs::remove(path);
  }
}

TEST_F(OutputFile, ASequenceThatFailsKeepsTheFramesBefore) {
  fs::create_directory(folder_.file("f_2.png"));
  const Outcome outcome = render({"--frames", "0-3", "--out", folder_.file("f_%d.png")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"f_2.png"})) << outcome.err;
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"f_0.png", "f_1.png"}));
  EXPECT_FALSE(read_picture(folder_.file("f_1.png")).bytes.empty());
}

TEST_F(OutputFile, AFullStandardOutputIsAnError) {
  const Outcome outcome = render({"--hash"}, {.standard_output = "/dev/full"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"standard output"})) << outcome.err;
}

}  // namespace
}  // namespace swell::apps
