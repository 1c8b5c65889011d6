// A film as messages of ROS 2: what swell-sim records of a camera.
#pragma once

#include <memory>
#include <vector>

#include "apps/mcap/mcap_output.h"
#include "apps/render/frame_files.h"
#include "apps/render/render_options.h"

namespace swell::apps {

// FILE.mcap.partial until finish(), as mcap_output.h says; nothing where --out is no such film. Of
// each frame, at its time, in the camera's optical frame: /camera/image_raw, /camera/camera_info,
// of the labels that it holds
// /camera/LABEL, and on /tf the frame's pose in "map", which has the
// scene's axes. Throws texture::FileError.
class FilmFile {
 public:
  explicit FilmFile(const RenderOptions& options);

  void add(const DrawnFrame& frame);
  void finish();

 private:
  std::vector<render::Label> labels_;
  std::unique_ptr<McapOutput> output_;
};

}  // namespace swell::apps
