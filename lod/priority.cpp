#include "lod/priority.h"

#include <algorithm>
#include <bit>
#include <cmath>

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

// Returns the interval relative to a point, which is given as its floor and the rest.
Interval relative(LatticeInterval i, int point_floor, float point_fraction) {
  return {static_cast<float>(i.low - point_floor) - point_fraction,
          static_cast<float>(i.high - point_floor) - point_fraction};
}

float distance_to(Interval i) { return std::max(std::max(i.low, -i.high), 0.0f); }

// The products of members of two intervals.
Interval product(Interval a, Interval b) {
  const float p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}

// What the surface in a box can be: slopes along x and y, and z relative to the eye.
struct Relief {
  Interval slope_x, slope_y, z;
};

Relief relief_in(const PriorityFrame& frame, LatticeInterval x, LatticeInterval y, int level) {
  const ReliefFrame& relief = frame.relief;
  const float most = relief.max_slope;
  if (relief.cells.empty()) return {{-most, most}, {-most, most}, {relief.z_low, relief.z_high}};
  const int q = relief_level_of(level, relief.levels), shift = frame.lattice_bits - q;
  ReliefCell bound = relief.cells[static_cast<std::size_t>(
      relief_level_begin(q) + ((y.low >> shift) << q) + (x.low >> shift))];
  for (const int j : {y.low >> shift, (y.high - 1) >> shift}) {
    for (const int i : {x.low >> shift, (x.high - 1) >> shift}) {
      const auto number = static_cast<std::size_t>(relief_level_begin(q) + (j << q) + i);
      const ReliefCell& cell = relief.cells[number];
      for (std::size_t c = 0; c < 4; ++c) bound.slope[c] = std::max(bound.slope[c], cell.slope[c]);
      for (std::size_t c = 0; c < 2; ++c)
        bound.height[c] = std::max(bound.height[c], cell.height[c]);
    }
  }
  const auto slope = [&](std::size_t c) {
    return static_cast<float>(bound.slope[c]) * relief.slope_unit;
  };
  const auto height = [&](std::size_t c) {
    return static_cast<float>(bound.height[c]) * relief.height_unit;
  };
  return {{-slope(1), slope(0)},
          {-slope(3), slope(2)},
          {-height(1) - relief.eye_z, height(0) - relief.eye_z}};
}

// How much further away than it is a part with this relief counts, squared.
float relief_factor(const ReliefFrame& frame, const Relief& relief, Interval x, Interval y) {
  const Interval along_x = product(relief.slope_x, x), along_y = product(relief.slope_y, y);
  const float facing_most = (along_x.high + along_y.high) - relief.z.low;
  const float facing_least = (along_x.low + along_y.low) - relief.z.high;
  const bool silhouette = facing_least <= 0.0f && facing_most >= 0.0f;

  const float width =
      std::max(relief.slope_x.high - relief.slope_x.low, relief.slope_y.high - relief.slope_y.low);
  const float spread = std::min(width * kInvFullSpread, 1.0f);
  const float flat = 1.0f + frame.flat_gain * (1.0f - spread);
  return (facing_most < 0.0f ? frame.back_facing : 1.0f) *
         (silhouette ? 1.0f : frame.off_silhouette) *
         (relief.z.high < -frame.eye_z ? frame.sunken : 1.0f) * (flat * flat);
}

// (1 + d / (8 D))^16
float haze_factor(float distance, float inv_haze) {
  const float q = 1.0f + std::min(distance * inv_haze, kMostHaze);
  const float q2 = q * q, q4 = q2 * q2, q8 = q4 * q4;
  return q8 * q8;
}

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

float power_of_two(int exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
}

}  // namespace

double distance_of_largest(const PriorityFrame& frame, PriorityKey key) {
  if (!(frame.least_inv_size2 > 0.0f) || key >= kCulledKey)
    return std::numeric_limits<double>::infinity();
  const double clear =
      std::sqrt(static_cast<double>(std::bit_cast<float>(key)) / frame.least_inv_size2);
  if (!(frame.inv_haze > 0.0f)) return clear;
  // d (1 + d / (8 D))^8 = clear has one root; it lies in [0, clear].
  double low = 0.0, high = clear;
  for (int i = 0; i < 40; ++i) {
    const double d = 0.5 * (low + high);
    const double hazy = std::sqrt(haze_factor(static_cast<float>(d), frame.inv_haze));
    (d * hazy < clear ? low : high) = d;
  }
  return low;
}

PriorityKey priority_key(const PriorityFrame& frame, int x, int y, int level) {
  const int half = subtree_half_size(frame.lattice_bits, level), n = 1 << frame.lattice_bits;
  const LatticeInterval box_x = subtree_interval(x, half, n), box_y = subtree_interval(y, half, n);
  const Interval ix = relative(box_x, frame.eye_floor.x, frame.eye_fraction.x);
  const Interval iy = relative(box_y, frame.eye_floor.y, frame.eye_fraction.y);

  const float far_x = std::max(-ix.low, ix.high), far_y = std::max(-iy.low, iy.high);
  const float most_drop = (far_x * far_x + far_y * far_y) * frame.drop_per_step2;
  for (const PriorityFrame::Plane& plane : frame.planes) {
    const float most_x = std::max(plane.nx * ix.low, plane.nx * ix.high);
    const float most_y = std::max(plane.ny * iy.low, plane.ny * iy.high);
    const float most_z = most_drop * plane.by_drop + plane.max_z;
    if ((most_x + most_y) + most_z < 0.0f) return kCulledKey;
  }

  const float dx = distance_to(ix), dy = distance_to(iy);
  const bool with_relief = frame.has_factors && frame.relief.counts;
  const Relief relief = with_relief ? relief_in(frame, box_x, box_y, level) : Relief{};
  const float dz = distance_to(relief.z);
  const float horizontal2 = dx * dx + dy * dy;
  if (horizontal2 > frame.horizon2) return kCulledKey;
  const float distance2 = horizontal2 + (with_relief ? dz * dz : frame.distance2_z);
  const float inv_size2 = std::max(power_of_two(level & frame.level_mask), frame.least_inv_size2);
  const float inv_curved2 = power_of_two(level + level) * frame.curvature_inv_size2;
  float key = distance2 * std::min(inv_size2, inv_curved2);
  if (frame.has_factors) {
    if (with_relief) key *= relief_factor(frame.relief, relief, ix, iy);
    if (frame.inv_haze > 0.0f) key *= haze_factor(std::sqrt(distance2), frame.inv_haze);
    if (touches_a_focus(frame.focus, box_x, box_y, level)) key *= frame.focus.factor;
    key = std::min(key, kLastKey);
  }
  return std::bit_cast<PriorityKey>(key);
}

}  // namespace swell::lod
