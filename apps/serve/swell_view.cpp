// swell-view: flies over a scene in a window, or in a browser.
#include <optional>
#include <string>
#include <vector>

#include "apps/serve/default_scene.h"
#include "apps/serve/serve.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "apps/view/viewer.h"
#include "render/world_view.h"
#include "scene/settings.h"

namespace swell::serve {
namespace {

constexpr int kMostFrames = 10'000'000;

struct Options {
  apps::FrameSetup setup;
  int frames = 0;
  std::string screenshot;
  std::optional<Address> address;  // to serve a browser at
  std::vector<std::string> proxies;
  bool is_open = false;
  std::string files = "swell-view-files";
};

Address address_of(const std::string& text) {
  try {
    return parse_address(text);
  } catch (const std::invalid_argument& error) {
    throw apps::OptionError(std::string("command line: --serve: ") + error.what());
  }
}

void add_serve_options(apps::CommandLine& line, Options& options) {
  line.add_value({"--serve", "[ADDRESS:]PORT", "",
                  "Show it in a browser, at the URL that is printed, for all who know that URL: on "
                  "this machine alone, or at ADDRESS. PORT 0: any",
                  [&](const std::string& text) { options.address = address_of(text); }});
  line.add_texts("--serve-host", "NAME", options.proxies,
                 "With --serve: a name by which browsers reach it, such as a proxy's");
  line.add_flag("--serve-open", options.is_open,
                "With --serve on 127.0.0.1, ::1 or localhost: need no token. All users of this "
                "machine are let in");
  line.add_text("--serve-files", "FOLDER", options.files,
                "With --serve: where files go that are saved from the panel");
  line.need("--serve-host", "--serve");
  line.need("--serve-open", "--serve");
  line.need("--serve-files", "--serve");
  line.exclude("--serve", "--frames");
  line.exclude("--serve", "--screenshot");
}

void complete_address(Options& options) {
  if (!options.address) return;
  options.address->proxies = options.proxies;
  for (const std::string& name : options.proxies)
    if (name.empty() || name.find_first_of(":/@ ") != std::string::npos)
      throw apps::OptionError("command line: --serve-host: got '" + name +
                              "', allowed a name or an IPv4 address, without scheme and port");
  if (options.files.empty())
    throw apps::OptionError("command line: --serve-files: got '', allowed a folder's name");
  if (!options.is_open) return;
  if (!is_loopback(options.address->host))
    throw apps::OptionError("command line: --serve-open: got ADDRESS '" + options.address->host +
                            "', allowed 127.0.0.1, [::1] or localhost");
  options.address->token.clear();
}

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  apps::CommandLine line("swell-view",
                         "Flies over a scene, the open sea if none is named, in a window or a "
                         "browser; F1 shows the keys.");
  apps::add_frame_setup(line, options.setup);
  apps::add_cache_option(line, options.setup.cache_folder);
  apps::add_quality_options(line, options.setup.frame);
  apps::add_integer(line, "--frames", options.frames, 0, kMostFrames,
                    "Quit after N frames, the k-th (from 0) at k/60 seconds; 0: when closed");
  line.add_text("--screenshot", "FILE", options.screenshot,
                "Write the last frame before quitting: .png .exr .tif .tiff");
  add_serve_options(line, options);
  if (!line.parse(argc, argv)) return std::nullopt;
  complete_address(options);
  return options;
}

// Draws a frame of few pixels and triangles, whose water and ground are those of the first one.
void warn_of_eye(const render::World& world) {
  Workers workers(1);
  render::Workspace workspace;
  render::Target target;
  render::FrameOptions frame;
  frame.water_triangles = frame.terrain_triangles = 2;
  ocean::SeaFrame sea;
  const View view = render::world_view(world, 0.0, 16, 9, sea, workers);
  render::render_frame(world, view, 0.0, frame, workspace, target, workers);
  apps::EyeWarning().look(0, world, view, workspace);
}

scene::Scene scene_of(const apps::SceneChoice& choice) {
  scene::Scene scene = choice.path.empty()
                           ? scene::parse_scene(kDefaultScene, kDefaultSceneFile, choice.settings)
                           : apps::load_scene(choice);
  apps::check_perspective(scene, "the viewer");
  return scene;
}

void run(const Options& options) {
  apps::select_simd(options.setup.simd);
  apps::check_linear_light(options.setup.frame, "--screenshot", options.screenshot);
  if (!options.screenshot.empty()) apps::check_picture_file(options.screenshot);

  view::ViewerSettings settings;
  settings.size = {options.setup.size.width_px, options.setup.size.height_px};
  settings.threads = options.setup.threads;
  settings.cache_folder = options.setup.cache_folder;
  settings.frames = options.frames;
  settings.frame = options.setup.frame;
  settings.frame.keep_linear = apps::stores_linear_light(options.screenshot);

  const scene::Scene scene = scene_of(options.setup.scene);
  settings.output_folder = options.address ? options.files : "";
  if (options.address) return serve(scene, settings, *options.address);

  view::Viewer viewer(scene, settings);
  warn_of_eye(viewer.world());
  viewer.run();
  if (options.screenshot.empty()) return;
  if (viewer.frames_drawn() == 0)
    throw std::runtime_error("the window was closed before a frame was drawn; no screenshot");
  apps::write_picture(viewer.full_picture(), options.screenshot);
}

}  // namespace
}  // namespace swell::serve

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    if (const auto options = swell::serve::parse_options(argc, argv)) swell::serve::run(*options);
  });
}
