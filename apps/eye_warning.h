// A warning where a picture cannot be what was meant.
#pragma once

#include "render/frame.h"

namespace swell::apps {

// Prints one line 'warning: ...' on standard error for the first frame whose eye is below the
// water or the ground, which are drawn from above alone.
class EyeWarning {
 public:
  // After a frame: `frame` is its number, world, view and workspace are the frame's.
  void look(int frame, const render::World& world, const View& view,
            const render::Workspace& workspace);

 private:
  bool was_given_ = false;
};

}  // namespace swell::apps
