#include "render/labels/labels.h"

#include <cmath>
#include <limits>

#include "math/projection.h"

namespace swell::render {
namespace {

// Returns the ray through a pixel's centre with depth 1: View::ray in doubles; of wide views, whose
// depth is the distance, with length 1, and where they show nothing 0.
glm::dvec3 ray_of(const View& view, int x_px, int y_px) {
  const glm::dvec3 right(view.right), up(view.up), forward(view.forward);
  if (view.projection.is_wide()) {
    const glm::dvec3 ray =
        ray_at(view.projection, {view.width_px, view.height_px}, {x_px + 0.5, y_px + 0.5})
            .value_or(glm::dvec3(0.0));
    return right * ray.x - up * ray.y + forward * ray.z;
  }
  const double x = (2.0 * x_px + 1.0) / view.width_px - 1.0;
  const double y = 1.0 - (2.0 * y_px + 1.0) / view.height_px;
  return forward + right * (x * view.tan_half_x + view.tan_middle_x) +
         up * (y * view.tan_half_y + view.tan_middle_y);
}

}  // namespace

glm::dvec3 position_of(const View& view, int x_px, int y_px, float depth_m) {
  const glm::dvec3 ray = ray_of(view, x_px, y_px);
  if (std::isfinite(depth_m)) return view.eye_world + static_cast<double>(depth_m) * ray;
  const auto endless = [](double x) {
    return x == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), x);
  };
  return {endless(ray.x), endless(ray.y), endless(ray.z)};
}

double distance_of(const View& view, int x_px, int y_px, float depth_m) {
  if (view.projection.is_wide()) return static_cast<double>(depth_m);
  return static_cast<double>(depth_m) * glm::length(ray_of(view, x_px, y_px));
}

}  // namespace swell::render
