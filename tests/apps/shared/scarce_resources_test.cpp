// Programs that get too little memory, no threads or only a part of their installation: one error
// line, exit code 1, and nothing loaded that is not needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "apps/shared/program_runner.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;
constexpr long kMegabyte = 1 << 20;

class ScarceResources : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_limit_resources()) GTEST_SKIP() << "the sanitizers need them";
    write_text(scene_, sea_scene_text());
  }

  Outcome render(const Arguments& more, const Surroundings& surroundings) {
    Arguments arguments = {"--scene", scene_, "--size", "64x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_render(arguments, surroundings);
  }

  static void expect_failure(const Outcome& outcome, const std::string& piece = "") {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(is_one_error_line(outcome.err, {piece})) << outcome.err;
  }
  static void expect_done_or_failure(const Outcome& outcome) {
    if (outcome.exit_code == 0)
      EXPECT_EQ(outcome.err, "");
    else
      expect_failure(outcome);
  }

  ScratchFolder folder_;
  std::string scene_ = folder_.file("sea.toml");
};

TEST_F(ScarceResources, WhatReadsNoImageLoadsFewLibrariesAndStartsAtOnce) {
  const Outcome libraries =
      run_render({"--version"}, {.environment = {"LD_TRACE_LOADED_OBJECTS=1"}});
  EXPECT_LE(std::ranges::count(libraries.out, '\n'), 20) << libraries.out;
  double cpu_ms = 1e9;
  for (int run = 0; run < 5; ++run) cpu_ms = std::min(cpu_ms, run_render({"--version"}).cpu_ms);
  EXPECT_LT(cpu_ms, 30.0);
}

TEST_F(ScarceResources, WhatReadsNoImageNeedsLittleMemory) {
  const Surroundings little = {.max_memory_bytes = 390 * kMegabyte};
  EXPECT_EQ(run_render({"--version"}, little).exit_code, 0);
  EXPECT_EQ(run_render({"--help"}, little).exit_code, 0);
  EXPECT_EQ(run_bench({"frame", "--help"}, little).exit_code, 0);
  EXPECT_EQ(render({"--hash", "--threads", "2"}, little).exit_code, 0);
  EXPECT_EQ(render({"--out", folder_.file("a.png")}, little).exit_code, 0);
  EXPECT_EQ(
      run_bench({"frame", "--scene", scene_, "--size", "64x36", "--frames", "1"}, little).exit_code,
      0);
}

TEST_F(ScarceResources, TooLittleMemoryIsOneErrorLine) {
  expect_failure(render({"--out", folder_.file("a.exr")}, {.max_memory_bytes = 390 * kMegabyte}),
                 "out of memory");
  expect_failure(run_render({"--scene", scene_, "--size", "8192x8192", "--hash"},
                            {.max_memory_bytes = 200 * kMegabyte}));
  expect_failure(render({"--hash", "--threads", "256"}, {.max_memory_bytes = 976 * kMegabyte}),
                 "threads");
  for (const long megabytes : {25, 40, 60, 90})
    expect_done_or_failure(
        render({"--hash", "--threads", "3"}, {.max_memory_bytes = megabytes * kMegabyte}));
  for (const long megabytes : {500, 640, 680, 700, 720})
    expect_done_or_failure(
        render({"--out", folder_.file("a.exr")}, {.max_memory_bytes = megabytes * kMegabyte}));
}

TEST_F(ScarceResources, NoThreadsIsOneErrorLine) {
  fs::permissions(folder_.path(), fs::perms(0777));
  for (const Surroundings& surroundings :
       {Surroundings{.threads = false}, Surroundings{.own_user = true}}) {
    const Outcome alone = render({"--hash", "--threads", "1"}, surroundings);
    if (surroundings.own_user && (alone.exit_code == 126 || alone.exit_code == 127))
      GTEST_SKIP() << "another user cannot run the program";
    EXPECT_EQ(alone.exit_code, 0) << alone.err;
    EXPECT_EQ(run_render({"--version"}, surroundings).exit_code, 0);
    expect_failure(render({"--hash", "--threads", "2"}, surroundings), "threads");
    expect_failure(render({"--threads", "1", "--out", folder_.file("a.exr")}, surroundings),
                   "threads");
    expect_failure(
        run_bench({"frame", "--scene", scene_, "--size", "64x36", "--threads", "4"}, surroundings),
        "threads");
    expect_failure(run_bench({"query", "--scene", scene_, "--threads", "2"}, surroundings),
                   "threads");
  }
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"sea.toml"});
}

TEST_F(ScarceResources, AProgramWithoutTheModuleForImagesSaysSo) {
  const std::string alone = folder_.file("swell-render");
  fs::copy_file(render_program(), alone);
  const Arguments png = {"--scene", scene_, "--size", "64x36", "--out", folder_.file("a.png")};
  EXPECT_EQ(run_program(alone, png).exit_code, 0);
  const Arguments picture = {"--scene", scene_, "--size", "64x36", "--out", folder_.file("a.exr")};
  const Outcome outcome = run_program(alone, picture);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_error_line(outcome.err, {"libswell_image_codec.so"})) << outcome.err;
  // Beside the program it is found; one that is no library is a failure.
  const std::string module = folder_.file("libswell_image_codec.so");
  fs::copy_file(fs::path(render_program()).parent_path() / "../lib/swell/libswell_image_codec.so",
                module);
  EXPECT_EQ(run_program(alone, picture).exit_code, 0);
  write_text(module, "no library");
  expect_failure(run_program(alone, picture));
}

}  // namespace
}  // namespace swell::apps
