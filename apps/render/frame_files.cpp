#include "apps/render/frame_files.h"

#include <fmt/format.h>

#include <vector>

#include "apps/render/label_sidecar.h"
#include "apps/shared/label_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "apps/shared/report.h"
#include "apps/shared/version.h"

namespace swell::apps {
namespace {

std::string file_name(const std::filesystem::path& path) { return path.filename().string(); }

// As a shell takes it.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result(1, '\'');
  for (const char c : text) {
    if (c == '\'') result += "'\\'";
    result += c;
  }
  result += '\'';
  return result;
}

// This command is the same for a frame alone, in a sequence and in a part of one; so are its notes,
// and its sidecar but for the frame's number, fps and the names of files.
std::vector<std::string> command_of(const RenderOptions& options, const DrawnFrame& frame) {
  std::vector<std::string> command = options.frame_command;
  command.insert(command.end(), {"--time", fmt::format("{}", frame.t_s)});
  return command;
}

std::vector<texture::ImageNote> notes_of(const RenderOptions& options, const DrawnFrame& frame) {
  std::vector<std::string> command = command_of(options, frame);
  for (std::string& word : command) word = shell_word(word);
  return {{"swell:version", version()},
          {"swell:scene_xxh3", frame.scene_hash},
          {"swell:picture_xxh3", fmt::format("{:016x}", frame.hash)},
          {"swell:t_s", fmt::format("{}", frame.t_s)},
          {"swell:command", fmt::format("{}", fmt::join(command, " "))}};
}

void write_label_file(const RenderOptions& options, const DrawnFrame& frame,
                      std::vector<texture::ImageNote> notes) {
  const std::filesystem::path path = label_path(options, frame.frame);
  std::vector<LabelPlane> planes;
  if (path == picture_path(options, frame.frame)) planes = colour_planes(frame.target);
  for (LabelPlane& plane : label_planes(frame.target.labels, options.labels, frame.view))
    planes.push_back(std::move(plane));
  notes.push_back({"swell:frame", std::to_string(frame.frame)});
  write_planes(path, frame.target.width_px, frame.target.height_px, planes,
               {notes, options.exr_compression});
}

void write_sidecar(const RenderOptions& options, const DrawnFrame& frame) {
  const std::filesystem::path path = label_path(options, frame.frame);
  const SidecarFrame facts = {frame.frame,     frame.t_s,
                              options.fps,     frame.hash,
                              file_name(path), file_name(picture_path(options, frame.frame))};
  write_text(sidecar_path(path).string(),
             label_sidecar(facts, frame.view, frame.scene, options.setup.scene.path, options.labels,
                           command_of(options, frame)));
}

}  // namespace

void write_frame_files(const RenderOptions& options, const DrawnFrame& frame) {
  const render::Target& target = frame.target;
  const int k = frame.frame;
  const bool has_labels = !options.labels.empty() && !film_holds_labels(options);
  const std::vector<texture::ImageNote> notes = notes_of(options, frame);
  const std::filesystem::path picture = picture_path(options, k);
  if (!picture.empty() && !is_film(picture) && !(has_labels && picture == label_path(options, k)))
    write_picture(target, picture, {notes, options.exr_compression});
  if (has_labels) {
    write_label_file(options, frame, notes);
    write_sidecar(options, frame);
  }
  if (!options.depth.empty())
    write_depth(numbered_path(options, options.depth, k), target.width_px, target.height_px,
                target.labels.depth_m);
  if (!options.ids.empty())
    write_ids(numbered_path(options, options.ids, k), target.width_px, target.height_px,
              target.labels.id);
}

}  // namespace swell::apps
