// swell-render's command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/options.h"

namespace swell::apps {

struct RenderOptions {
  FrameSetup setup;
  double time_s = 0.0;
  std::optional<FrameRange> frames;  // none: one picture at time_s
  double fps = 60.0;
  std::string out, json, expect;           // files; empty: not asked for
  render::LabelSet labels;                 // of the file of labels
  std::string labels_out, depth, ids;      // files; empty: not asked for
  std::vector<std::string> frame_command;  // draws a frame again, but for its time
  int every = 1;                           // of the frames, [1, 10000000]
  bool skip_existing = false;
  bool quiet = false;
  std::string stream;  // "y4m" or "ppm"; empty: not asked for
  std::string exr_compression = "zip";
  bool hash = false;
  bool dump_scene = false;
};

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<RenderOptions> parse_render_options(int argc, char** argv);

// False if there is only a scene to dump.
bool draws_pictures(const RenderOptions& options);

// The frames to draw, each options.every-th from the first on; a single picture is frame 0.
FrameRange frame_range(const RenderOptions& options);

double frame_time_s(const RenderOptions& options, int frame);
double next_time_s(const RenderOptions& options, int frame);  // 1 / fps later

// The picture's file, empty if none is to be written. A single picture's name is taken as it is.
std::filesystem::path picture_path(const RenderOptions& options, int frame);

// Names any other file of a frame likewise, by its pattern.
std::filesystem::path numbered_path(const RenderOptions& options, const std::string& pattern,
                                    int frame);

// Whether a file holds all frames (film_file.h), and their labels too: unless --labels-out is
// given.
bool is_film(const std::filesystem::path& path);
bool film_holds_labels(const RenderOptions& options);

// Where labels go that no film holds: the file of --labels-out; else the picture's if that is an
// EXR file; else, beside "x.png", "x.labels.exr".
std::filesystem::path label_path(const RenderOptions& options, int frame);

// Beside a file of labels, "x.exr" or "x.labels.exr": "x.labels.json".
std::filesystem::path sidecar_path(const std::filesystem::path& labels);

// All labels that a frame has to be drawn with.
render::LabelSet drawn_labels(const RenderOptions& options);

bool writes_files(const RenderOptions& options);  // of frames

// Whether every file of the frame is there.
bool files_exist(const RenderOptions& options, int frame);

// Refuses, before any work is done, what could not be written after it: throws OptionError or
// texture::FileError.
void check_output(const RenderOptions& options);

}  // namespace swell::apps
