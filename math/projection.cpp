#include "math/projection.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"

namespace swell {
namespace {

constexpr int kSteps = 60;  // of a search that halves its interval at worst

// The angle with that radius, which is at most that of half_fov_rad.
double fisheye_angle(const Projection& lens, double radius) {
  double low = 0.0, high = lens.half_fov_rad;
  double theta = std::min(radius, high);
  for (int step = 0; step < kSteps; ++step) {
    const double off = fisheye_radius(lens.bend, theta) - radius;
    (off > 0.0 ? high : low) = theta;
    double next = theta - off / fisheye_radius_slope(lens.bend, theta);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - theta) < 1e-15) return next;
    theta = next;
  }
  return theta;
}

std::optional<glm::dvec3> fisheye_ray(const Projection& lens, glm::dvec2 p_px) {
  const glm::dvec2 p((p_px.x - lens.k.cx) / lens.k.fx, (p_px.y - lens.k.cy) / lens.k.fy);
  const double radius = glm::length(p);
  if (radius == 0.0) return glm::dvec3(0.0, 0.0, 1.0);
  if (radius > fisheye_radius(lens.bend, lens.half_fov_rad)) return std::nullopt;
  const double theta = fisheye_angle(lens, radius);
  const double across = sin(theta) / radius;
  return glm::dvec3(p.x * across, p.y * across, cos(theta));
}

std::optional<glm::dvec2> fisheye_place(const Projection& lens, glm::dvec3 ray) {
  const double across = std::sqrt(ray.x * ray.x + ray.y * ray.y);
  const double theta = atan2(across, ray.z);
  if (theta > lens.half_fov_rad) return std::nullopt;
  // Straight back is the whole rim of a cone of 360 degrees.
  const double scale = across > 0.0 ? fisheye_radius(lens.bend, theta) / across : 0.0;
  if (across == 0.0 && ray.z < 0.0) return std::nullopt;
  return glm::dvec2(lens.k.cx + lens.k.fx * scale * ray.x, lens.k.cy + lens.k.fy * scale * ray.y);
}

}  // namespace

double fisheye_radius(const std::array<double, 4>& bend, double theta_rad) {
  const auto [k1, k2, k3, k4] = bend;
  const double t2 = theta_rad * theta_rad;
  return theta_rad * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))));
}

double fisheye_radius_slope(const std::array<double, 4>& bend, double theta_rad) {
  const auto [k1, k2, k3, k4] = bend;
  const double t2 = theta_rad * theta_rad;
  return 1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * 9.0 * k4)));
}

bool is_one_to_one(const std::array<double, 4>& bend, double half_fov_rad) {
  constexpr int kAngles = 4096;
  for (int i = 0; i <= kAngles; ++i)
    if (!(fisheye_radius_slope(bend, half_fov_rad * i / kAngles) > 0.0)) return false;
  return true;
}

Projection fisheye_of_fov(double fov_rad, const std::array<double, 4>& bend, int width_px,
                          int height_px) {
  SWELL_CHECK(fov_rad > 0.0 && fov_rad <= kTwoPi, "fov_rad={}", fov_rad);
  const double half = 0.5 * fov_rad;
  const double focal_px = 0.5 * std::min(width_px, height_px) / fisheye_radius(bend, half);
  return {.kind = ProjectionKind::kFisheye,
          .k = {focal_px, focal_px, 0.5 * width_px, 0.5 * height_px},
          .bend = bend,
          .half_fov_rad = half};
}

std::optional<glm::dvec3> ray_at(const Projection& projection, glm::ivec2 size_px,
                                 glm::dvec2 p_px) {
  SWELL_CHECK(projection.is_wide(), "a perspective projection");
  if (projection.kind == ProjectionKind::kFisheye) return fisheye_ray(projection, p_px);
  const SinCos longitude = sin_cos_turns(p_px.x / size_px.x - 0.5);
  const SinCos latitude = sin_cos_turns(0.25 - 0.5 * p_px.y / size_px.y);
  return glm::dvec3(latitude.cos * longitude.sin, -latitude.sin, latitude.cos * longitude.cos);
}

std::optional<glm::dvec2> place_of(const Projection& projection, glm::ivec2 size_px,
                                   glm::dvec3 ray) {
  SWELL_CHECK(projection.is_wide(), "a perspective projection");
  if (projection.kind == ProjectionKind::kFisheye) return fisheye_place(projection, ray);
  const double longitude = atan2(ray.x, ray.z);
  const double latitude = atan2(-ray.y, std::sqrt(ray.x * ray.x + ray.z * ray.z));
  return glm::dvec2(size_px.x * (0.5 + longitude / kTwoPi), size_px.y * (0.5 - latitude / kPi));
}

}  // namespace swell
