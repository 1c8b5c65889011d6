// What a frame is drawn into.
#pragma once

#include <cstdint>
#include <vector>

#include "render/labels/labels.h"

namespace swell::render {

// The finished picture. Sized by render_frame; capacity is kept.
struct Target {
  int width_px = 0, height_px = 0;
  std::vector<std::uint32_t> rgba;  // 8-bit sRGB, R in the low byte, alpha 255; row by row
  std::vector<float> linear;        // RGB light before the tone curve, if asked for; noise: < 0 too
  float exposure = 1.0f;            // what that is multiplied by to be shown
  Labels labels;                    // as asked for
};

}  // namespace swell::render
