#include "lod/priority.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/diamond.h"
#include "math/check.h"

namespace swell::lod {
namespace {

constexpr double kFarSteps = 0x1p28;  // squared, times 2^40 levels: still a finite float

struct Interval {
  float low, high;  // relative to the eye
};

// The part of a diamond's subtree inside the domain, on one axis.
Interval subtree_interval(int centre, int half, int n, int eye_floor, float eye_fraction) {
  const int low = std::max(centre - half, 0), high = std::min(centre + half, n);
  return {static_cast<float>(low - eye_floor) - eye_fraction,
          static_cast<float>(high - eye_floor) - eye_fraction};
}

float distance_to(Interval i) { return std::max(std::max(i.low, -i.high), 0.0f); }

void check_request(const AdaptRequest& request) {
  const glm::dvec3 eye = request.view.eye_world;
  SWELL_CHECK(std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z),
              "eye=({}, {}, {})", eye.x, eye.y, eye.z);
  SWELL_CHECK(std::isfinite(request.min_height_m) && std::isfinite(request.max_height_m) &&
                  request.min_height_m <= request.max_height_m,
              "min_height_m={} max_height_m={}", request.min_height_m, request.max_height_m);
  SWELL_CHECK(std::isfinite(request.frustum_margin) && request.frustum_margin >= 0.0f,
              "frustum_margin={}", request.frustum_margin);
}

}  // namespace

PriorityFrame make_priority_frame(const AdaptRequest& request, const Domain& domain) {
  check_request(request);
  const double step_m = std::ldexp(domain.size_m, -domain.lattice_bits);
  const auto steps = [&](double metres) {
    return std::clamp(metres / step_m, -kFarSteps, kFarSteps);
  };

  PriorityFrame frame;
  frame.lattice_bits = domain.lattice_bits;
  frame.level_mask = request.priority == Priority::kProjectedSize ? -1 : 0;

  // The eye on the lattice.
  const glm::dvec3 eye = request.view.eye_world;
  const glm::dvec2 at(steps(eye.x - domain.min_world.x), steps(eye.y - domain.min_world.y));
  const glm::dvec2 whole = glm::floor(at);
  frame.eye_floor = glm::ivec2(whole);
  frame.eye_fraction = glm::vec2(at - whole);

  // The slab of heights.
  const Interval z{static_cast<float>(steps(request.min_height_m - eye.z)),
                   static_cast<float>(steps(request.max_height_m - eye.z))};
  frame.distance2_z = distance_to(z) * distance_to(z);

  // The near plane moves into the eye: what is nearer may still be displaced into view.
  View view = request.view;
  view.tan_half_x += request.frustum_margin;
  view.tan_half_y += request.frustum_margin;
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const glm::vec4& n = planes[i];
    SWELL_CHECK(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z),
                "plane={} normal=({}, {}, {})", i, n.x, n.y, n.z);
    frame.planes[i] = {n.x, n.y, std::max(n.z * z.low, n.z * z.high)};
  }
  return frame;
}

PriorityKey priority_key(const PriorityFrame& frame, int x, int y, int level) {
  const int half = subtree_half_size(frame.lattice_bits, level), n = 1 << frame.lattice_bits;
  const Interval ix = subtree_interval(x, half, n, frame.eye_floor.x, frame.eye_fraction.x);
  const Interval iy = subtree_interval(y, half, n, frame.eye_floor.y, frame.eye_fraction.y);

  for (const PriorityFrame::Plane& plane : frame.planes) {
    const float most_x = std::max(plane.nx * ix.low, plane.nx * ix.high);
    const float most_y = std::max(plane.ny * iy.low, plane.ny * iy.high);
    if ((most_x + most_y) + plane.max_z < 0.0f) return kCulledKey;
  }

  const float dx = distance_to(ix), dy = distance_to(iy);
  const float distance2 = (dx * dx + dy * dy) + frame.distance2_z;
  const int exponent = 127 + (level & frame.level_mask);
  return std::bit_cast<PriorityKey>(
      distance2 * std::bit_cast<float>(static_cast<std::uint32_t>(exponent) << 23));
}

}  // namespace swell::lod
