// The whole viewer: a camera comes back from what is copied.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "apps/view/viewer.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

TEST_F(ViewerTest, TheCopiedCameraShowsTheSamePicture) {
  Viewer viewer(small_scene(), settings_of(100));
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_F2);
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT);
  viewer.turn();
  push_motion(57, 13);
  for (int k = 0; k < 5; ++k) viewer.turn();
  ASSERT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYUP, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_c);
  viewer.turn();
  EXPECT_EQ(viewer.report().message, "copied the camera as TOML");

  const std::unique_ptr<char, void (*)(void*)> copied(SDL_GetClipboardText(), SDL_free);
  scene::Scene scene = small_scene();
  scene.camera = scene::parse_scene(copied.get(), "copied.toml").camera;
  EXPECT_EQ(scene.camera.eye_m, viewer.report().camera.eye_m);
  expect_headless_picture(viewer, scene);
}

}  // namespace
}  // namespace swell::view
