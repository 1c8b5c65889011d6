#include "apps/view/viewer.h"

#include <fmt/core.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "apps/shared/label_picture.h"
#include "apps/view/camera_text.h"
#include "apps/view/eye_floor.h"
#include "math/elementary.h"
#include "math/simd_target.h"
#include "ocean/spectrum/sea_scale.h"
#include "render/world_view.h"

namespace swell::view {
namespace {

constexpr int kSleepWhileHidden_ms = 200;
constexpr std::chrono::seconds kMessageStays{5};

using Milliseconds = std::chrono::duration<double, std::milli>;

// Colour, then the labels in the table's order, then colour again.
std::optional<render::Label> next_label(std::optional<render::Label> label) {
  const std::size_t next = label ? 1 + static_cast<std::size_t>(*label) : 0;
  if (next == render::kLabelCount) return std::nullopt;
  return static_cast<render::Label>(next);
}

// From the picture's lower to its upper edge.
double fov_y_rad(const View& view) {
  const auto angle = [](float tangent) { return atan2(static_cast<double>(tangent), 1.0); };
  return angle(view.tan_middle_y + view.tan_half_y) - angle(view.tan_middle_y - view.tan_half_y);
}

}  // namespace

Viewer::Viewer(const scene::Scene& scene, const ViewerSettings& settings)
    : scene_(scene),
      settings_(settings),
      window_("swell - " + scene.name, settings.size),
      gui_(window_.handle(), window_.renderer()),
      world_(std::make_shared<render::World>(
          scene,
          render::WorldMaking{.threads = settings.threads, .cache_folder = settings.cache_folder})),
      workers_(settings.threads),
      governor_({}, render::with_scene_defaults(settings.frame, scene)),
      show_panel_(settings.panel_is_open),
      last_frame_start_(Clock::now()) {
  clock_.by_steps = settings.frames > 0;
  panel_.scene = scene_choice(scene);
  panel_.frame = render::with_scene_defaults(settings.frame, scene);  // where sliders start
  panel_.governed = settings.frames == 0;  // counted frames are to be the same each time
  report_.threads = settings.threads;
  report_.simd = simd_target_name(current_simd_target());
  report_.scene_name = scene.name;
  report_.wave_names = wave_names(scene);
}

// ---- events ----

void Viewer::handle(const SDL_Event& event) {
  gui_.handle(event);
  switch (event.type) {
    case SDL_QUIT:
      input_.quits = true;
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      handle_key(event.key);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
    case SDL_MOUSEMOTION:
      handle_mouse(event);
      break;
    case SDL_WINDOWEVENT:
      handle_window(event.window);
      break;
    case SDL_RENDER_TARGETS_RESET:
    case SDL_RENDER_DEVICE_RESET:
      window_.forget_textures();
      gui_.forget_textures();
      break;
    default:
      break;
  }
}

void Viewer::handle_window(const SDL_WindowEvent& event) {
  if (event.event == SDL_WINDOWEVENT_CLOSE) input_.quits = true;
  if (event.event == SDL_WINDOWEVENT_LEAVE) input_.pointer.reset();
  if (event.event != SDL_WINDOWEVENT_FOCUS_LOST) return;
  input_.held.reset();  // their key-up events go to another window
  capture_mouse(false);
}

void Viewer::handle_key(const SDL_KeyboardEvent& key) {
  const SDL_Scancode place = key.keysym.scancode;
  const bool is_down = key.type == SDL_KEYDOWN && !gui_.wants_text();
  if (place >= 0 && place < SDL_NUM_SCANCODES) input_.held[place] = is_down;
  if (!is_down || key.repeat != 0) return;
  if (const auto command = command_for(key.keysym.sym)) run_command(*command);
  if (const auto code = sea_state_for(key.keysym.sym)) choose_sea_state(*code);
}

void Viewer::handle_mouse(const SDL_Event& event) {
  if (event.type == SDL_MOUSEMOTION) {
    if (input_.mouse_captured) input_.look_px += glm::dvec2(event.motion.xrel, event.motion.yrel);
    input_.pointer = glm::vec2(event.motion.x, event.motion.y);
    return;
  }
  const bool is_right = event.button.button == SDL_BUTTON_RIGHT;
  const bool is_left = event.button.button == SDL_BUTTON_LEFT;
  if (event.type == SDL_MOUSEBUTTONUP) {
    if (input_.capture_ends_with_button) capture_mouse(false);
  } else if (event.button.button == SDL_BUTTON_MIDDLE) {
    drop_stone();
  } else if ((is_right || is_left) && !input_.mouse_captured && !gui_.wants_mouse()) {
    capture_mouse(true);
    input_.capture_ends_with_button = is_right || settings_.audience;  // a browser keeps Esc
  }
}

void Viewer::capture_mouse(bool capture) {
  if (capture == input_.mouse_captured) return;
  input_.mouse_captured = capture;
  input_.capture_ends_with_button = false;
  if (!settings_.audience)  // whose pointer is not ours to hide
    SDL_SetRelativeMouseMode(capture ? SDL_TRUE : SDL_FALSE);
}

void Viewer::run_command(Command command) {
  switch (command) {
    case Command::kHelp:
      show_help_ = !show_help_;
      break;
    case Command::kPanel:
      show_panel_ = !show_panel_;
      break;
    case Command::kWireframe:
      panel_.frame.wireframe = !panel_.frame.wireframe;
      break;
    case Command::kLabel:
      choose_label(next_label(panel_.label));
      break;
    case Command::kFullScreen:
      window_.toggle_full_screen();
      break;
    case Command::kScreenshot:
      save_screenshot();
      break;
    case Command::kPause:
      panel_.paused = !panel_.paused;
      break;
    case Command::kStep:
      panel_.paused = true;
      clock_.step_once = true;
      break;
    case Command::kResetCamera:
      pose_.reset();
      break;
    case Command::kCopyCamera:
      copy_camera();
      break;
    case Command::kSaveScene:
      save_scene();
      break;
    case Command::kEscape:
      if (input_.mouse_captured)
        capture_mouse(false);
      else
        input_.quits = true;
      break;
  }
}

void Viewer::say(std::string message) {
  report_.message = std::move(message);
  said_ = Clock::now();
}

void Viewer::choose_scene(const SceneChoice& choice) {
  panel_.scene = choice;
  request_world();
}

void Viewer::choose_sea_state(int code) {
  panel_.scene.waves.sea_state = code;
  if (panel_.scene.waves.model == WaveModel::kSines)
    panel_.scene.waves.model = WaveModel::kSpectrum;
  request_world();
  say(fmt::format("sea state {}: {}", code, ocean::douglas_step(code).name));
}

void Viewer::choose_budget(bool governed, double budget_ms) {
  panel_.governed = governed;
  panel_.budget_ms = budget_ms;
}

void Viewer::choose_quality(const render::FrameOptions& full_quality) {
  panel_.frame = full_quality;
}

void Viewer::choose_label(std::optional<render::Label> label) { panel_.label = label; }

void Viewer::request_world() {
  scene::Scene scene = with_choice(scene_, panel_.scene);
  report_.wave_names = wave_names(scene);
  rebuilder_.request(std::move(scene), world_);
}

// ---- frames ----

void Viewer::run() {
  while (turn()) {
  }
}

bool Viewer::is_seen() const {
  return settings_.audience ? settings_.audience->is_watching() : window_.is_visible();
}

bool Viewer::turn() {
  SDL_Event event;
  while (SDL_PollEvent(&event)) handle(event);
  if (input_.quits) return false;

  // A run of counted frames draws them all, seen or not.
  if (settings_.frames == 0 && !is_seen()) {
    if (SDL_WaitEventTimeout(&event, kSleepWhileHidden_ms)) handle(event);
    return !input_.quits;
  }
  draw_frame();
  ++drawn_.count;
  if (settings_.frames == 0) wait_for_refresh();
  return settings_.frames == 0 || drawn_.count < settings_.frames;
}

void Viewer::draw_frame() {
  const double dt_s = time_since_last_frame_s();
  rebuilder_.swap_if_ready(world_);
  build_panels();
  clock_.paused = panel_.paused;
  if (drawn_.count > 0) tick(clock_, dt_s);

  // Draw. Nothing below handles events, so the window's surface stays what it is until shown.
  drawn_.view = next_view(dt_s);
  report_.fov_y_rad = fov_y_rad(drawn_.view);
  drawn_.time_s = clock_.t_s;
  report_.statistics = render::render_frame(*world_, drawn_.view, drawn_.time_s, next_options(),
                                            drawn_.workspace, drawn_.target, workers_);
  drawn_.shows_label = panel_.label.has_value();
  if (drawn_.shows_label) {
    drawn_.label_picture.width_px = drawn_.target.width_px;
    drawn_.label_picture.height_px = drawn_.target.height_px;
    apps::paint_label(*panel_.label, drawn_.target.labels, drawn_.view, drawn_.label_picture.rgba);
  }
  pick_under_pointer();

  // Show.
  const Clock::time_point drawn = Clock::now();
  window_.draw_picture(shown());
  gui_.draw();
  if (settings_.audience) settings_.audience->show(*this);
  window_.present();
  const Clock::time_point shown = Clock::now();
  report_.present_ms = Milliseconds(shown - drawn).count();
  report_.frame_ms = Milliseconds(shown - last_frame_start_).count();
  add_frame(report_.history, report_.frame_ms);
  if (panel_.governed && !drawn_.shows_label)  // whose frames are not drawn as it said
    governor_.next(report_.statistics, report_.frame_ms - report_.statistics.frame_ms);
}

const render::FrameOptions& Viewer::next_options() {
  governor_.set_budget_ms(panel_.budget_ms);
  governor_.set_full_quality(panel_.frame);
  drawn_.options = panel_.governed ? governor_.options() : panel_.frame;
  drawn_.options.disturbances = stones_;
  ask_for_label(drawn_.options);
  report_.governor = governor_.report();
  report_.picture_scale = drawn_.options.picture_scale;
  return drawn_.options;
}

// Labels are of the picture's own pixels: it is drawn at its full size.
void Viewer::ask_for_label(render::FrameOptions& options) {
  if (!panel_.label) return;
  options.labels = {};
  options.labels.add(*panel_.label);
  options.picture_scale = 1.0;
  options.next_frame_s = 1.0 / kStepsPerSecond;
  if (*panel_.label != render::Label::kMotion || pose_) return;
  options.next_view =
      render::world_view(*world_, drawn_.time_s + options.next_frame_s, drawn_.view.width_px,
                         drawn_.view.height_px, sea_, workers_);
}

// In the title, for as long as it is shown, and in a message.
void Viewer::name_label() {
  if (panel_.label == named_label_) return;
  named_label_ = panel_.label;
  std::string title = "swell - " + scene_.name;
  if (named_label_) {
    const render::LabelInfo& info = render::label_table()[static_cast<std::size_t>(*named_label_)];
    title += fmt::format(" - {}", info.name);
    say(fmt::format("{}: {}", info.name, info.meaning));
  } else {
    say("colour");
  }
  SDL_SetWindowTitle(window_.handle(), title.c_str());
}

void Viewer::pick_under_pointer() {
  report_.pick.reset();
  if (!input_.pointer || input_.mouse_captured || gui_.wants_mouse()) return;
  const glm::vec2 pixel = *input_.pointer * window_.pixels_per_unit() + 0.5f;
  report_.pick = render::pick(*world_, drawn_.view, drawn_.workspace, pixel, pick_scratch_);
}

// Where the pointer is on the water, now; the first of too many is forgotten.
void Viewer::drop_stone() {
  constexpr std::size_t kMostStones = 32;
  if (!report_.pick || report_.pick->what != render::Shown::kWater) return;
  if (stones_.size() == kMostStones) stones_.erase(stones_.begin());
  ocean::Disturbance stone;
  stone.position_m = glm::dvec2(report_.pick->p_world);
  stone.t_s = clock_.t_s;
  stone.radius_m = 0.3;
  stone.height_m = -0.15;
  stones_.push_back(stone);
}

double Viewer::time_since_last_frame_s() {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> passed = now - last_frame_start_;
  last_frame_start_ = now;
  return clock_.by_steps ? 1.0 / kStepsPerSecond : passed.count();
}

View Viewer::next_view(double dt_s) {
  const WindowSize size = window_.size_px();
  CameraInput input = motion_of(input_.held);
  input.look_x_px = input_.look_px.x;
  input.look_y_px = input_.look_px.y;
  input_.look_px = glm::dvec2(0.0);

  const scene::Camera& camera = scene_.camera;
  const View on_path =
      render::world_view(*world_, clock_.t_s, size.width_px, size.height_px, sea_, workers_);
  report_.camera = pose_.value_or(pose_of_scene(camera, on_path));
  if (!pose_ && is_idle(input)) return on_path;

  // Moved by hand, the eye stays above the ground.
  pose_ = fly(report_.camera, input, dt_s);
  glm::dvec3& eye_m = pose_->eye_m;
  eye_m.z = std::max(eye_m.z, eye_floor_m(*world_, eye_m));
  report_.camera = *pose_;
  return scene::camera_view(camera_at(*pose_, camera), clock_.t_s, size.width_px, size.height_px);
}

void Viewer::build_panels() {
  report_.t_s = clock_.t_s;
  report_.rebuilding = rebuilder_.busy();
  report_.width_px = drawn_.target.width_px;
  report_.height_px = drawn_.target.height_px;
  if (const std::string error = rebuilder_.error(); !error.empty()) say(error);
  if (Clock::now() - said_ > kMessageStays) report_.message.clear();

  gui_.begin_frame();
  if (show_panel_) {
    const PanelChanges changes = draw_panel(report_, scene_, panel_);
    if (changes.scene) request_world();
    if (changes.copy_camera) copy_camera();
    if (changes.save_scene) save_scene();
  }
  name_label();
  if (report_.pick && input_.pointer) draw_pick(*report_.pick, *input_.pointer);
  if (show_help_) draw_help(settings_.audience.has_value());
  if (!report_.message.empty()) draw_message(report_.message);
  gui_.end_frame();
}

void Viewer::wait_for_refresh() const {
  const std::chrono::duration<double> period(1.0 / window_.refresh_rate_hz());
  std::this_thread::sleep_until(last_frame_start_ + period);
}

}  // namespace swell::view
