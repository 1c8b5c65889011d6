// The files of a frame: the picture, its labels, what stands beside them.
#pragma once

#include "apps/render/render_options.h"
#include "math/view.h"
#include "render/frame.h"

namespace swell::apps {

// A frame as it was drawn: the view and the target are those of render_frame().
struct DrawnFrame {
  int frame = 0;
  double t_s = 0.0;
  std::uint64_t hash = 0;
  const std::string& scene_hash;  // scene_hash_text()
  const scene::Scene& scene;
  const View& view;
  const render::Target& target;
};

// Writes every file of the frame's own that the options ask for, each whole or not there. Throws
// texture::FileError.
void write_frame_files(const RenderOptions& options, const DrawnFrame& frame);

}  // namespace swell::apps
