// Modes that draw the frames of one scene and report figures of them: their options, and what is
// printed or written.
#pragma once

#include <string>

#include "apps/shared/command_line.h"
#include "apps/shared/json.h"
#include "apps/shared/options.h"
#include "render/frame.h"

namespace swell::apps {

inline constexpr double kFramesPerSecond = 60.0;  // frame k shows time k / 60
inline constexpr int kWarmUp = 5;                 // frames before those that count

struct FrameRun {
  FrameSetup setup;
  int frames = 60;
  std::string json;  // a file, "-" or nothing
};

// frames_help: what the frames are for.
void add_frame_run(CommandLine& line, const std::string& frames_help, FrameRun& run);

// The scene's world, once the options are known to be good.
render::World begin_run(const FrameRun& run);

// Prints the scene, `how` it was drawn and `text`, and writes the figures where --json says.
void report_run(const FrameRun& run, const render::World& world, const std::string& how,
                const std::string& text, const Json& figures);

}  // namespace swell::apps
