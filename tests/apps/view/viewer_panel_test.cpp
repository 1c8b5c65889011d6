// The whole viewer: what its panel changes, what the pointer picks, what screenshots keep.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "apps/shared/picture_file.h"
#include "apps/view/viewer.h"
#include "scratch_folder.h"
#include "terrain/height_grid.h"
#include "texture/image/image_io.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

TEST_F(ViewerTest, NewWavesAppearWhileFramesGoOn) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  SceneChoice choice = scene_choice(small_scene());
  for (int i = 0; i < 10; ++i) {  // a slider being dragged
    choice.waves.wind_speed_mps = 5.0 + i;
    viewer.choose_scene(choice);
    viewer.turn();
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (viewer.is_rebuilding() && std::chrono::steady_clock::now() < end) viewer.turn();
  viewer.turn();
  EXPECT_EQ(viewer.world().scene().sea.wind_speed_mps, 14.0);
  expect_headless_picture(viewer, with_choice(small_scene(), choice));
}

// The trains of a coast take a hundred frames' time to work out.
TEST_F(ViewerTest, NoFrameWaitsForNewWaves) {
  scene::Scene coast = small_scene();
  coast.terrain.emplace();
  coast.terrain->coast_m = {{-500.0, 200.0}, {500.0, 200.0}};
  coast.coast.model = scene::CoastModel::kBlend;
  Viewer viewer(coast, settings_of(1000000));
  for (int i = 0; i < 3; ++i) viewer.turn();

  using Clock = std::chrono::steady_clock;
  SceneChoice choice = scene_choice(coast);
  choice.waves.wind_speed_mps = 11.0;
  const Clock::time_point asked = Clock::now();
  viewer.choose_scene(choice);
  Clock::duration longest{0};
  int frames = 0;
  for (; viewer.world().scene().sea.wind_speed_mps != 11.0; ++frames) {
    const Clock::time_point begin = Clock::now();
    ASSERT_TRUE(viewer.turn());
    longest = std::max(longest, Clock::now() - begin);
    ASSERT_LT(begin - asked, std::chrono::seconds(60));
  }
  EXPECT_LT(2 * longest, Clock::now() - asked);
  EXPECT_GE(frames, 4);
}

TEST_F(ViewerTest, AnotherTriangulationAppearsLikeNewWaves) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  scene::Scene other = small_scene();
  other.detail.triangulation = scene::Triangulation::kRadial;
  viewer.choose_scene(scene_choice(other));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (viewer.is_rebuilding() && std::chrono::steady_clock::now() < end) viewer.turn();
  viewer.turn();
  expect_headless_picture(viewer, other);
}

void turn_until_built(Viewer& viewer) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (viewer.is_rebuilding() && std::chrono::steady_clock::now() < end) viewer.turn();
  viewer.turn();
}

TEST_F(ViewerTest, ADigitChoosesTheSeaState) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_6);
  viewer.turn();
  EXPECT_EQ(viewer.report().message, "sea state 6: very rough");
  turn_until_built(viewer);
  EXPECT_EQ(viewer.world().scene().douglas, 6);
  SceneChoice choice = scene_choice(small_scene());
  choice.waves.sea_state = 6;
  expect_headless_picture(viewer, with_choice(small_scene(), choice));
}

TEST_F(ViewerTest, AnotherSunAndFogAppear) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  SceneChoice choice = scene_choice(small_scene());
  choice.air.sun_elevation_rad = 0.1;
  choice.air.fog = true;
  choice.air.visibility_m = 400.0;
  viewer.choose_scene(choice);
  turn_until_built(viewer);
  expect_headless_picture(viewer, with_choice(small_scene(), choice));
}

void push_pointer(int x, int y) {
  SDL_Event event{};
  event.motion.type = SDL_MOUSEMOTION;
  event.motion.x = x;
  event.motion.y = y;
  SDL_PushEvent(&event);
}

TEST_F(ViewerTest, ThePointerPicksTheWaterThatIsDrawnThere) {
  Viewer viewer(small_scene(), settings_of(1000000, {640, 400}));
  viewer.turn();
  push_pointer(600, 390);  // beside the panel
  viewer.turn();
  ASSERT_TRUE(viewer.report().pick);
  const render::Pick pick = *viewer.report().pick;
  EXPECT_EQ(pick.what, render::Shown::kWater);
  const View view = scene::camera_view(small_scene().camera, viewer.picture_time_s(), 640, 400);
  const glm::vec4 clip = view.clip_from_rel * glm::vec4(pick.p_world - view.eye_world, 1.0);
  EXPECT_NEAR((clip.x / clip.w + 1.0f) * 320.0f, 600.5f, 0.01f);
  EXPECT_NEAR((1.0f - clip.y / clip.w) * 200.0f, 390.5f, 0.01f);

  push_key(SDL_KEYDOWN, SDLK_F2);
  viewer.turn();
  EXPECT_FALSE(viewer.shows_panel());
  EXPECT_TRUE(viewer.report().pick) << "with or without the panel";

  push_pointer(600, 10);  // the sky
  viewer.turn();
  EXPECT_FALSE(viewer.report().pick);
  push_pointer(600, 390);
  push_window_event(viewer, SDL_WINDOWEVENT_LEAVE);
  viewer.turn();
  EXPECT_FALSE(viewer.report().pick);
}

void push_button_at(Uint32 type, int x, int y, Uint8 button = SDL_BUTTON_LEFT) {
  SDL_Event event{};
  event.button.type = type;
  event.button.button = button;
  event.button.x = x;
  event.button.y = y;
  SDL_PushEvent(&event);
}

TEST_F(ViewerTest, TheMiddleButtonDropsAStoneWhereThereIsWater) {
  Viewer viewer(small_scene(), settings_of(1000000, {640, 400}));
  viewer.turn();
  for (const int y : {10, 390}) {  // the sky, the sea
    push_pointer(600, y);
    viewer.turn();
    push_button_at(SDL_MOUSEBUTTONDOWN, 600, y, SDL_BUTTON_MIDDLE);
    viewer.turn();
  }
  EXPECT_EQ(viewer.stones(), 1u);
  viewer.turn();
  const render::Target without =
      headless_picture(small_scene(), viewer.picture_time_s(), 640, 400, {});
  EXPECT_NE(viewer.picture().rgba, without.rgba);
}

// As remote desktops and tests do it: with no motion of a device before, so that SDL_GetMouseState
// and Dear ImGui's last frame have the pointer elsewhere. The press once looked around instead.
TEST_F(ViewerTest, APointerThatMovesAndPressesAtOnceWorksThePanel) {
  Viewer viewer(small_scene(), settings_of(1000000, {640, 400}));
  for (int i = 0; i < 2; ++i) viewer.turn();  // a panel has its size from the second on
  const int x = 26, y = 64;                   // "pause"
  push_pointer(x, y);
  push_button_at(SDL_MOUSEBUTTONDOWN, x, y);
  push_button_at(SDL_MOUSEBUTTONUP, x, y);
  viewer.turn();
  viewer.turn();
  EXPECT_TRUE(viewer.panel().paused);
  push_motion(50, 10);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera()) << "the press was not for looking around";
  push_pointer(600, 390);
  viewer.turn();
  EXPECT_TRUE(viewer.report().pick);
}

TEST_F(ViewerTest, APressBesideThePanelLooksAround) {
  Viewer viewer(small_scene(), settings_of(1000000, {640, 400}));
  viewer.turn();
  push_pointer(26, 64);
  viewer.turn();
  push_pointer(600, 390);
  push_button_at(SDL_MOUSEBUTTONDOWN, 600, 390);
  viewer.turn();
  push_motion(50, 10);
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
}

TEST_F(ViewerTest, ThePointerPicksWhatFloatsThere) {
  scene::Scene scene = small_scene();
  scene.sea.wind_speed_mps = 0.0;  // the box stands upright, its front at 28 m
  scene.objects.resize(2);
  scene.objects[0].position_m = {0.0, -50.0};  // behind the eye
  scene.objects[1].kind = scene::ObjectKind::kBox;
  scene.objects[1].position_m = {6.0, 30.0};
  scene.objects[1].size_m = glm::dvec3(4.0);
  Viewer viewer(scene, settings_of(1000000, {640, 400}));
  viewer.turn();
  push_pointer(420, 250);
  viewer.turn();
  ASSERT_TRUE(viewer.report().pick);
  const render::Pick pick = *viewer.report().pick;
  EXPECT_EQ(pick.what, render::Shown::kObject);
  EXPECT_EQ(pick.object, 1);
  EXPECT_EQ(pick.object_kind, scene::ObjectKind::kBox);
  EXPECT_NEAR(pick.p_world.y, 28.0, 1.0);
}

TEST_F(ViewerTest, FarWavesAreLeftOutAndDrawnAgainFromFrameToFrame) {
  scene::Scene scene = small_scene();
  scene.detail.background_error_px = 2.0;
  Viewer viewer(scene, settings_of(100));
  viewer.turn();
  render::FrameOptions quality = viewer.panel().frame;
  EXPECT_EQ(quality.background_error_px, 2.0);
  std::set<std::uint64_t> pictures;
  push_key(SDL_KEYDOWN, SDLK_p);
  for (const double error_px : {0.0, 2.0, 8.0}) {
    quality.background_error_px = error_px;
    viewer.choose_quality(quality);
    viewer.turn();
    scene.detail.background_error_px = error_px;
    expect_headless_picture(viewer, scene);
    pictures.insert(render::picture_hash(viewer.picture()));
  }
  EXPECT_EQ(pictures.size(), 3);
}

TEST_F(ViewerTest, TheGovernorIsOnUnlessFramesAreCounted) {
  EXPECT_TRUE(Viewer(small_scene(), settings_of(0)).panel().governed);
  EXPECT_FALSE(Viewer(small_scene(), settings_of(5)).panel().governed);
}

TEST_F(ViewerTest, FramesDrawLessToKeepASmallBudgetAndAllWithoutOne) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  const int all = viewer.report().statistics.water_triangles;
  viewer.choose_budget(true, 0.01);
  for (int i = 0; i < 60; ++i) viewer.turn();
  EXPECT_LT(viewer.report().statistics.water_triangles, all / 2);
  EXPECT_LT(viewer.report().picture_scale, 1.0);
  viewer.choose_budget(false, 0.01);
  viewer.turn();
  EXPECT_EQ(viewer.report().picture_scale, 1.0);
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, TheFrameTimeAndItsGraphCountPresentingToo) {
  Viewer viewer(small_scene(), settings_of(1000000));
  for (int i = 0; i < 3; ++i) viewer.turn();
  const PanelReport& report = viewer.report();
  EXPECT_GE(report.frame_ms, report.statistics.frame_ms + report.present_ms);
  const std::size_t last =
      (report.history.next + FrameHistory::kLength - 1) % FrameHistory::kLength;
  EXPECT_EQ(report.history.frame_ms[last], static_cast<float>(report.frame_ms));
}

TEST(QualityLine, SaysWhyThePictureIsSmaller) {
  EXPECT_EQ(quality_line({.whole_ms = 16.0}, 1.0, 17.0), "whole: it fits");
  EXPECT_EQ(quality_line({.step = 8, .whole_ms = 23.1}, 0.85, 17.0), "6 ms over: 85 % of the size");
  EXPECT_EQ(quality_line({.detail = 0.4, .step = 8, .whole_ms = 40.0}, 0.7, 17.0),
            "23 ms over: 70 % of the size, 40 % of the triangles");
  EXPECT_EQ(quality_line({.detail = 0.8, .whole_ms = 17.2}, 1.0, 17.0),
            "near the budget: 80 % of the triangles");
  EXPECT_EQ(quality_line({.step = 2, .whole_ms = 18.4}, 1.0, 17.0),
            "1 ms over: smaller lookup images");
}

namespace fs = std::filesystem;

// A working folder of this process alone, for as long as it lives.
class ScreenshotFolder {
 public:
  ScreenshotFolder() : old_(fs::current_path()) { fs::current_path(own_.path()); }
  ~ScreenshotFolder() { fs::current_path(old_); }
  ScreenshotFolder(const ScreenshotFolder&) = delete;
  ScreenshotFolder& operator=(const ScreenshotFolder&) = delete;

 private:
  const ScratchFolder own_;
  fs::path old_;
};

TEST_F(ViewerTest, ScreenshotsGetTheNextFreeName) {
  const ScreenshotFolder folder;
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F12);  // there is no picture yet
  viewer.turn();
  for (int i = 0; i < 2; ++i) {
    push_key(SDL_KEYDOWN, SDLK_F12);
    viewer.turn();
  }
  EXPECT_TRUE(fs::exists("swell_0001.png"));
  EXPECT_TRUE(fs::exists("swell_0002.png"));
  EXPECT_FALSE(fs::exists("swell_0003.png"));
}

TEST_F(ViewerTest, ASavedSceneDrawsThePictureThatIsShown) {
  const ScreenshotFolder folder;
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_3);
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);  // flies: the scene's camera moves on its own
  viewer.turn();
  push_key(SDL_KEYUP, SDLK_w, SDL_SCANCODE_W);
  viewer.turn();
  turn_until_built(viewer);
  push_key(SDL_KEYDOWN, SDLK_F5);
  viewer.turn();
  EXPECT_EQ(viewer.report().message, "wrote swell_0001.toml");
  const scene::Scene saved = scene::load_scene("swell_0001.toml");
  EXPECT_EQ(saved.douglas, 3);
  EXPECT_EQ(saved.camera.velocity_mps, glm::dvec3(0.0));
  expect_headless_picture(viewer, saved);
}

// Counts white pixels at the window's top right of the panel, where messages stand in the middle.
int white_pixels_at_the_top(Viewer& viewer) {
  const SDL_Rect top = {340, 0, 300, 60};
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(top.w * top.h));
  EXPECT_EQ(SDL_RenderReadPixels(viewer.window().renderer(), &top, SDL_PIXELFORMAT_ABGR8888,
                                 pixels.data(), 4 * top.w),
            0);
  return static_cast<int>(std::ranges::count(pixels, 0xffffffffu));
}

TEST_F(ViewerTest, AMessageIsSeenWithAndWithoutThePanel) {
  const ScreenshotFolder folder;
  for (const bool panel : {true, false}) {
    Viewer viewer(small_scene(), settings_of(100, {640, 400}));
    if (!panel) push_key(SDL_KEYDOWN, SDLK_F2);
    viewer.turn();
    viewer.turn();
    const int before = white_pixels_at_the_top(viewer);
    push_key(SDL_KEYDOWN, SDLK_F12);
    viewer.turn();
    viewer.turn();
    EXPECT_EQ(viewer.report().message, panel ? "wrote swell_0001.png" : "wrote swell_0002.png");
    EXPECT_GT(white_pixels_at_the_top(viewer), before + 100) << panel;
  }
}

TEST_F(ViewerTest, AScreenshotIsThePictureAtFullQualityAndTheGovernorGoesOnAsBefore) {
  const ScreenshotFolder folder;
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.choose_budget(true, 0.01);
  for (int i = 0; i < 60; ++i) viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  viewer.turn();
  ASSERT_LT(viewer.report().picture_scale, 1.0);
  const std::uint64_t shown = render::picture_hash(viewer.picture());
  const int step_changes = viewer.report().governor.step_changes;

  push_key(SDL_KEYDOWN, SDLK_F12);
  viewer.turn();
  apps::write_picture(headless_picture(small_scene(), viewer.picture_time_s(), 160, 100),
                      "expected.png");
  EXPECT_EQ(texture::read_image("swell_0001.png").pixels,
            texture::read_image("expected.png").pixels);
  EXPECT_EQ(render::picture_hash(viewer.picture()), shown);
  EXPECT_EQ(viewer.report().governor.step_changes, step_changes);
  EXPECT_EQ(viewer.report().statistics.splits + viewer.report().statistics.merges, 0)
      << "frames go on from the mesh of the last one";
}

}  // namespace
}  // namespace swell::view
