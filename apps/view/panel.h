// The panel: what can be changed, what was measured.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "apps/view/camera_controls.h"
#include "apps/view/frame_history.h"
#include "apps/view/scene_choice.h"
#include "render/frame.h"
#include "render/measure/pick.h"
#include "render/quality/governor.h"

namespace swell::view {

// What the panel changes.
struct PanelSettings {
  SceneChoice scene;
  render::FrameOptions frame;  // full quality
  bool governed = false;       // less of it where frames would take longer than the budget
  double budget_ms = kBudget_ms;
  bool paused = false;
  std::optional<render::Label> label{};  // shown in place of colour
};

// What the panel shows.
struct PanelReport {
  render::FrameStatistics statistics;  // of the last frame
  FrameHistory history;                // of render_frame
  render::GovernorReport governor;     // if it is on
  double picture_scale = 1.0;          // of the last frame
  double frame_ms = 0.0;               // of the last frame, from its events to its presentation
  double present_ms = 0.0;             // upload, panel and presentation of the last frame
  double t_s = 0.0;
  int width_px = 0, height_px = 0;
  int threads = 1;
  std::string scene_name, simd;
  EnumTable<WaveModel, const char*> wave_names{};
  bool rebuilding = false;
  std::string message;  // what has just happened; may be empty
  CameraPose camera;    // of the last frame
  double fov_y_rad = 0.0;
  std::optional<render::Pick> pick;  // what the last picture shows under the pointer
};

// What draw_panel has changed, and what was asked for.
struct PanelChanges {
  bool scene = false;
  bool copy_camera = false, save_scene = false;
};

// These between Gui::begin_frame and end_frame. `scene` is the one that was loaded.
PanelChanges draw_panel(const PanelReport& report, const scene::Scene& scene,
                        PanelSettings& settings);

// Why the picture is not whole, if it is not, and what of it is drawn; one line, such as
// "6 ms over: 85 % of the size, 40 % of the triangles".
std::string quality_line(const render::GovernorReport& governor, double picture_scale,
                         double budget_ms);

// Beside the pointer: what the picture shows there.
void draw_pick(const render::Pick& pick, glm::vec2 pointer_px);

// At the top of the window, over everything, wrapped.
void draw_message(const std::string& message);

// The list of keys, in the middle of the window.
void draw_help(bool in_browser);

}  // namespace swell::view
