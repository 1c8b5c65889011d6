// What a coast's wave trains are, as maps.
#pragma once

#include <vector>

#include "ocean/coast/coast_map.h"

namespace swell::render {

// Points a side of the maps that lie over a coast's square.
inline constexpr int kCoastMapSize = 256;

// Over a coast's square, kCoastMapSize points a side.
struct CoastMaps {
  ocean::CoastMap waves;
  std::vector<float> ceded;  // what the sea's own waves give up to the trains, in [0, 1]
};

}  // namespace swell::render
