#pragma once

#include "ocean/open_sea/sea.h"

namespace swell::ocean {

// A frame of its own, not one that an earlier time was written to.
inline SeaFrame frame_at(const Sea& sea, double t_s, int threads = 1) {
  Workers workers(threads);
  SeaFrame frame;
  advance(sea, t_s, frame, workers);
  return frame;
}

}  // namespace swell::ocean
