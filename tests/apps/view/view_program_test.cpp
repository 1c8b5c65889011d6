// swell-view as a user starts it.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/shared/program_runner.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

struct ShellOutcome {
  int exit_code = -1;
  std::string output;  // stdout and stderr
};

ShellOutcome run(const std::string& command) {
  ShellOutcome outcome;
  std::FILE* pipe = ::popen(fmt::format("( {} ) 2>&1 </dev/null", command).c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

class ViewProgram : public testing::Test {
 protected:
  ViewProgram() {
    write_text(scene(), island_scene_text());
    setenv("LSAN_OPTIONS", "suppressions=" THIRD_PARTY_LEAKS ":print_suppressions=0", 1);
  }

  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string scene() const { return file("scene.toml"); }
  std::string dummy(const std::string& options) const {
    return fmt::format("SDL_VIDEODRIVER=dummy {} --scene {} {}", SWELL_VIEW, scene(), options);
  }

 private:
  ScratchFolder folder_;
};

void expect_one_error_line(const ShellOutcome& outcome, int exit_code, const std::string& piece) {
  EXPECT_EQ(outcome.exit_code, exit_code);
  EXPECT_TRUE(is_one_error_line(outcome.output, {piece})) << outcome.output;
}

void expect_same_pixels(const std::string& a, const std::string& b) {
  const texture::ImageF image_a = texture::read_image(a), image_b = texture::read_image(b);
  EXPECT_EQ(image_a.width, image_b.width);
  EXPECT_EQ(image_a.height, image_b.height);
  EXPECT_EQ(image_a.pixels, image_b.pixels);
}

TEST_F(ViewProgram, WithoutADisplayThereIsOneClearLine) {
  const std::string command = fmt::format("{} --scene {}", SWELL_VIEW, scene());
  expect_one_error_line(run("env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER " + command), 1,
                        "error: no display: ");
  expect_one_error_line(run("env -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER DISPLAY=:9731 " + command),
                        1, "error: no display: ");
}

TEST_F(ViewProgram, AMissingSceneIsReportedBeforeAnyWindowOpens) {
  const ShellOutcome outcome = run(fmt::format("SDL_VIDEODRIVER=x11 DISPLAY=:9731 {} --scene {}",
                                               SWELL_VIEW, file("nowhere.toml")));
  expect_one_error_line(outcome, 2, "nowhere.toml");
}

TEST_F(ViewProgram, BadOptionsAreReported) {
  expect_one_error_line(run(dummy("--size 0x0")), 2, "--size");
  expect_one_error_line(run(dummy("--frames x")), 2, "--frames");
  expect_one_error_line(run(dummy("--screenshot picture.gif")), 2, "picture.gif");
  expect_one_error_line(run(dummy("--colour red")), 2, "--colour");
}

TEST_F(ViewProgram, TheScreenshotIsThePictureOfSwellRender) {
  const ShellOutcome view =
      run(dummy(fmt::format("--size 321x201 --frames 7 --screenshot {}", file("a.png"))));
  ASSERT_EQ(view.exit_code, 0) << view.output;
  EXPECT_EQ(view.output, "");
  const ShellOutcome render = run(fmt::format("{} --scene {} --size 321x201 --time 0.1 --out {}",
                                              SWELL_RENDER, scene(), file("b.png")));
  ASSERT_EQ(render.exit_code, 0) << render.output;
  expect_same_pixels(file("a.png"), file("b.png"));
}

TEST_F(ViewProgram, WithoutASceneTheOpenSeaIsShown) {
  const ShellOutcome view = run(
      fmt::format("cd / && SDL_VIDEODRIVER=dummy {} --set wind.speed_mps=9 --size 64x36 --frames 1 "
                  "--screenshot {}",
                  SWELL_VIEW, file("a.png")));
  ASSERT_EQ(view.exit_code, 0) << view.output;
  EXPECT_EQ(view.output, "");
  const ShellOutcome render = run(fmt::format(
      "{} --scene {}/scenes/open_ocean.toml --set wind.speed_mps=9 --size 64x36 --out {}",
      SWELL_RENDER, SWELL_SOURCE_DIR, file("b.png")));
  ASSERT_EQ(render.exit_code, 0) << render.output;
  expect_same_pixels(file("a.png"), file("b.png"));
  expect_one_error_line(
      run(fmt::format("SDL_VIDEODRIVER=dummy {} --set wind.speed_mps=99", SWELL_VIEW)), 2,
      "setting wind.speed_mps=99: wind.speed_mps, got 99, allowed 0 to 60");
}

TEST_F(ViewProgram, OnAnXServerOfAnyDepthThePictureIsTheSame) {
  const ShellOutcome render = run(fmt::format("{} --scene {} --size 320x200 --time 0.05 --out {}",
                                              SWELL_RENDER, scene(), file("b.png")));
  ASSERT_EQ(render.exit_code, 0) << render.output;
  for (const char* screen : {"640x480x24", "640x480x16", "100x100x24"}) {
    const ShellOutcome view = run(fmt::format(
        "SWELL_TEST_SCREEN={} SDL_VIDEODRIVER=x11 {} {} --scene {} --size 320x200 --frames 4 "
        "--screenshot {}",
        screen, RUN_UNDER_XVFB, SWELL_VIEW, scene(), file("a.png")));
    if (view.exit_code == 77) GTEST_SKIP() << view.output;
    ASSERT_EQ(view.exit_code, 0) << screen << ": " << view.output;
    expect_same_pixels(file("a.png"), file("b.png"));
  }
}

TEST_F(ViewProgram, AnInterruptEndsItInOrder) {
  // 8 s: an instrumented build takes seconds to its first frame.
  const ShellOutcome outcome =
      run("timeout --preserve-status -k 30 -s INT 8 env " +
          dummy(fmt::format("--size 64x64 --screenshot {}", file("a.png"))));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(std::filesystem::exists(file("a.png")));
}

}  // namespace
}  // namespace swell::apps
