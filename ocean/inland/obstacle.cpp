#include "ocean/inland/obstacle.h"

#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr int kOutlinePoints = 64;
constexpr double kBoxMargin = 1.05;

glm::dvec2 across(const Obstacle& o) { return {o.ahead.y, -o.ahead.x}; }

}  // namespace

double sizes_from(const Obstacle& obstacle, glm::dvec2 p) {
  const glm::dvec2 way = p - obstacle.middle;
  const double x = glm::dot(way, across(obstacle)) / obstacle.half_m.x;
  const double y = glm::dot(way, obstacle.ahead) / obstacle.half_m.y;
  const double x2 = x * x, y2 = y * y;
  return std::sqrt(obstacle.is_round ? x2 + y2 : std::sqrt(x2 * x2 + y2 * y2));
}

double metres_outside(const Obstacle& obstacle, glm::dvec2 p) {
  const double sizes = sizes_from(obstacle, p);
  if (sizes < 1e-9) return -std::min(obstacle.half_m.x, obstacle.half_m.y);
  return (1.0 - 1.0 / sizes) * glm::distance(p, obstacle.middle);
}

std::vector<glm::dvec2> outline_of(const Obstacle& obstacle) {
  std::vector<glm::dvec2> points;
  for (int n = 0; n < kOutlinePoints; ++n) {
    const SinCos turn = sin_cos_turns((n + 0.5) / kOutlinePoints);
    const glm::dvec2 way = obstacle.half_m.x * turn.cos * across(obstacle) +
                           obstacle.half_m.y * turn.sin * obstacle.ahead;
    points.push_back(obstacle.middle + way / sizes_from(obstacle, obstacle.middle + way));
  }
  return points;
}

Obstacle widened(const Obstacle& obstacle, double by_m) {
  Obstacle wide = obstacle;
  const glm::dvec2 half = obstacle.half_m;
  if (!obstacle.is_round) {
    wide.half_m = half + kBoxMargin * by_m;
    return wide;
  }
  // The line at that distance has the support sqrt(h) + by_m with h = a^2 cos^2 + b^2 sin^2, and
  // sqrt(h) <= (h / m + m) / 2 for any m.
  const double m = std::sqrt(half.x * half.y);
  wide.half_m = glm::sqrt(half * half + by_m * (half * half / m + m) + by_m * by_m);
  return wide;
}

}  // namespace swell::ocean
