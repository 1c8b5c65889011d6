// What the programs tell on standard error besides errors: what takes long, and where a picture
// cannot be what was meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/frame.h"

namespace swell::apps {

// Which scene a program is to take: a file, and settings that change it (scene/settings.h).
struct SceneChoice {
  std::string path;
  std::vector<std::string> settings;
};

// Reads a scene; prints one line 'note: ...' if making it ready will take a second or more. Throws
// as scene::load_scene does.
scene::Scene load_scene(const SceneChoice& choice);

// Refuses a scene with a wide camera for what shows perspective pictures alone.
void check_perspective(const scene::Scene& scene, std::string_view what);

// Prints one line 'warning: ...' on standard error for the first frame whose eye is below the
// ground, which is drawn from above alone.
class EyeWarning {
 public:
  // After a frame: `frame` is its number, world, view and workspace are the frame's.
  void look(int frame, const render::World& world, const View& view,
            const render::Workspace& workspace);

 private:
  bool was_given_ = false;
};

}  // namespace swell::apps
