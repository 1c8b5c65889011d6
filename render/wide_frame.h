// Frames of wide cameras (math/projection.h): drawn as several perspective pictures of one moment,
// which are then put together.
#pragma once

#include <vector>

#include "render/frame.h"
#include "render/picture/wide_plan.h"

namespace swell::render {

// What a wide frame is put together from. It may be used again for another.
struct WideFrame {
  WidePlan plan;  // kept while frames have the same projection and size
  std::vector<Target> faces;
  std::vector<std::vector<View>> exposed;  // the views of a face in moments
};

// The frames of the faces, each drawn into one of wide.faces: with linear light and without noise.
std::vector<FrameRequest> face_requests(const scene::Scene& scene, const FrameRequest& request,
                                        WideFrame& wide, Workers& workers);

// Puts the drawn faces together into the frame's target.
void finish_wide(const FrameRequest& request, const WideFrame& wide,
                 const scene::SensorNoise& noise, double t_s, Workers& workers);

}  // namespace swell::render
