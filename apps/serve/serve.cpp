#include "apps/serve/serve.h"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>

namespace swell::serve {
namespace {

// Wakes a viewer that waits for events.
void wake() {
  SDL_Event event{};
  event.type = SDL_USEREVENT;
  SDL_PushEvent(&event);
}

void push(const SDL_Event& event) {
  SDL_Event copy = event;
  SDL_PushEvent(&copy);
}

}  // namespace

void serve(const scene::Scene& scene, view::ViewerSettings settings, const Address& address) {
  setenv("SDL_VIDEODRIVER", "dummy", 1);
  PictureServer server(address, {push, wake});
  settings.audience = view::Audience{
      .is_watching = [&] { return server.stream().is_watched(); },
      .show =
          [&](view::Viewer& viewer) {
            const view::WindowSize size = viewer.window().size_px();
            server.stream().publish(
                size.width_px, size.height_px,
                [&](std::vector<std::uint8_t>& rgba) { viewer.window().read_pixels(rgba); });
            server.set_camera(viewer.camera_text());
            server.answer_scene([&] { return viewer.scene_text(); });
          }};
  view::Viewer viewer(scene, settings);
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  viewer.run();
}

}  // namespace swell::serve
