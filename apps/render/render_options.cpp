#include "apps/render/render_options.h"

#include <fmt/core.h>

#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"

namespace swell::apps {
namespace {

void add_time_options(CommandLine& line, RenderOptions& options) {
  add_number(line, "--time", options.time_s, -1e12, 1e12, "Time of a single picture in seconds");
  line.add_value({"--frames", "A-B", "", "Draw frames A to B; frame k is at k / fps seconds",
                  [&](const std::string& text) { options.frames = parse_frame_range(text); }});
  line.exclude("--frames", "--time");
  add_number(line, "--fps", options.fps, 1e-3, 1e6, "Frames a second of a sequence");
  line.need("--fps", "--frames");
}

void add_output_options(CommandLine& line, RenderOptions& options) {
  line.add_text("--out", "FILE", options.out,
                "File to write: .png .exr .tif .tiff; %04d becomes the frame's number");
  line.add_flag("--hash", options.hash, "Print 'frame N xxh3 HASH' of the 8-bit RGB picture");
  line.add_text("--json", "FILE", options.json,
                "Write a line of JSON a frame; - is standard output, without what --hash prints");
  line.add_text("--expect", "FILE", options.expect,
                "Fail unless each frame has the hash that FILE, from --hash or --json, has for it");
  line.add_flag("--dump-scene", options.dump_scene,
                "Print the scene with every value that the file leaves out");
}

void check_picture_output(const RenderOptions& options) {
  const FrameRange range = frame_range(options);
  if (range.first < range.last && !parse_file_pattern(options.out).numbered)
    throw OptionError(fmt::format(
        "command line: --out: got '{}' for {} frames, allowed names with %d or %04d in them",
        options.out, range.last - range.first + 1));
  check_linear_light(options.setup.frame, "--out", options.out);
  check_picture_file(picture_path(options, range.last));
}

}  // namespace

std::optional<RenderOptions> parse_render_options(int argc, char** argv) {
  RenderOptions options;
  CommandLine line("swell-render", "Draws pictures of a scene.");
  add_frame_setup(line, options.setup);
  add_quality_options(line, options.setup.frame);
  add_time_options(line, options);
  add_output_options(line, options);
  if (!line.parse(argc, argv)) return std::nullopt;
  return options;
}

bool draws_pictures(const RenderOptions& options) {
  return options.hash || !options.out.empty() || !options.json.empty() || !options.expect.empty();
}

FrameRange frame_range(const RenderOptions& options) {
  return options.frames.value_or(FrameRange{0, 0});
}

double frame_time_s(const RenderOptions& options, int frame) {
  return options.frames ? frame / options.fps : options.time_s;
}

std::filesystem::path picture_path(const RenderOptions& options, int frame) {
  if (!options.frames) return options.out;
  return frame_file(parse_file_pattern(options.out), frame);
}

void check_output(const RenderOptions& options) {
  if (!draws_pictures(options) && !options.dump_scene)
    throw OptionError("command line: --out, --hash, --json, --expect or --dump-scene is required");
  if (options.dump_scene && options.json == "-")
    throw OptionError(
        "command line: --dump-scene, got it with --json '-', allowed --json FILE: both would "
        "print");
  if (!options.out.empty()) check_picture_output(options);
  check_text_place(options.json);
}

}  // namespace swell::apps
