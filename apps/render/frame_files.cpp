#include "apps/render/frame_files.h"

#include <fmt/core.h>

#include <span>

#include "apps/render/label_sidecar.h"
#include "apps/shared/label_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/program.h"
#include "apps/shared/report.h"

namespace swell::apps {
namespace {

std::string file_name(const std::filesystem::path& path) { return path.filename().string(); }

void write_label_file(const RenderOptions& options, const DrawnFrame& frame) {
  const std::filesystem::path path = label_path(options, frame.frame);
  std::vector<LabelPlane> planes;
  if (path == picture_path(options, frame.frame)) planes = colour_planes(frame.target);
  for (LabelPlane& plane : label_planes(frame.target.labels, options.labels, frame.view))
    planes.push_back(std::move(plane));
  const texture::ExrAttribute attributes[] = {
      {"swell:version", version()},
      {"swell:scene_xxh3", scene_hash_text(frame.scene)},
      {"swell:picture_xxh3", fmt::format("{:016x}", frame.hash)},
      {"swell:frame", std::to_string(frame.frame)},
      {"swell:t_s", fmt::format("{}", frame.t_s)}};
  write_planes(path, frame.target.width_px, frame.target.height_px, planes, attributes);
}

void write_sidecar(const RenderOptions& options, const DrawnFrame& frame) {
  const std::filesystem::path path = label_path(options, frame.frame);
  const SidecarFrame facts = {frame.frame,     frame.t_s,
                              options.fps,     frame.hash,
                              file_name(path), file_name(picture_path(options, frame.frame))};
  write_text(sidecar_path(path).string(),
             label_sidecar(facts, frame.view, frame.scene, options.setup.scene_path, options.labels,
                           options.command_line));
}

}  // namespace

void write_frame_files(const RenderOptions& options, const DrawnFrame& frame) {
  const render::Target& target = frame.target;
  const int k = frame.frame;
  const bool has_labels = !options.labels.empty();
  const std::filesystem::path picture = picture_path(options, k);
  if (!picture.empty() && !(has_labels && picture == label_path(options, k)))
    write_picture(target, picture);
  if (has_labels) {
    write_label_file(options, frame);
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
