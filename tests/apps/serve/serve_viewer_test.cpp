// A viewer that is looked at from elsewhere.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

#include "apps/serve/browser_events.h"
#include "apps/shared/program_runner.h"
#include "apps/view/viewer.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

class WatchedViewer : public ViewerTest {
 protected:
  ViewerSettings settings(int frames) {
    ViewerSettings settings = settings_of(frames);
    settings.audience =
        Audience{[this] { return watched_; },
                 [this](Viewer& viewer) { ++shown_, viewer.window().read_pixels(rgba_); }};
    return settings;
  }

  bool shows_picture_alone(const Viewer& viewer) const {
    const auto& picture = viewer.picture().rgba;
    return rgba_.size() == std::span(picture).size_bytes() &&
           std::memcmp(rgba_.data(), picture.data(), rgba_.size()) == 0;
  }

  bool watched_ = true;
  int shown_ = 0;
  std::vector<std::uint8_t> rgba_;
};

TEST_F(WatchedViewer, ShowsWhatAWindowWould) {
  Viewer viewer(small_scene(), settings(10));
  push_key(SDL_KEYDOWN, SDLK_F2);  // without the panel
  viewer.turn();
  viewer.turn();
  EXPECT_EQ(shown_, 2);
  EXPECT_TRUE(shows_picture_alone(viewer));
  push_key(SDL_KEYDOWN, SDLK_F2);
  viewer.turn();
  viewer.turn();
  EXPECT_FALSE(shows_picture_alone(viewer));
}

TEST_F(WatchedViewer, DrawsNothingWhileNobodyLooks) {
  Viewer viewer(small_scene(), settings(0));
  watched_ = false;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(viewer.turn());
  EXPECT_EQ(viewer.frames_drawn(), 0);
  watched_ = true;
  viewer.turn();
  EXPECT_EQ(viewer.frames_drawn(), 1);
  EXPECT_EQ(shown_, 1);
}

TEST_F(WatchedViewer, LooksAroundWhileAButtonIsHeld) {
  Viewer viewer(small_scene(), settings(100));
  viewer.turn();
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT);
  push_motion(40, 0);
  push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_LEFT);
  push_motion(40, 0);
  viewer.turn();
  const double heading = viewer.report().camera.heading_rad;
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
  EXPECT_EQ(viewer.report().camera.heading_rad, heading);
  EXPECT_NE(viewer.camera_text().find("heading_deg"), std::string::npos);
}

TEST_F(WatchedViewer, StartsWithThePanelClosedIfAskedTo) {
  ViewerSettings closed = settings(10);
  closed.panel_is_open = false;
  Viewer viewer(small_scene(), closed);
  for (int i = 0; i < 3; ++i) viewer.turn();
  EXPECT_TRUE(shows_picture_alone(viewer));
}

TEST_F(WatchedViewer, SavesSoManyFilesInTheNamedFolderAndNoMore) {
  const ScratchFolder scratch;
  ViewerSettings bounded = settings(0);
  bounded.output_folder = scratch.path() / "files";
  bounded.most_files = 3;
  Viewer viewer(small_scene(), bounded);
  viewer.turn();
  EXPECT_FALSE(std::filesystem::exists(bounded.output_folder));
  for (int i = 0; i < 3; ++i)
    for (const SDL_Keycode key : {SDLK_F12, SDLK_F5}) {
      push_key(SDL_KEYDOWN, key);
      viewer.turn();
    }
  EXPECT_EQ(scratch.names(),
            (std::vector<std::string>{"swell_0001.png", "swell_0001.toml", "swell_0002.png"}));
  for (const std::string& name : scratch.names())
    EXPECT_TRUE(std::filesystem::exists(bounded.output_folder / name)) << name;
  EXPECT_NE(viewer.report().message.find("holds 3 files, allowed 3"), std::string::npos)
      << viewer.report().message;
}

// Keys that the page keeps or that its machine never gets are not on its help screen.
TEST(BrowserHelp, NamesNoKeyThatABrowserDoesNotGive) {
  std::string all;
  for (const KeyHelp& row : key_help(true)) all += std::string(row.keys) + ", ";
  for (const char* key : {"Ctrl", "Esc", "F5", "F11", "F12"})
    EXPECT_EQ(all.find(key), std::string::npos) << key;
  for (const char* code : {"KeyW", "KeyE", "Space", "KeyQ", "ShiftLeft", "KeyR", "Digit0", "KeyP",
                           "Period", "F1", "F2", "KeyH", "F3", "F4"})
    EXPECT_EQ(
        serve::parse_events(fmt::format(R"([{{"type":"key","code":"{}","down":true}}])", code))
            .size(),
        1u)
        << code;
}

}  // namespace
}  // namespace swell::view
