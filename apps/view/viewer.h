// The viewer: events in, frames out.
#pragma once

#include <SDL.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/view/camera_controls.h"
#include "apps/view/gui.h"
#include "apps/view/keys.h"
#include "apps/view/panel.h"
#include "apps/view/sim_clock.h"
#include "apps/view/window.h"
#include "apps/view/world_rebuild.h"
#include "math/parallel.h"
#include "render/frame.h"

namespace swell::view {

class Viewer;

// Who looks at the window's pictures where the window itself shows them to nobody.
struct Audience {
  std::function<bool()> is_watching;  // else nothing is drawn
  std::function<void(Viewer&)> show;  // each frame, when the window holds it with its panels
};

struct ViewerSettings {
  WindowSize size{1280, 720};
  int threads = 1;
  std::filesystem::path cache_folder = {};  // of the first world (render/world/part_cache.h)
  int frames = 0;  // 0: until the window is closed; else frame k is at k/60 s exactly
  render::FrameOptions frame;
  std::optional<Audience> audience = {};
  bool panel_is_open = true;  // at the start
  // Where screenshots and scenes that the user saves go: a folder, made when the first is saved,
  // and at most so many files of it.
  std::filesystem::path output_folder = {};  // empty: the current one
  int most_files = 0;                        // 0: any number
};

class Viewer {
 public:
  // Throws DisplayError, and what render::World throws.
  Viewer(const scene::Scene& scene, const ViewerSettings& settings);

  // Draws frames until the window is closed or the frames are drawn.
  void run();

  // One turn of run(): handles the waiting events, then draws a frame if the window can be seen.
  // False when it is time to end.
  bool turn();

  void handle(const SDL_Event& event);

  // The last frame drawn; empty before the first one.
  const render::Target& picture() const { return drawn_.target; }

  // What the window shows of it: the same, or a label of it in false colours.
  const render::Target& shown() const {
    return drawn_.shows_label ? drawn_.label_picture : drawn_.target;
  }

  // The last frame once more, at the full quality that the panel asks for, whatever the governor
  // left out, with the label that is shown in place of 8-bit colour; not before the first frame. In
  // a workspace of its own, so that the next frame is as it would have been. 50 ms at 1280x720.
  render::Target full_picture();

  // For tests and the panel.
  const SimClock& clock() const { return clock_; }
  const PanelSettings& panel() const { return panel_; }
  const PanelReport& report() const { return report_; }
  std::size_t stones() const { return stones_.size(); }
  double picture_time_s() const { return drawn_.time_s; }
  int frames_drawn() const { return drawn_.count; }
  bool has_own_camera() const { return pose_.has_value(); }
  bool is_rebuilding() const { return rebuilder_.busy(); }
  bool shows_panel() const { return show_panel_; }
  bool shows_help() const { return show_help_; }
  const render::World& world() const { return *world_; }
  Window& window() { return window_; }
  std::string camera_text() const;  // of the last frame, as a table of a scene file
  // The scene as the panel has it, with the camera of the last frame if that was flown by hand.
  std::string scene_text() const;

  // What the panel's sliders do.
  void choose_scene(const SceneChoice& choice);
  void choose_budget(bool governed, double budget_ms);
  void choose_quality(const render::FrameOptions& full_quality);
  void choose_label(std::optional<render::Label> label);  // none: colour

 private:
  using Clock = std::chrono::steady_clock;

  bool is_seen() const;
  void handle_key(const SDL_KeyboardEvent& key);
  void handle_mouse(const SDL_Event& event);
  void handle_window(const SDL_WindowEvent& event);
  void run_command(Command command);
  void capture_mouse(bool capture);
  void save_screenshot();
  void copy_camera();
  void save_scene();
  void choose_sea_state(int code);
  void say(std::string message);

  double time_since_last_frame_s();
  View next_view(double dt_s);
  void request_world();
  void build_panels();
  void draw_frame();
  const render::FrameOptions& next_options();
  void ask_for_label(render::FrameOptions& options);
  void name_label();
  void pick_under_pointer();
  void drop_stone();
  void wait_for_refresh() const;

  // What the window has told since the last frame, and what it holds down.
  struct Input {
    HeldKeys held;
    glm::dvec2 look_px{0.0};           // mouse motion not yet used
    std::optional<glm::vec2> pointer;  // over the window, in its own units
    bool mouse_captured = false, capture_ends_with_button = false;
    bool quits = false;
  };

  // The frames drawn, and the last of them.
  struct Drawn {
    render::Workspace workspace;
    render::FrameOptions options;
    render::Target target, label_picture;
    bool shows_label = false;
    double time_s = 0.0;
    View view;
    int count = 0;
  };

  scene::Scene scene_;  // as loaded
  ViewerSettings settings_;
  Window window_;
  Gui gui_;
  std::shared_ptr<const render::World> world_;
  WorldRebuilder rebuilder_;
  Workers workers_;
  Drawn drawn_;
  render::Governor governor_;
  render::PickScratch pick_scratch_;
  std::vector<ocean::Disturbance> stones_;  // thrown into the water

  SimClock clock_;
  Input input_;
  std::optional<CameraPose> pose_;  // none: the scene's camera
  ocean::SeaFrame sea_;             // of the waves that carry the eye
  PanelSettings panel_;
  PanelReport report_;
  std::optional<render::Label> named_label_;  // in the title
  bool show_panel_, show_help_ = false;
  Clock::time_point last_frame_start_, said_;
};

}  // namespace swell::view
