// swell-view: flies over a scene in a window.
#include <optional>
#include <string>

#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "apps/view/viewer.h"
#include "render/world/world_view.h"

namespace swell::view {
namespace {

constexpr int kMostFrames = 10'000'000;

struct Options {
  apps::FrameSetup setup;
  int frames = 0;
  std::string screenshot;
};

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  apps::CommandLine line("swell-view", "Flies over a scene in a window; F1 shows the keys.");
  apps::add_frame_setup(line, options.setup);
  apps::add_quality_options(line, options.setup.frame);
  apps::add_integer(line, "--frames", options.frames, 0, kMostFrames,
                    "Quit after N frames, the k-th (from 0) at k/60 seconds; 0: when closed");
  line.add_text("--screenshot", "FILE", options.screenshot,
                "Write the last frame before quitting: .png .exr .tif .tiff");
  if (!line.parse(argc, argv)) return std::nullopt;
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

void view(const Options& options) {
  apps::select_simd(options.setup.simd);
  apps::check_linear_light(options.setup.frame, "--screenshot", options.screenshot);
  if (!options.screenshot.empty()) apps::check_picture_file(options.screenshot);

  ViewerSettings settings;
  settings.size = {options.setup.size.width_px, options.setup.size.height_px};
  settings.threads = options.setup.threads;
  settings.frames = options.frames;
  settings.frame = options.setup.frame;
  settings.frame.keep_linear = apps::stores_linear_light(options.screenshot);

  Viewer viewer(apps::load_scene(options.setup.scene_path), settings);
  warn_of_eye(viewer.world());
  viewer.run();
  if (options.screenshot.empty()) return;
  if (viewer.frames_drawn() == 0)
    throw std::runtime_error("the window was closed before a frame was drawn; no screenshot");
  apps::write_picture(viewer.full_picture(), options.screenshot);
}

}  // namespace
}  // namespace swell::view

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    if (const auto options = swell::view::parse_options(argc, argv)) swell::view::view(*options);
  });
}
