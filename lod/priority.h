// Which diamond matters most to a view.
//
// The priority of a diamond, in [0, 1], is 1 / sqrt(1 + k), with
//   kProjectedSize    k = (d / size)^2, d the distance from the eye to the box around the diamond
//                     and all its descendants (between the heights of the request, or of the relief
//                     there if there is one), size the
//                     diamond's width, here sqrt(2^-level) times the domain's, or the request's
//                     largest size if that is less
//   kInverseDistance  k = d^2: the paper's 1 / distance, whatever the size; it refines all of the
//                     nearest part to the last level first, and so suits lattices of few bits
// and 0 (k = infinity) if that box lies outside the view, or behind the horizon of a round earth.
// There a flat triangle of width s cuts off s^2 / (8 R'), which a horizon without waves shows. So
// for kProjectedSize a size counts for at least kCurvatureCounts s^2 / (4 R' slope): the width at
// which waves of the request's slope are missed by as much, times how much more it matters.
// k is then multiplied by what is asked for of the squares of these:
//   back_facing      if for all points p of the box (relative to the eye) and all normals
//                    n = (-sx, -sy, 1) of the surface in it n.(-p) = sx px + sy py - pz is < 0
//   off_silhouette   if that is < 0 for all or > 0 for all
//   sunken           if all of it lies below height 0
//   1 + (flat - 1) (1 - spread)   spread: width of the range of slopes in it over 0.5, at most 1
//   (1 + d / (8 D))^8             D the haze's distance: like exp(d / D), 6 % less at d = D
//   1 / focus_nearer if the box touches a focus and the diamond is wider than a quarter of the
//                    focus's radius
// Only the order counts, so k itself is kept: ascending k is descending priority. The bits of a
// float >= 0 sort like the float, and that word is the key.
//
// A child's key is never below its parent's, to the last bit. Boxes nest (exactly: they are
// integers), and so do ranges of slopes and heights (relief_bounds.h), hence the intervals of
// n.(-p), whose ends are the largest and least products of the ends of both; sizes shrink by powers
// of two; and every operation is correctly rounded and thus monotone: distances and factors never
// shrink from parent to child. With ties broken by level, parents come before children in the
// order, so the first n diamonds of the order are a valid triangulation for every n.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "lod/relief_bounds.h"
#include "lod/roam.h"

namespace swell::lod {

using PriorityKey = std::uint32_t;
inline constexpr PriorityKey kCulledKey = 0x7f800000u;  // infinity: priority 0, never split

// What the request says of normals. Unit: one lattice step.
struct ReliefFrame {
  bool counts = false;
  float back_facing = 1.0f, off_silhouette = 1.0f, sunken = 1.0f;  // of k
  float flat_gain = 0.0f;                                          // flat - 1
  // Everywhere, if there are no cells:
  float max_slope = 1.0f;
  float z_low = 0.0f, z_high = 0.0f;  // relative to the eye
  // Else, as of ReliefBounds:
  std::span<const ReliefCell> cells = {};
  int levels = 0;
  float slope_unit = 0.0f, height_unit = 0.0f;
  float eye_z = 0.0f;
};

// The focuses of a request. Unit: one lattice step.
struct FocusFrame {
  int count = 0;
  float factor = 1.0f;                                 // of k
  glm::ivec2 low{0}, high{0};                          // a box around all of them
  std::array<glm::ivec2, kMaxFocuses> centre_floor{};  // whole and fractional steps, as of the eye
  std::array<glm::vec2, kMaxFocuses> centre_fraction{};
  std::array<float, kMaxFocuses> radius2{};
  std::array<std::int32_t, kMaxFocuses> last_level{};  // of diamonds that are wide enough
};

// A request as seen from the lattice. Unit: one lattice step; z likewise.
struct PriorityFrame {
  int lattice_bits = 1;
  // The eye: whole and fractional lattice steps, so that float differences stay exact near it.
  glm::ivec2 eye_floor{0};
  glm::vec2 eye_fraction{0.0f};
  float distance2_z = 0.0f;  // squared distance from the eye to the slab of heights
  // Outside, if for one plane max(x n.x) + max(y n.y) + max_z < 0 over the box.
  struct Plane {
    float nx, ny, max_z;
    float by_drop;  // what a step of the box's sinking adds
  };
  std::array<Plane, 5> planes{};
  float drop_per_step2 = 0.0f;  // of a round earth, by the squared horizontal distance
  float horizon2 = std::numeric_limits<float>::infinity();  // of this no box is seen beyond
  int level_mask = -1;                                      // -1: sizes count; 0: they do not
  float least_inv_size2 = 0.0f;  // of the largest size, in units of the domain's
  // The size that counts for a round earth's curvature is this times 4^level, likewise.
  float curvature_inv_size2 = std::numeric_limits<float>::infinity();
  PriorityKey end_key = kCulledKey;  // from it on diamonds stay whole

  bool has_factors = false;  // any of these:
  ReliefFrame relief;
  float inv_haze = 0.0f;  // 1 / (8 D), per lattice step
  FocusFrame focus;
};

inline constexpr float kMostHaze = 2.0f;            // d / (8 D) counts to here
inline constexpr float kInvFullSpread = 2.0f;       // of slopes
inline constexpr float kLastKey = 0x1.fffffep127f;  // of diamonds in view
inline constexpr double kCurvatureCounts = 16.0;    // over waves that are missed by as much

// Checks that the request's numbers are finite, ordered and in their ranges. Distances
// beyond 2^28 lattice steps count as that.
PriorityFrame make_priority_frame(const AdaptRequest& request, const Domain& domain);

// The distance from the eye, in lattice steps, at which the largest size has this key; infinity
// without such a size.
double distance_of_largest(const PriorityFrame& frame, PriorityKey key);

// The key of the diamond centred at lattice point (x, y).
PriorityKey priority_key(const PriorityFrame& frame, int x, int y, int level);

// Computes priority_key() of many diamonds, bit for bit; all spans have one size. SIMD.
void compute_priority_keys(const PriorityFrame& frame, std::span<const std::int32_t> x,
                           std::span<const std::int32_t> y, std::span<const std::int32_t> level,
                           std::span<PriorityKey> keys);

}  // namespace swell::lod
