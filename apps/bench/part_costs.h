// swell-bench frame --parts: what the parts of a picture cost, by frames without them.
#pragma once

#include <string>
#include <vector>

#include "apps/shared/json.h"
#include "apps/shared/options.h"

namespace swell::apps {

struct PartCost {
  std::string_view part;
  // Median over the frames of the whole frame's time less that without the part: what one frame
  // alone says is noise.
  double ms = 0.0;
  bool changes_picture = false;  // of the last frame
};
struct PartReport {
  std::string scene;
  PictureSize size;
  int threads = 0;
  double frame_ms = 0.0;  // median, of whole frames
  std::vector<PartCost> costs;
};

// Draws each of `frames` frames whole and without each part that setup.frame does not leave out
// already, by turns.
PartReport measure_parts(const FrameSetup& setup, const render::World& world, int warm_up,
                         int frames);

std::string parts_text(const PartReport& report);
Json parts_json(const PartReport& report);

}  // namespace swell::apps
