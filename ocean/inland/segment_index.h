// Which segments lie near a place: lists by the cells of a square grid.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::ocean {

struct Segment {
  glm::dvec2 a{0.0}, b{0.0};  // world x, y [m]
  double reach_m = 1.0;       // places further away do not ask for it
};

// Where on a segment is nearest to p, from a at 0 to b at 1, and how far away.
struct SegmentPoint {
  double t, distance_m;
};
SegmentPoint nearest_on(const Segment& segment, glm::dvec2 p);

// Made once, read by any thread.
class SegmentIndex {
 public:
  SegmentIndex() = default;
  // cell_m > 0. Memory: a number for each cell of the segments' bounding box, one for each segment
  // in each cell that it reaches.
  SegmentIndex(std::span<const Segment> segments, double cell_m);

  // The numbers of all segments that reach p, in rising order, and of some that do not.
  std::span<const std::uint32_t> near(glm::dvec2 p) const;

 private:
  glm::dvec2 corner_{0.0};
  double cell_m_ = 1.0;
  int cells_x_ = 0, cells_y_ = 0;
  std::vector<std::uint32_t> begin_;  // of each cell's list, and the end of the last
  std::vector<std::uint32_t> list_;
};

}  // namespace swell::ocean
