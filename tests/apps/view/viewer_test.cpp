// The whole viewer, driven by SDL events: frames, window, keys and mouse.
#include "apps/view/viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <random>

#include "trials.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

TEST_F(ViewerTest, DrawsTheCountedFramesAtExactTimesAndEnds) {
  Viewer viewer(small_scene(), settings_of(7));
  viewer.run();
  EXPECT_EQ(viewer.frames_drawn(), 7);
  EXPECT_EQ(viewer.picture_time_s(), 6 / 60.0);
  EXPECT_EQ(viewer.picture().width_px, 160);
  EXPECT_EQ(viewer.picture().height_px, 100);
}

TEST_F(ViewerTest, ThePictureIsTheHeadlessPicture) {
  Viewer viewer(small_scene(), settings_of(5));
  viewer.run();
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, AfterAnyResizesThePictureFitsTheWindowAndIsTheHeadlessPicture) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> side(1, 300);
  Viewer viewer(small_scene(), settings_of(1000000));
  for (int i = 0; i < 250; ++i) {
    int width = side(random), height = side(random);
    if (i % 25 == 0) width = height = 1;
    if (i % 60 == 0) width = 1600;  // wider than the screen
    if (i % 10 == 0) SDL_SetWindowSize(viewer.window().handle(), 0, height);  // refused by SDL
    SDL_SetWindowSize(viewer.window().handle(), width, height);
    if (i % 7 == 0) push_window_event(viewer, SDL_WINDOWEVENT_SIZE_CHANGED, 0, 0);
    if (i % 9 == 0) push_window_event(viewer, SDL_WINDOWEVENT_EXPOSED);
    if (i % 3 != 0) continue;  // several resizes between two frames
    ASSERT_TRUE(viewer.turn());
  }
  SDL_SetWindowSize(viewer.window().handle(), 123, 77);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  do {
    ASSERT_TRUE(viewer.turn());
  } while (viewer.picture().width_px != 123 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(viewer.picture().width_px, 123);
  EXPECT_EQ(viewer.picture().height_px, 77);
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, ClosingTheWindowEndsTheRun) {
  for (const bool by_quit : {false, true}) {
    Viewer viewer(small_scene(), settings_of(0));
    ASSERT_TRUE(viewer.turn());
    if (by_quit) {
      SDL_Event event{};
      event.type = SDL_QUIT;
      SDL_PushEvent(&event);
    } else {
      push_window_event(viewer, SDL_WINDOWEVENT_CLOSE);
    }
    EXPECT_FALSE(viewer.turn());
    EXPECT_EQ(viewer.frames_drawn(), 1);
  }
}

TEST_F(ViewerTest, KeysSwitchWireframePanelAndHelp) {
  Viewer viewer(small_scene(), settings_of(100));
  for (const bool on : {true, false}) {
    push_key(SDL_KEYDOWN, SDLK_F3);
    push_key(SDL_KEYDOWN, SDLK_F1);
    push_key(SDL_KEYDOWN, SDLK_F2);
    ASSERT_TRUE(viewer.turn());
    EXPECT_EQ(viewer.panel().frame.wireframe, on);
    EXPECT_EQ(viewer.shows_help(), on);
    EXPECT_EQ(viewer.shows_panel(), !on);
    expect_headless_picture(viewer, small_scene(), viewer.panel().frame);
  }
}

TEST_F(ViewerTest, ARepeatedKeySwitchesOnce) {
  Viewer viewer(small_scene(), settings_of(100));
  SDL_Event event{};
  event.key.type = SDL_KEYDOWN;
  event.key.keysym.sym = SDLK_F3;
  for (const Uint8 repeat : std::array<Uint8, 3>{0, 1, 1}) {
    event.key.repeat = repeat;
    SDL_PushEvent(&event);
  }
  ASSERT_TRUE(viewer.turn());
  EXPECT_TRUE(viewer.panel().frame.wireframe);
}

TEST_F(ViewerTest, PauseStopsTheSeaAndFullStopStepsIt) {
  Viewer viewer(small_scene(), settings_of(100));
  for (int i = 0; i < 3; ++i) viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_p);
  for (int i = 0; i < 3; ++i) viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 2 / 60.0);
  push_key(SDL_KEYDOWN, SDLK_PERIOD);
  for (int i = 0; i < 3; ++i) viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 3 / 60.0);
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 4 / 60.0);
}

TEST_F(ViewerTest, TheCameraFollowsTheSceneUntilItIsMovedAndAgainAfterReset) {
  Viewer viewer(small_scene(), settings_of(100));
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYUP, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_r);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, KeysAreLetGoWhenTheWindowLosesTheFocus) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  push_window_event(viewer, SDL_WINDOWEVENT_FOCUS_LOST);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
}

TEST_F(ViewerTest, TheMouseLooksOnlyWhileItIsCaptured) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F2);  // no panel under the pointer
  viewer.turn();
  viewer.turn();
  push_motion(50, 10);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT);
  viewer.turn();  // SDL drops older motion when the mouse is captured
  EXPECT_FALSE(viewer.has_own_camera());
  push_motion(50, 10);
  push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_RIGHT);
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYDOWN, SDLK_r);
  push_motion(50, 10);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
}

TEST_F(ViewerTest, EscapeReleasesTheMouseFirstAndThenQuits) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F2);
  viewer.turn();
  viewer.turn();
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT);
  push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_LEFT);
  push_key(SDL_KEYDOWN, SDLK_ESCAPE);
  EXPECT_TRUE(viewer.turn());
  push_key(SDL_KEYDOWN, SDLK_ESCAPE);
  EXPECT_FALSE(viewer.turn());
}

TEST_F(ViewerTest, AHiddenWindowIsNotDrawnAndHardlyUsesTheProcessor) {
  Viewer viewer(small_scene(), settings_of(0));
  viewer.turn();
  SDL_HideWindow(viewer.window().handle());
  while (viewer.window().is_visible()) viewer.turn();
  for (int i = 0; i < 5; ++i) viewer.turn();  // events of the change itself
  const int drawn = viewer.frames_drawn();
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu_begin = std::clock();
  std::chrono::duration<double> passed{0.0};
  while (passed.count() < 1.0) {
    viewer.turn();
    passed = std::chrono::steady_clock::now() - begin;
  }
  const double cpu_s = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(viewer.frames_drawn(), drawn);
  EXPECT_LT(cpu_s, 0.05 * passed.count());

  SDL_ShowWindow(viewer.window().handle());
  const auto shown = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (viewer.frames_drawn() == drawn && std::chrono::steady_clock::now() < shown) viewer.turn();
  EXPECT_GT(viewer.frames_drawn(), drawn);
}

TEST_F(ViewerTest, LostDevicesAreMadeAnew) {
  Viewer viewer(small_scene(), settings_of(100));
  for (const Uint32 type : {SDL_RENDER_TARGETS_RESET, SDL_RENDER_DEVICE_RESET}) {
    viewer.turn();
    SDL_Event event{};
    event.type = type;
    SDL_PushEvent(&event);
    EXPECT_TRUE(viewer.turn());
  }
  EXPECT_TRUE(viewer.window().draw_picture(viewer.picture()));
}

TEST_F(ViewerTest, AStormOfEventsInAnyOrderIsSurvived) {
  std::mt19937 random(9);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  Viewer viewer(small_scene(), settings_of(1000000));
  for (int i = 0; i < std::max(trials(4000), 1000); ++i) {
    const auto place = static_cast<SDL_Scancode>(below(SDL_NUM_SCANCODES));
    switch (below(6)) {
      case 0:
        push_key(SDL_KEYDOWN, below(128) == 0 ? SDLK_F11 : SDLK_F3, place);
        break;
      case 1:
        push_key(SDL_KEYUP, SDLK_w, place);
        break;
      case 2:
        push_motion(below(2000) - 1000, below(2000) - 1000);
        break;
      case 3:
        push_button(SDL_MOUSEBUTTONDOWN, static_cast<Uint8>(below(8)));
        break;
      case 4:
        push_button(SDL_MOUSEBUTTONUP, static_cast<Uint8>(below(8)));
        break;
      default:
        if (const int what = below(20); what != SDL_WINDOWEVENT_CLOSE)
          push_window_event(viewer, what, below(5000) - 100, below(5000) - 100);
    }
    if (i % 40 != 0) continue;
    ASSERT_TRUE(viewer.turn());
  }
  push_window_event(viewer, SDL_WINDOWEVENT_CLOSE);
  EXPECT_FALSE(viewer.turn());
}

}  // namespace
}  // namespace swell::view
