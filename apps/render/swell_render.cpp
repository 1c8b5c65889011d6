// swell-render: draws one picture or a sequence of a scene.
#include <fmt/core.h>

#include <cstdio>
#include <optional>

#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "render/frame.h"

namespace swell::apps {
namespace {

struct RenderOptions {
  FrameSetup setup;
  double time_s = 0.0;
  std::optional<FrameRange> frames;  // none: one picture at time_s
  double fps = 60.0;
  std::string out;
  bool hash = false;
  bool dump_scene = false;
};

std::optional<RenderOptions> parse_options(int argc, char** argv) {
  RenderOptions options;
  CommandLine line("swell-render", "Draws pictures of a scene.");
  add_frame_setup(line, options.setup);
  add_quality_options(line, options.setup.frame);
  add_number(line, "--time", options.time_s, -1e12, 1e12, "Time of a single picture in seconds");
  line.add_value({"--frames", "A-B", "", "Draw frames A to B; frame k is at k / fps seconds",
                  [&](const std::string& text) { options.frames = parse_frame_range(text); }});
  line.exclude("--frames", "--time");
  add_number(line, "--fps", options.fps, 1e-3, 1e6, "Frames a second of a sequence");
  line.need("--fps", "--frames");
  line.add_text("--out", "FILE", options.out,
                "File to write: .png .exr .tif .tiff; %04d becomes the frame's number");
  line.add_flag("--hash", options.hash, "Print 'frame N xxh3 HASH' of the 8-bit RGB picture");
  line.add_flag("--dump-scene", options.dump_scene,
                "Print the scene with every value that the file leaves out");
  if (!line.parse(argc, argv)) return std::nullopt;
  return options;
}

FrameRange frame_range(const RenderOptions& options) {
  return options.frames.value_or(FrameRange{0, 0});
}

// The file of frame k; a single picture's name is taken as it is.
std::filesystem::path output_file(const RenderOptions& options, int k) {
  if (!options.frames) return options.out;
  return frame_file(parse_file_pattern(options.out), k);
}

// Refuses, before any work is done, what could not be written after it.
void check_output(const RenderOptions& options) {
  if (options.out.empty()) {
    if (!options.hash && !options.dump_scene)
      throw OptionError("command line: --out, --hash or --dump-scene is required");
    return;
  }
  const FrameRange range = frame_range(options);
  if (range.first < range.last && !parse_file_pattern(options.out).numbered)
    throw OptionError(fmt::format(
        "command line: --out: got '{}' for {} frames, allowed names with %d or %04d in them",
        options.out, range.last - range.first + 1));
  check_linear_light(options.setup.frame, "--out", options.out);
  check_picture_file(output_file(options, range.last));
}

void print_hash(int k, const render::Target& target) {
  fmt::print("frame {} xxh3 {:016x}\n", k, render::picture_hash(target));
  if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write to standard output");
}

void render_pictures(const RenderOptions& options, scene::Scene scene) {
  const FrameSetup& setup = options.setup;
  const render::World world(std::move(scene));
  render::FrameOptions frame_options = setup.frame;
  frame_options.keep_linear = stores_linear_light(options.out);

  Workers workers(setup.threads);
  render::Workspace workspace;
  render::Target target;
  EyeWarning warning;
  const FrameRange range = frame_range(options);
  for (int k = range.first; k <= range.last; ++k) {
    const double t_s = options.frames ? k / options.fps : options.time_s;
    const View view =
        scene::camera_view(world.scene().camera, t_s, setup.size.width_px, setup.size.height_px);
    render::render_frame(world, view, t_s, frame_options, workspace, target, workers);
    warning.look(k, world, view, workspace);
    if (!options.out.empty()) write_picture(target, output_file(options, k));
    if (options.hash) print_hash(k, target);
  }
}

void run(const RenderOptions& options) {
  select_simd(options.setup.simd);
  check_output(options);
  const bool draws = options.hash || !options.out.empty();
  const std::string& path = options.setup.scene_path;
  scene::Scene scene = draws ? load_scene(path) : scene::load_scene(path);
  if (options.dump_scene) fmt::print("{}", scene::dump_scene(scene));
  if (draws) render_pictures(options, std::move(scene));
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] {
    if (const auto options = swell::apps::parse_options(argc, argv)) swell::apps::run(*options);
  });
}
