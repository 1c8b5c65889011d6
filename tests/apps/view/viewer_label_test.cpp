// The whole viewer: F4 shows the labels as pictures, one after the other.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/shared/label_picture.h"
#include "apps/view/viewer.h"
#include "render/world_view.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

// The label of the viewer's last frame, of the scene's camera, as a program without a window has
// it.
std::vector<std::uint32_t> headless_label(const Viewer& viewer, render::Label label) {
  const double t_s = viewer.picture_time_s();
  const int width_px = viewer.picture().width_px, height_px = viewer.picture().height_px;
  const render::World world = render::world_of(small_scene());
  Workers workers(1);
  ocean::SeaFrame sea;
  render::FrameOptions options;
  options.labels.add(label);
  options.next_view =
      render::world_view(world, t_s + options.next_frame_s, width_px, height_px, sea, workers);
  const View view = render::world_view(world, t_s, width_px, height_px, sea, workers);
  render::Workspace workspace;
  render::Target target;
  render::render_frame(world, view, t_s, options, workspace, target, workers);
  std::vector<std::uint32_t> rgba;
  apps::paint_label(label, target.labels, view, rgba);
  return rgba;
}

void press(Viewer& viewer, SDL_Keycode key) {
  push_key(SDL_KEYDOWN, key);
  viewer.turn();
}

TEST_F(ViewerTest, F4ShowsEachLabelAndThenColourAgain) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  EXPECT_EQ(viewer.shown().rgba, viewer.picture().rgba);
  for (const render::LabelInfo& info : render::label_table()) {
    SCOPED_TRACE(info.name);
    press(viewer, SDLK_F4);
    EXPECT_EQ(viewer.panel().label, info.label);
    EXPECT_EQ(viewer.shown().rgba, headless_label(viewer, info.label));
    EXPECT_EQ(viewer.shown().width_px, viewer.picture().width_px);
  }
  press(viewer, SDLK_F4);
  EXPECT_EQ(viewer.panel().label, std::nullopt);
  EXPECT_EQ(viewer.shown().rgba, viewer.picture().rgba);
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, TheTitleAndAMessageNameTheLabel) {
  Viewer viewer(small_scene(), settings_of(1000000));
  const auto title = [&] { return std::string(SDL_GetWindowTitle(viewer.window().handle())); };
  viewer.turn();
  EXPECT_EQ(title(), "swell - small");
  EXPECT_EQ(viewer.report().message, "");
  press(viewer, SDLK_F4);
  EXPECT_EQ(title(), "swell - small - depth");
  EXPECT_EQ(viewer.report().message.substr(0, 7), "depth: ");
  viewer.choose_label(std::nullopt);
  viewer.turn();
  EXPECT_EQ(title(), "swell - small");
}

// Labels are of whole pictures: the governor's smaller ones wait.
TEST_F(ViewerTest, LabelsAreShownAtFullSizeWhateverTheGovernorWants) {
  ViewerSettings settings = settings_of(1000000);
  Viewer viewer(small_scene(), settings);
  viewer.choose_budget(true, 0.001);
  for (int k = 0; k < 200 && viewer.report().picture_scale == 1.0; ++k) viewer.turn();
  ASSERT_LT(viewer.report().picture_scale, 1.0);
  press(viewer, SDLK_F4);
  EXPECT_EQ(viewer.report().picture_scale, 1.0);
  EXPECT_EQ(viewer.picture().labels.depth_m.size(), 160u * 100u);
  viewer.choose_label(std::nullopt);
  viewer.turn();
  EXPECT_LT(viewer.report().picture_scale, 1.0) << "it goes on where it was";
}

TEST_F(ViewerTest, AScreenshotIsOfTheLabelThatIsShown) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.choose_label(render::Label::kClass);
  viewer.turn();
  EXPECT_EQ(viewer.full_picture().rgba, viewer.shown().rgba);
}

}  // namespace
}  // namespace swell::view
