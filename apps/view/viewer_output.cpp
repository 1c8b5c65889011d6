// What the viewer gives away: pictures, the scene, the camera.
#include <fmt/core.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "apps/shared/label_picture.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "apps/view/camera_text.h"
#include "apps/view/viewer.h"

namespace swell::view {
namespace {

namespace fs = std::filesystem;

void check_count(const fs::path& folder, int most) {
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    files += entry.path().filename().string().starts_with("swell_");
  if (files >= most)
    throw std::runtime_error(
        fmt::format("not saved: {} holds {} files, allowed {}", folder.string(), files, most));
}

// The first of swell_0001.png, swell_0002.png ... that does not exist, not even as a link that
// leads nowhere.
fs::path free_name(const ViewerSettings& settings, std::string_view extension) {
  const fs::path& folder = settings.output_folder;
  if (!folder.empty()) fs::create_directories(folder);
  if (settings.most_files > 0) check_count(folder.empty() ? "." : folder, settings.most_files);
  fs::path path;
  int number = 1;
  do path = folder / fmt::format("swell_{:04d}{}", number++, extension);
  while (fs::symlink_status(path).type() != fs::file_type::not_found);
  return path;
}

}  // namespace

render::Target Viewer::full_picture() {
  render::FrameOptions options = panel_.frame;
  options.lod_ms = 0.0;  // of refining
  options.disturbances = stones_;
  ask_for_label(options);
  render::Workspace workspace;
  render::Target picture;
  render::render_frame(*world_, drawn_.view, drawn_.time_s, options, workspace, picture, workers_);
  if (panel_.label) apps::paint_label(*panel_.label, picture.labels, drawn_.view, picture.rgba);
  return picture;
}

void Viewer::save_screenshot() {
  if (drawn_.count == 0) return;
  try {
    const fs::path path = free_name(settings_, ".png");
    apps::write_picture(full_picture(), path);
    say("wrote " + path.string());
  } catch (const std::exception& e) {  // a full disk must not end the flight
    say(e.what());
  }
}

void Viewer::copy_camera() {
  if (drawn_.count == 0) return;
  const bool is_copied = SDL_SetClipboardText(camera_text().c_str()) == 0;
  say(is_copied ? "copied the camera as TOML" : std::string("nothing copied: ") + SDL_GetError());
}

std::string Viewer::camera_text() const { return camera_toml(report_.camera, scene_.camera); }

std::string Viewer::scene_text() const {
  scene::Scene now = with_choice(scene_, panel_.scene);
  if (pose_) now.camera = camera_at(*pose_, scene_.camera);
  return scene::dump_scene(now);
}

void Viewer::save_scene() {
  try {
    const fs::path path = free_name(settings_, ".toml");
    apps::write_text(path.string(), scene_text());
    say("wrote " + path.string());
  } catch (const std::exception& e) {
    say(e.what());
  }
}

}  // namespace swell::view
