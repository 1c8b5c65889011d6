// swell-render's command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/shared/options.h"

namespace swell::apps {

struct RenderOptions {
  FrameSetup setup;
  double time_s = 0.0;
  std::optional<FrameRange> frames;  // none: one picture at time_s
  double fps = 60.0;
  std::string out, json, expect;  // files; empty: not asked for
  bool hash = false;
  bool dump_scene = false;
};

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<RenderOptions> parse_render_options(int argc, char** argv);

// False if there is only a scene to dump.
bool draws_pictures(const RenderOptions& options);

// The frames to draw; a single picture is frame 0.
FrameRange frame_range(const RenderOptions& options);

double frame_time_s(const RenderOptions& options, int frame);

// The picture's file, empty if none is to be written. A single picture's name is taken as it is.
std::filesystem::path picture_path(const RenderOptions& options, int frame);

// Refuses, before any work is done, what could not be written after it: throws OptionError or
// texture::FileError.
void check_output(const RenderOptions& options);

}  // namespace swell::apps
