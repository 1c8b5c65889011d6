#include "render/labels/labels.h"

#include <cmath>
#include <limits>

namespace swell::render {
namespace {

// Returns the ray through a pixel's centre with depth 1: View::ray in doubles.
glm::dvec3 ray_of(const View& view, int x_px, int y_px) {
  const double x = (2.0 * x_px + 1.0) / view.width_px - 1.0;
  const double y = 1.0 - (2.0 * y_px + 1.0) / view.height_px;
  const glm::dvec3 right(view.right), up(view.up), forward(view.forward);
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
  return static_cast<double>(depth_m) * glm::length(ray_of(view, x_px, y_px));
}

}  // namespace swell::render
