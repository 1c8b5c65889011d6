#include "apps/render/render_options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "apps/shared/label_file.h"
#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "texture/image/image_note.h"

namespace swell::apps {
namespace {

void add_time_options(CommandLine& line, RenderOptions& options) {
  add_number(line, "--time", options.time_s, -1e12, 1e12, "Time of a single picture in seconds");
  line.add_value({"--frames", "A-B", "", "Draw frames A to B; frame k is at k / fps seconds",
                  [&](const std::string& text) { options.frames = parse_frame_range(text); }});
  line.exclude("--frames", "--time");
  add_number(line, "--fps", options.fps, 1e-3, 1e6, "Frames a second of a sequence");
  line.need("--fps", "--frames");
  add_integer(line, "--every", options.every, 1, 10'000'000, "Draw every N-th of the frames");
  line.need("--every", "--frames");
  line.add_flag("--skip-existing", options.skip_existing,
                "Do not draw frames whose files are all there");
  line.add_flag("--quiet", options.quiet, "No progress bar, which sequences have on a terminal");
}

void add_output_options(CommandLine& line, RenderOptions& options) {
  line.add_text(
      "--out", "FILE", options.out,
      "File to write: .png .exr .tif .tiff; %04d becomes the frame's number; .mcap: ROS 2 "
      "messages");
  line.add_flag("--hash", options.hash, "Print 'frame N xxh3 HASH' of the 8-bit RGB picture");
  line.add_text("--json", "FILE", options.json,
                "Write a line of JSON a frame; - is standard output, without what --hash prints");
  line.add_text("--expect", "FILE", options.expect,
                "Fail unless each frame has the hash that FILE, from --hash or --json, has for it");
  const auto take_stream = [&options](const std::string& text) {
    if (text != "y4m" && text != "ppm")
      throw OptionError(fmt::format("command line: --stream: got '{}', allowed y4m or ppm", text));
    options.stream = text;
  };
  line.add_value({"--stream", "FORMAT", "",
                  "Write the pictures to standard output, for ffmpeg: y4m or ppm", take_stream});
  const auto take_compression = [&options](const std::string& text) {
    if (std::ranges::count(texture::kExrCompressions, text) == 0)
      throw OptionError(fmt::format("command line: --exr-compression: got '{}', allowed {}", text,
                                    fmt::join(texture::kExrCompressions, ", ")));
    options.exr_compression = text;
  };
  line.add_value({"--exr-compression", "NAME", "zip",
                  "Of .exr files: none, rle, zips, zip or piz, which lose nothing",
                  take_compression});
  line.add_flag("--dump-scene", options.dump_scene,
                "Print the scene with every value that the file leaves out");
}

void add_label_options(CommandLine& line, RenderOptions& options) {
  add_labels_option(
      line, options.labels,
      "Write labels beside the picture, or into it if it is .exr, and a .labels.json");
  line.add_text("--labels-out", "FILE", options.labels_out, "The file of --labels: .exr");
  line.need("--labels-out", "--labels");
  line.add_text("--depth", "FILE", options.depth,
                "Write the depth alone: .npy (metres), .png (16 bits, metres x 256)");
  line.add_text("--ids", "FILE", options.ids, "Write the ids alone: .npy, .png (16 bits)");
}

void check_numbered(const RenderOptions& options, std::string_view option,
                    const std::string& pattern) {
  const FrameRange range = frame_range(options);
  if (range.first < range.last && !parse_file_pattern(pattern).numbered)
    throw OptionError(fmt::format(
        "command line: {}: got '{}' for {} frames, allowed names with %d or %04d in them", option,
        pattern, range.last - range.first + 1));
}

// One file of all frames.
void check_film(const RenderOptions& options) {
  if (parse_file_pattern(options.out).numbered)
    throw OptionError(
        fmt::format("command line: --out: got '{}', allowed .mcap files without %d, which have all "
                    "frames in them",
                    options.out));
  if (options.skip_existing)
    throw OptionError(fmt::format(
        "command line: --skip-existing, got it with --out '{}', allowed with a file a frame",
        options.out));
  constexpr double kLongest_s = 2147483647.0;  // of a stamp's seconds
  const FrameRange range = frame_range(options);
  for (const int frame : {range.first, range.last})
    if (const double t_s = frame_time_s(options, frame); !(t_s >= 0.0 && t_s <= kLongest_s))
      throw OptionError(
          fmt::format("command line: --out '{}': got a frame at {} s, allowed 0 to {} s",
                      options.out, t_s, kLongest_s));
  check_output_place(options.out);
}

void check_picture_output(const RenderOptions& options) {
  if (is_film(options.out)) return check_film(options);
  check_numbered(options, "--out", options.out);
  check_linear_light(options.setup.frame, "--out", options.out);
  check_picture_file(picture_path(options, frame_range(options).last));
}

// The file of --labels and its sidecar: names of frames, format, places.
void check_label_file(const RenderOptions& options) {
  if (options.out.empty() && options.labels_out.empty())
    throw OptionError(
        "command line: --labels, got no file for them, allowed with --out or --labels-out");
  if (film_holds_labels(options)) return;
  if (!options.labels_out.empty()) check_numbered(options, "--labels-out", options.labels_out);
  const std::filesystem::path path = label_path(options, frame_range(options).last);
  if (lower_extension(path) != ".exr")
    throw OptionError(fmt::format("command line: --labels-out: got '{}', allowed .exr files",
                                  options.labels_out));
  check_output_place(path);
  check_output_place(sidecar_path(path));
}

void check_label_output(const RenderOptions& options) {
  const int last = frame_range(options).last;
  check_labels_scale(drawn_labels(options), options.setup.frame);
  if (!options.labels.empty()) check_label_file(options);
  for (const auto& [option, pattern] :
       {std::pair("--depth", options.depth), std::pair("--ids", options.ids)}) {
    if (pattern.empty()) continue;
    check_numbered(options, option, pattern);
    check_plane_file(numbered_path(options, pattern, last));
  }
}

// The options that change a frame's pixels: the same ones for a frame alone, and on any machine.
std::vector<std::string> frame_command(const CommandLine& line, const RenderOptions& options) {
  const std::filesystem::path scene = options.setup.scene.path;
  std::vector<std::string> command = {"swell-render", "--scene", scene.filename().string()};
  for (const std::string& argument : line.arguments_without({"--scene",
                                                             "--threads",
                                                             "--simd",
                                                             "--cache",
                                                             "--tile",
                                                             "--time",
                                                             "--frames",
                                                             "--fps",
                                                             "--every",
                                                             "--skip-existing",
                                                             "--quiet",
                                                             "--out",
                                                             "--hash",
                                                             "--json",
                                                             "--expect",
                                                             "--stream",
                                                             "--exr-compression",
                                                             "--dump-scene",
                                                             "--labels",
                                                             "--labels-out",
                                                             "--depth",
                                                             "--ids"}))
    command.push_back(argument);
  return command;
}

// Two options that name one file would leave what is written last.
void check_distinct(const RenderOptions& options) {
  std::vector<std::pair<std::string_view, std::string>> files = {
      {"--out", options.out},
      {"--labels-out", options.labels_out},
      {"--depth", options.depth},
      {"--ids", options.ids},
      {"--json", options.json}};
  std::erase_if(files, [](const auto& file) { return file.second.empty(); });
  const auto place = [&](std::size_t i) {
    return std::filesystem::path(files[i].second).lexically_normal();
  };
  for (std::size_t i = 1; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (place(i) == place(j))
        throw OptionError(fmt::format("command line: {}: got '{}', allowed another file than {}",
                                      files[i].first, files[i].second, files[j].first));
}

}  // namespace

std::optional<RenderOptions> parse_render_options(int argc, char** argv) {
  RenderOptions options;
  CommandLine line("swell-render", "Draws pictures of a scene.");
  add_required_frame_setup(line, options.setup);
  add_cache_option(line, options.setup.cache_folder);
  add_quality_options(line, options.setup.frame);
  add_time_options(line, options);
  add_output_options(line, options);
  add_label_options(line, options);
  if (!line.parse(argc, argv)) return std::nullopt;
  options.frame_command = frame_command(line, options);
  return options;
}

bool draws_pictures(const RenderOptions& options) {
  return options.hash || !options.json.empty() || !options.expect.empty() ||
         !options.stream.empty() || writes_files(options);
}

FrameRange frame_range(const RenderOptions& options) {
  return options.frames.value_or(FrameRange{0, 0});
}

double frame_time_s(const RenderOptions& options, int frame) {
  return options.frames ? frame / options.fps : options.time_s;
}

double next_time_s(const RenderOptions& options, int frame) {
  return options.frames ? frame_time_s(options, frame + 1) : options.time_s + 1.0 / options.fps;
}

std::filesystem::path picture_path(const RenderOptions& options, int frame) {
  return numbered_path(options, options.out, frame);
}

std::filesystem::path numbered_path(const RenderOptions& options, const std::string& pattern,
                                    int frame) {
  if (!options.frames) return pattern;
  return frame_file(parse_file_pattern(pattern), frame);
}

bool is_film(const std::filesystem::path& path) { return lower_extension(path) == ".mcap"; }

bool film_holds_labels(const RenderOptions& options) {
  return is_film(options.out) && !options.labels.empty() && options.labels_out.empty();
}

std::filesystem::path label_path(const RenderOptions& options, int frame) {
  if (!options.labels_out.empty()) return numbered_path(options, options.labels_out, frame);
  std::filesystem::path path = picture_path(options, frame);
  return stores_linear_light(path) ? path : path.replace_extension(".labels.exr");
}

std::filesystem::path sidecar_path(const std::filesystem::path& labels) {
  std::filesystem::path path = labels;
  path.replace_extension();
  if (path.extension() == ".labels") path.replace_extension();
  return path += ".labels.json";
}

render::LabelSet drawn_labels(const RenderOptions& options) {
  render::LabelSet set = options.labels;
  if (!options.depth.empty()) set.add(render::Label::kDepth);
  if (!options.ids.empty()) set.add(render::Label::kId);
  return set;
}

bool writes_files(const RenderOptions& options) {
  return !options.out.empty() || !options.labels.empty() || !options.depth.empty() ||
         !options.ids.empty();
}

bool files_exist(const RenderOptions& options, int frame) {
  std::vector<std::filesystem::path> files;
  if (!options.out.empty()) files.push_back(picture_path(options, frame));
  if (!options.labels.empty()) {
    files.push_back(label_path(options, frame));
    files.push_back(sidecar_path(files.back()));
  }
  for (const std::string& pattern : {options.depth, options.ids})
    if (!pattern.empty()) files.push_back(numbered_path(options, pattern, frame));
  return std::ranges::all_of(files, [](const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(std::filesystem::symlink_status(file, ignored));
  });
}

void check_output(const RenderOptions& options) {
  if (!draws_pictures(options) && !options.dump_scene)
    throw OptionError(
        "command line: got nothing to do, allowed --out, --labels-out, --depth, --ids, --hash, "
        "--json, --expect, --stream or --dump-scene");
  if (!options.stream.empty() && (options.hash || options.json == "-" || options.dump_scene))
    throw OptionError(
        "command line: --stream, got it with --hash, --json '-' or --dump-scene, allowed without "
        "them: all would write to standard output");
  if (options.skip_existing && (!writes_files(options) || !options.stream.empty() || options.hash ||
                                !options.json.empty() || !options.expect.empty()))
    throw OptionError(
        "command line: --skip-existing, got it with --hash, --json, --expect or --stream or "
        "without "
        "files of frames, allowed with --out, --labels-out, --depth and --ids");
  if (options.dump_scene && options.json == "-")
    throw OptionError(
        "command line: --dump-scene, got it with --json '-', allowed --json FILE: both would "
        "print");
  check_distinct(options);
  if (!options.out.empty()) check_picture_output(options);
  check_label_output(options);
  check_text_place(options.json);
}

}  // namespace swell::apps
