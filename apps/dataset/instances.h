// Objects in a picture as COCO has them, exactly from the labels of ids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swell::apps {

// The pixels of one id.
struct Instance {
  std::uint32_t id = 0;
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;  // their bounding box
  std::int64_t area_px = 0;                             // how many they are
  // Lengths of runs down the columns from the upper left corner on, of pixels that are not the
  // id's, that are, that are not, ... They add up to the picture.
  std::vector<std::int64_t> runs;
};

// Those of all ids in [first, end), by id. `ids` has width_px columns, row by row.
std::vector<Instance> find_instances(std::span<const std::uint32_t> ids, int width_px,
                                     std::uint32_t first, std::uint32_t end);

}  // namespace swell::apps
