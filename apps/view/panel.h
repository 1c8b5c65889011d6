// The panel: what can be changed, what was measured.
#pragma once

#include <string>

#include "apps/view/frame_history.h"
#include "apps/view/wave_choice.h"
#include "render/frame.h"

namespace swell::view {

// What the panel changes.
struct PanelSettings {
  WaveChoice waves;
  render::FrameOptions frame;
  bool paused = false;
};

// What the panel shows.
struct PanelReport {
  render::FrameStatistics statistics;  // of the last frame
  FrameHistory history;                // of render_frame
  double present_ms = 0.0;             // upload, panel and presentation of the last frame
  double t_s = 0.0;
  int width_px = 0, height_px = 0;
  int threads = 1;
  std::string scene_name, simd;
  bool rebuilding = false;
  std::string message;  // the last thing that happened; may be empty
};

// Between Gui::begin_frame and end_frame. True if the waves were changed.
bool draw_panel(const PanelReport& report, PanelSettings& settings);

// The list of keys, in the middle of the window.
void draw_help();

}  // namespace swell::view
