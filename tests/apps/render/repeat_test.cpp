// One process, one picture: twenty times over, on many threads, in any order of frames.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "apps/render/picture_runs.h"
#include "apps/shared/program_runner.h"
#include "render/frame.h"
#include "scene/scene.h"

namespace swell::apps {
namespace {

class Repeated : public testing::Test {
 protected:
  Repeated() {
    const ScratchFolder folder;
    write_text(folder.file("scene.toml"), island_scene_text());
    world_.emplace_back(scene::load_scene(folder.file("scene.toml")));
  }

  texture::Image8 draw(double t_s, render::Workspace& workspace, Workers& workers) {
    const View view = scene::camera_view(world_[0].scene().camera, t_s, 160, 90);
    render::render_frame(world_[0], view, t_s, {}, workspace, target_, workers);
    texture::Image8 picture{target_.width_px, target_.height_px, 3, {}};
    for (const std::uint32_t p : target_.rgba)
      for (int c = 0; c < 3; ++c) picture.pixels.push_back(static_cast<std::uint8_t>(p >> (8 * c)));
    return picture;
  }

  // On one thread, without history.
  texture::Image8 reference(double t_s) {
    Workers workers(1);
    render::Workspace workspace;
    return draw(t_s, workspace, workers);
  }

  void expect_same(const texture::Image8& actual, const texture::Image8& expected,
                   const std::string& name) {
    EXPECT_EQ(picture_difference(actual, expected, difference_folder(), picture_name(name)), "");
  }

 private:
  std::vector<render::World> world_;
  render::Target target_;
};

TEST_F(Repeated, WithOneWorkspaceOnManyThreads) {
  const texture::Image8 expected = reference(3.5);
  Workers workers(16);
  render::Workspace workspace;
  for (int repeat = 0; repeat < 20; ++repeat)
    expect_same(draw(3.5, workspace, workers), expected, fmt::format("{}", repeat));
}

TEST_F(Repeated, WithFreshWorkspacesAndThreads) {
  const texture::Image8 expected = reference(3.5);
  for (int repeat = 0; repeat < 20; ++repeat) {
    Workers workers(16);
    render::Workspace workspace;
    expect_same(draw(3.5, workspace, workers), expected, fmt::format("{}", repeat));
  }
}

TEST_F(Repeated, InAnyOrderOfFrames) {
  constexpr int kFrames = 11;
  std::vector<texture::Image8> expected;
  for (int frame = 0; frame < kFrames; ++frame) expected.push_back(reference(frame * 0.8));
  EXPECT_NE(expected[0].pixels, expected[1].pixels);
  Workers workers(3);
  render::Workspace workspace;
  for (const int step : {1, 3, 7, 10}) {  // 10: backwards
    for (int n = 0; n < kFrames; ++n) {
      const int frame = (n * step + 5) % kFrames;
      expect_same(draw(frame * 0.8, workspace, workers), expected[frame],
                  fmt::format("step_{}_frame_{}", step, frame));
    }
  }
}

}  // namespace
}  // namespace swell::apps
