// A viewer under test: its video driver, the events that it gets, the pictures it should show.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "apps/view/viewer.h"
#include "render/shot.h"
#include "render/world_view.h"
#include "view_scene.h"

namespace swell::view {

// SWELL_TEST_VIDEO names SDL's video driver; without it the dummy driver is used, which needs no
// display.
class ViewerTest : public testing::Test {
 protected:
  ViewerTest() {
    const char* driver = std::getenv("SWELL_TEST_VIDEO");
    setenv("SDL_VIDEODRIVER", driver ? driver : "dummy", 1);
  }
};

inline ViewerSettings settings_of(int frames, WindowSize size = {160, 100}) {
  return {.size = size, .threads = 2, .frames = frames, .frame = {}};
}

inline void push_key(Uint32 type, SDL_Keycode key, SDL_Scancode place = SDL_SCANCODE_UNKNOWN) {
  SDL_Event event{};
  event.key.type = type;
  event.key.keysym.sym = key;
  event.key.keysym.scancode = place;
  SDL_PushEvent(&event);
}

inline void push_button(Uint32 type, Uint8 button) {
  SDL_Event event{};
  event.button.type = type;
  event.button.button = button;
  SDL_PushEvent(&event);
}

inline void push_motion(int x_px, int y_px) {
  SDL_Event event{};
  event.motion.type = SDL_MOUSEMOTION;
  event.motion.xrel = x_px;
  event.motion.yrel = y_px;
  SDL_PushEvent(&event);
}

inline void push_window_event(Viewer& viewer, int what, int data1 = 0, int data2 = 0) {
  SDL_Event event{};
  event.window.type = SDL_WINDOWEVENT;
  event.window.windowID = SDL_GetWindowID(viewer.window().handle());
  event.window.event = static_cast<Uint8>(what);
  event.window.data1 = data1;
  event.window.data2 = data2;
  SDL_PushEvent(&event);
}

// What a program without a window draws.
inline render::Target headless_picture(const scene::Scene& scene, double t_s, int width_px,
                                       int height_px, const render::FrameOptions& options = {}) {
  const render::World world = render::world_of(scene);
  Workers workers(1);
  render::Workspace workspace;
  render::Target target;
  ocean::SeaFrame sea;
  const View view = render::world_view(world, t_s, width_px, height_px, sea, workers);
  render::render_frame(world, view, t_s, options, workspace, target, workers);
  return target;
}

inline void expect_headless_picture(const Viewer& viewer, const scene::Scene& scene,
                                    const render::FrameOptions& options = {}) {
  const render::Target& picture = viewer.picture();
  EXPECT_EQ(picture.rgba, headless_picture(scene, viewer.picture_time_s(), picture.width_px,
                                           picture.height_px, options)
                              .rgba);
}

}  // namespace swell::view
