// A viewer that is looked at from elsewhere.
#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <vector>

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

}  // namespace
}  // namespace swell::view
