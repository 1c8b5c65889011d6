#include "apps/serve/serve.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

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

// As SIGTERM, which SDL makes an end in order of; unless it is ignored (nohup).
void end_with_hangup() {
  if (std::signal(SIGHUP, [](int) { std::raise(SIGTERM); }) == SIG_IGN)
    std::signal(SIGHUP, SIG_IGN);
}

}  // namespace

void serve(const scene::Scene& scene, view::ViewerSettings settings, const Address& address) {
  setenv("SDL_VIDEODRIVER", "dummy", 1);
  PictureServer server(address, {push, wake});
  settings.panel_is_open = false;  // which covers a phone's picture
  settings.most_files = kMostFiles;
  settings.audience = view::Audience{
      .is_watching = [&] { return server.stream().is_watched(); },
      .show =
          [&](view::Viewer& viewer) {
            const view::WindowSize size = viewer.window().size_px();
            server.stream().publish(
                size.width_px, size.height_px,
                [&](std::vector<std::uint8_t>& rgba) { viewer.window().read_pixels(rgba); });
            server.set_camera(viewer.camera_text());
            server.set_panel_open(viewer.shows_panel());
            server.answer_scene([&] { return viewer.scene_text(); });
          }};
  view::Viewer viewer(scene, settings);
  end_with_hangup();
  for (const std::string& url : server.urls()) fmt::print("{}\n", url);
  fmt::print("files saved from the panel: {}, at most {}\n",
             std::filesystem::absolute(settings.output_folder).string(), kMostFiles);
  std::fflush(stdout);
  viewer.run();
}

}  // namespace swell::serve
