#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/diamond.h"
#include "lod/priority.h"
#include "math/check.h"

namespace swell::lod {
namespace {

constexpr double kFarSteps = 0x1p28;  // squared, times 2^40 levels: still a finite float

void check_request(const AdaptRequest& request) {
  const glm::dvec3 eye = request.view.eye_world;
  SWELL_CHECK(std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z),
              "eye=({}, {}, {})", eye.x, eye.y, eye.z);
  SWELL_CHECK(std::isfinite(request.min_height_m) && std::isfinite(request.max_height_m) &&
                  request.min_height_m <= request.max_height_m,
              "min_height_m={} max_height_m={}", request.min_height_m, request.max_height_m);
  SWELL_CHECK(request.least_size_px >= 0.0f, "least_size_px={}", request.least_size_px);
  SWELL_CHECK(request.largest_size_m > 0.0, "largest_size_m={}", request.largest_size_m);
  SWELL_CHECK(request.earth_radius_m > 0.0, "earth_radius_m={}", request.earth_radius_m);
  SWELL_CHECK(std::isfinite(request.frustum_margin) && request.frustum_margin >= 0.0f,
              "frustum_margin={}", request.frustum_margin);
}

void check_factors(const AdaptRequest& request) {
  const PriorityFactors& f = request.factors;
  SWELL_CHECK(f.focus_nearer >= 1.0f && f.focus_nearer <= 64.0f, "focus_nearer={}", f.focus_nearer);
  for (const float times : {f.back_facing, f.flat, f.off_silhouette, f.sunken})
    SWELL_CHECK(times >= 1.0f && times <= 16.0f,
                "back_facing={} flat={} off_silhouette={} sunken={}", f.back_facing, f.flat,
                f.off_silhouette, f.sunken);
  SWELL_CHECK(f.haze_distance_m > 0.0f, "haze_distance_m={}", f.haze_distance_m);
  SWELL_CHECK(request.max_slope >= 0.0f && request.max_slope <= 1e6f, "max_slope={}",
              request.max_slope);
}

void check_focuses(const AdaptRequest& request) {
  SWELL_CHECK(request.focuses.size() <= kMaxFocuses, "focuses={}", request.focuses.size());
  for (const Focus& f : request.focuses) {
    SWELL_CHECK(std::isfinite(f.centre_m.x) && std::isfinite(f.centre_m.y) &&
                    std::isfinite(f.radius_m) && f.radius_m > 0.0,
                "centre_m=({}, {}) radius_m={}", f.centre_m.x, f.centre_m.y, f.radius_m);
  }
}

// From metres to lattice steps, clamped.
struct Lattice {
  double step_m;

  explicit Lattice(const Domain& domain) : step_m(domain.step_m()) {}

  double steps(double metres) const { return std::clamp(metres / step_m, -kFarSteps, kFarSteps); }
  glm::dvec2 steps(glm::dvec2 metres) const { return {steps(metres.x), steps(metres.y)}; }
};

void set_planes(const AdaptRequest& request, float z_low, float z_high, PriorityFrame& frame) {
  // The near plane moves into the eye: what is nearer may still be displaced into view.
  View view = request.view;
  view.tan_half_x += request.frustum_margin;
  view.tan_half_y += request.frustum_margin;
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const glm::vec4& n = planes[i];
    SWELL_CHECK(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z),
                "plane={} normal=({}, {}, {})", i, n.x, n.y, n.z);
    frame.planes[i] = {n.x, n.y, std::max(n.z * z_low, n.z * z_high), std::max(-n.z, 0.0f)};
  }
}

// How the surface bends away, and how far one sees over its lowest part to its highest.
void set_earth(const AdaptRequest& request, const Domain& domain, PriorityFrame& frame) {
  const double radius_m = request.earth_radius_m, step_m = domain.step_m();
  if (!std::isfinite(radius_m)) return;
  frame.drop_per_step2 = static_cast<float>(step_m / (2.0 * radius_m));
  const double low_m = request.min_height_m, high_m = request.max_height_m;
  const double horizon_m =
      std::sqrt(2.0 * radius_m) *
      (std::sqrt(std::max(request.view.eye_world.z - low_m, 0.0)) + std::sqrt(high_m - low_m));
  frame.horizon2 = static_cast<float>((horizon_m / step_m) * (horizon_m / step_m));
  if (request.priority != Priority::kProjectedSize) return;
  const double slope = std::max(static_cast<double>(request.max_slope), 0.02);
  const double of_domain = kCurvatureCounts * domain.size_m / (4.0 * radius_m * slope);
  frame.curvature_inv_size2 = static_cast<float>(1.0 / (of_domain * of_domain));
}

// The deepest level of diamonds of a lattice of 2^bits steps that are wider than `width` steps:
// 2^bits sqrt(2^-level) > width; -1 if there is none.
int last_level_wider_than(int lattice_bits, double width) {
  int level = -1;
  while (level + 1 < level_count(lattice_bits) &&
         std::ldexp(1.0, 2 * lattice_bits - (level + 1)) > width * width)
    ++level;
  return level;
}

void set_relief(const AdaptRequest& request, double step_m, ReliefFrame& relief) {
  const PriorityFactors& f = request.factors;
  relief.counts = request.relief || f.back_facing > 1.0f || f.flat > 1.0f ||
                  f.off_silhouette > 1.0f || f.sunken > 1.0f;
  relief.back_facing = f.back_facing * f.back_facing;
  relief.off_silhouette = f.off_silhouette * f.off_silhouette;
  relief.sunken = f.sunken * f.sunken;
  relief.flat_gain = f.flat - 1.0f;
  relief.max_slope = request.max_slope;
  if (!request.relief) return;
  relief.cells = request.relief->cells();
  relief.levels = request.relief->levels();
  relief.slope_unit = request.relief->slope_unit();
  relief.height_unit = static_cast<float>(request.relief->height_unit_m() / step_m);
}

void set_focuses(const AdaptRequest& request, const Domain& domain, FocusFrame& focus) {
  const Lattice lattice(domain);
  const float nearer = request.factors.focus_nearer;
  focus.count = static_cast<int>(request.focuses.size());
  focus.factor = 1.0f / (nearer * nearer);
  glm::dvec2 low(kFarSteps), high(-kFarSteps);
  for (std::size_t i = 0; i < request.focuses.size(); ++i) {
    const glm::dvec2 centre = lattice.steps(request.focuses[i].centre_m - domain.min_world);
    const double radius = lattice.steps(request.focuses[i].radius_m);
    const glm::dvec2 whole = glm::floor(centre);
    focus.centre_floor[i] = glm::ivec2(whole);
    focus.centre_fraction[i] = glm::vec2(centre - whole);
    focus.radius2[i] = static_cast<float>(radius) * static_cast<float>(radius);
    focus.last_level[i] = last_level_wider_than(domain.lattice_bits, radius / 4.0);
    low = glm::min(low, glm::floor(centre - radius));
    high = glm::max(high, glm::ceil(centre + radius));
  }
  focus.low = glm::ivec2(low), focus.high = glm::ivec2(high);
}

// Of diamonds that look as wide as the request's least size. In lattice steps and sizes of the
// domain, as keys are.
PriorityKey end_key(const AdaptRequest& request, const Domain& domain) {
  if (!(request.least_size_px > 0.0f)) return kCulledKey;
  const double pixel = 2.0 * request.view.tan_half_y / request.view.height_px;  // tangent
  const double distance_over_size =
      std::ldexp(1.0 / (pixel * request.least_size_px), domain.lattice_bits);
  return std::bit_cast<PriorityKey>(
      std::min(static_cast<float>(distance_over_size * distance_over_size), kLastKey));
}

}  // namespace

PriorityFrame make_priority_frame(const AdaptRequest& request, const Domain& domain) {
  check_request(request);
  check_factors(request);
  check_focuses(request);
  const Lattice lattice(domain);
  PriorityFrame frame;
  frame.lattice_bits = domain.lattice_bits;
  if (request.priority == Priority::kProjectedSize) {
    const double sizes = domain.size_m / std::max(request.largest_size_m, lattice.step_m);
    frame.least_inv_size2 = static_cast<float>(sizes * sizes);
    frame.end_key = end_key(request, domain);
  } else {
    frame.level_mask = 0;
  }

  // The eye on the lattice.
  const glm::dvec3 eye = request.view.eye_world;
  const glm::dvec2 at = lattice.steps(glm::dvec2(eye) - domain.min_world);
  const glm::dvec2 whole = glm::floor(at);
  frame.eye_floor = glm::ivec2(whole);
  frame.eye_fraction = glm::vec2(at - whole);

  // The slab of heights.
  const auto z_low = static_cast<float>(lattice.steps(request.min_height_m - eye.z));
  const auto z_high = static_cast<float>(lattice.steps(request.max_height_m - eye.z));
  const float z_distance = std::max(std::max(z_low, -z_high), 0.0f);
  frame.distance2_z = z_distance * z_distance;

  set_planes(request, z_low, z_high, frame);
  set_earth(request, domain, frame);
  set_relief(request, lattice.step_m, frame.relief);
  frame.relief.z_low = z_low, frame.relief.z_high = z_high;
  frame.relief.eye_z = static_cast<float>(lattice.steps(eye.z));
  const double haze_steps = request.factors.haze_distance_m / lattice.step_m;
  frame.inv_haze = static_cast<float>(1.0 / std::max(8.0 * haze_steps, 1e-9));
  set_focuses(request, domain, frame.focus);
  frame.has_factors = frame.relief.counts || frame.inv_haze > 0.0f || frame.focus.count > 0;
  return frame;
}

}  // namespace swell::lod
