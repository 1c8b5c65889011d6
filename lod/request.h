// What a triangulation is asked for: a view, a budget and what matters.
#pragma once

#include <chrono>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "math/view.h"

namespace swell::lod {

// Formulas, and why a child never has more than its parents: lod/priority.h.
enum class Priority : std::uint8_t {
  kProjectedSize,    // bound of the triangle's size, or error, over its nearest distance (default)
  kInverseDistance,  // the paper's base variant: the nearest part to the last level first
};

// A disc in the plane where something lies on the surface, which must be finer there.
struct Focus {
  glm::dvec2 centre_m{0.0};  // world
  double radius_m = 1.0;     // > 0
};
inline constexpr int kMaxFocuses = 64;

class ReliefBounds;

// What else than place and size counts. Where several apply, they multiply.
struct PriorityFactors {
  // Where a focus is touched, and triangles are wider than a quarter of its radius, the eye counts
  // as this many times nearer: [1, 64].
  float focus_nearer = 8.0f;

  // Parts of the surface that count as so many times further away, each in [1, 16], 1: not at all.
  float back_facing = 1.0f;     // that turn their back to the eye, wholly
  float flat = 1.0f;            // whose normals do not differ (in part, if they differ a little)
  float off_silhouette = 1.0f;  // that turn no edge to the eye
  float sunken = 1.0f;          // that lie below height 0, wholly

  // Where haze leaves a share s = exp(-distance / haze_distance_m) of the contrast, priorities are
  // about s times as high. Infinity: clear air.
  float haze_distance_m = std::numeric_limits<float>::infinity();
};

// Ways to bound the work of one call. With any of them the mesh is valid and within the budget, but
// depends on the calls before too; calls with one request approach the mesh without limits.
struct AdaptLimits {
  // Splits and merges, the most important first; merges that the budget asks for come on top.
  int max_operations = std::numeric_limits<int>::max();
  // Few operations begin later. Other runs then give other meshes: for viewers alone.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  // Only one of so many groups of priorities is worked out anew in a call, in turn: >= 1.
  int priority_groups = 1;
};

struct AdaptRequest {
  View view;
  int triangle_budget = 10000;  // >= 2; never exceeded
  Priority priority = Priority::kProjectedSize;
  // Triangles wider than this are not further from the surface than these are, and kProjectedSize
  // counts them as this wide: half the mean wavelength for waves. > 0.
  double largest_size_m = std::numeric_limits<double>::infinity();
  // kProjectedSize: no triangle is split that looks narrower than this, as sizes count there, in
  // pixels at the picture's middle; 0: down to the last level.
  float least_size_px = 0.0f;
  float min_height_m = 0.0f, max_height_m = 0.0f;  // of all the surface, at all times
  // The surface sinks by r^2 / (2 earth_radius_m) at the horizontal distance r from the eye, and
  // what lies behind its own horizon gets priority 0. > 0; infinity: flat.
  double earth_radius_m = std::numeric_limits<double>::infinity();
  // Triangles outside the frustum, widened by this angle's tangent, get priority 0.
  float frustum_margin = 0.0f;
  PriorityFactors factors = {};
  // How high a part of the surface can be and which normals it can have: as the relief there says,
  // or between the heights above, with slopes of at most max_slope along each axis, at all times.
  const ReliefBounds* relief = nullptr;  // of the whole domain; outlives the next call
  float max_slope = 1.0f;
  std::span<const Focus> focuses = {};  // at most kMaxFocuses; read during the call only
  AdaptLimits limits = {};
};

}  // namespace swell::lod
