// The JSON file beside a file of labels: what a program needs to use them without the scene.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "math/view.h"
#include "render/labels/label_channels.h"
#include "scene/scene.h"

namespace swell::apps {

// A frame as it was drawn.
struct SidecarFrame {
  int frame = 0;
  double t_s = 0.0, fps = 0.0;
  std::uint64_t hash = 0;    // render::picture_hash
  std::string labels_file;   // names without folders: the file of labels
  std::string picture_file;  // empty: none
};

// docs/look_up/labels.md has the keys. Keys stand in a fixed order; bytes of names that are not
// UTF-8 become U+FFFD. `scene_path` is as given on the command line.
std::string label_sidecar(const SidecarFrame& frame, const View& view, const scene::Scene& scene,
                          const std::string& scene_path, render::LabelSet labels,
                          std::span<const std::string> command_line);

// XXH3-64 of scene::dump_scene's text, as 16 hex digits.
std::string scene_hash_text(const scene::Scene& scene);

}  // namespace swell::apps
