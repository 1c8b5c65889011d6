// One binary, one picture: threads, SIMD target, tile size, history and process do not matter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/program_runner.h"

namespace swell::apps {
namespace {

bool cpu_has_avx512() {
  std::ifstream info("/proc/cpuinfo");
  std::stringstream text;
  text << info.rdbuf();
  return text.str().find("avx512vl") != std::string::npos;
}

struct SceneCase {
  const char* name;
  std::string (*text)();
};

class SameBits : public testing::TestWithParam<SceneCase> {
 protected:
  SameBits() { write_text(scene_, GetParam().text()); }

  // The lines 'frame N xxh3 HASH' of a run.
  std::string hashes(const Arguments& more) {
    Arguments arguments = {"--scene", scene_, "--size", "160x90", "--hash"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_render(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("scene.toml");
};

TEST_P(SameBits, ForAnyNumberOfThreads) {
  const std::string expected = hashes({"--time", "7.25", "--threads", "1"});
  EXPECT_EQ(expected.size(), std::string("frame 0 xxh3 0123456789abcdef\n").size()) << expected;
  for (const char* threads : {"2", "3", "7"})
    EXPECT_EQ(hashes({"--time", "7.25", "--threads", threads}), expected) << threads << " threads";
}

TEST_P(SameBits, ForEverySimdTarget) {
  if (!cpu_has_avx512()) GTEST_SKIP() << "this CPU has AVX2 only";
  const Arguments frames = {"--frames", "0-4", "--fps", "0.01"};
  Arguments avx2 = frames, avx512 = frames;
  avx2.insert(avx2.end(), {"--simd", "avx2"});
  avx512.insert(avx512.end(), {"--simd", "avx512"});
  EXPECT_EQ(hashes(avx2), hashes(avx512));
}

TEST_P(SameBits, ForEveryTileSize) {
  const std::string expected = hashes({"--time", "7.25", "--tile", "64"});
  for (const char* tile : {"16", "32"})
    EXPECT_EQ(hashes({"--time", "7.25", "--tile", tile}), expected) << "tile " << tile;
}

TEST_P(SameBits, ForAFrameAloneAndInASequence) {
  const std::string sequence = hashes({"--frames", "0-50", "--fps", "30"});
  for (const char* frame : {"0", "1", "50"}) {
    const std::string alone = hashes({"--frames", fmt::format("{0}-{0}", frame), "--fps", "30"});
    EXPECT_NE(sequence.find(alone), std::string::npos) << "alone: " << alone << sequence;
  }
}

TEST_P(SameBits, ForAFrameAndItsTime) {
  const std::string frame = hashes({"--frames", "45-45", "--fps", "30"});
  const std::string time = hashes({"--time", "1.5"});
  EXPECT_EQ(frame.substr(frame.find("xxh3")), time.substr(time.find("xxh3")));
}

// The checks above are blind if nothing decides the picture.
TEST_P(SameBits, ButOtherTimesAndSeedsGiveOtherPictures) {
  const std::string picture = hashes({"--time", "7.25"});
  EXPECT_NE(hashes({"--time", "7.3"}), picture);
  std::string other_seed = GetParam().text();
  other_seed.insert(other_seed.find("[sea]\n") + 6, "seed = 99\n");
  write_text(scene_, other_seed);
  EXPECT_NE(hashes({"--time", "7.25"}), picture);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits,
                         testing::Values(SceneCase{"Sea", sea_scene_text},
                                         SceneCase{"Island", island_scene_text}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace swell::apps
