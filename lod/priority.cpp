#include "lod/priority.h"

#include <algorithm>
#include <bit>

#include "lod/diamond.h"

namespace swell::lod {
namespace {

// The part of a diamond's subtree inside the domain, on one axis.
struct LatticeInterval {
  int low, high;
};

LatticeInterval subtree_interval(int centre, int half, int n) {
  return {std::max(centre - half, 0), std::min(centre + half, n)};
}

struct Interval {
  float low, high;
};

// The same relative to a point.
Interval relative(LatticeInterval i, int point_floor, float point_fraction) {
  return {static_cast<float>(i.low - point_floor) - point_fraction,
          static_cast<float>(i.high - point_floor) - point_fraction};
}

float distance_to(Interval i) { return std::max(std::max(i.low, -i.high), 0.0f); }

bool touches_a_focus(const FocusFrame& focus, LatticeInterval x, LatticeInterval y, int level) {
  if (x.low > focus.high.x || x.high < focus.low.x) return false;
  if (y.low > focus.high.y || y.high < focus.low.y) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(focus.count); ++i) {
    const glm::ivec2 whole = focus.centre_floor[i];
    const glm::vec2 fraction = focus.centre_fraction[i];
    const float dx = distance_to(relative(x, whole.x, fraction.x));
    const float dy = distance_to(relative(y, whole.y, fraction.y));
    if (dx * dx + dy * dy <= focus.radius2[i] && level <= focus.last_level[i]) return true;
  }
  return false;
}

}  // namespace

PriorityKey priority_key(const PriorityFrame& frame, int x, int y, int level) {
  const int half = subtree_half_size(frame.lattice_bits, level), n = 1 << frame.lattice_bits;
  const LatticeInterval box_x = subtree_interval(x, half, n), box_y = subtree_interval(y, half, n);
  const Interval ix = relative(box_x, frame.eye_floor.x, frame.eye_fraction.x);
  const Interval iy = relative(box_y, frame.eye_floor.y, frame.eye_fraction.y);

  for (const PriorityFrame::Plane& plane : frame.planes) {
    const float most_x = std::max(plane.nx * ix.low, plane.nx * ix.high);
    const float most_y = std::max(plane.ny * iy.low, plane.ny * iy.high);
    if ((most_x + most_y) + plane.max_z < 0.0f) return kCulledKey;
  }

  const float dx = distance_to(ix), dy = distance_to(iy);
  const float distance2 = (dx * dx + dy * dy) + frame.distance2_z;
  const int exponent = 127 + (level & frame.level_mask);
  float key = distance2 * std::bit_cast<float>(static_cast<std::uint32_t>(exponent) << 23);
  if (frame.focus.count > 0 && touches_a_focus(frame.focus, box_x, box_y, level))
    key *= frame.focus.factor;
  return std::bit_cast<PriorityKey>(key);
}

}  // namespace swell::lod
