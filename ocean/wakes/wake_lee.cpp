#include "ocean/wakes/wake_lee.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swell::ocean {
namespace {

float distance2(glm::vec2 a, glm::vec2 b) { return glm::dot(a - b, a - b); }

// The place of the nearest source to p, in the window.
glm::vec2 nearest_source(const WakeWindow& window, glm::vec2 p) {
  glm::vec2 nearest = p;
  float least = std::numeric_limits<float>::infinity();
  const auto look_at = [&](glm::vec2 q) {
    if (distance2(p, q) < least) least = distance2(p, q), nearest = q;
  };
  for (const WakeStretch& s : window.stretches) {
    const glm::vec2 now(s.x_m, s.y_m), velocity(s.u_mps, s.v_mps);
    const float age_s = glm::dot(now - p, velocity) / glm::dot(velocity, velocity);
    look_at(now - std::clamp(age_s, s.from_s, s.to_s) * velocity);
  }
  for (const WakeRing& ring : window.rings) look_at({ring.x_m, ring.y_m});
  return nearest;
}

// How far the line from a to b keeps from the shore, below 0 where it meets land. In steps as long
// as the shore is far.
float least_distance_m(const terrain::ShoreMap& shore, glm::dvec2 a, glm::dvec2 b, float step_m) {
  const double length_m = glm::length(b - a);
  const glm::dvec2 along = (b - a) / std::max(length_m, 1e-6);
  float least = std::numeric_limits<float>::infinity();
  double s_m = 0.0;
  while (true) {
    const glm::dvec2 p = a + along * std::min(s_m, length_m);
    const float here_m = shore.sample(p.x, p.y).signed_distance_m;
    least = std::min(least, here_m);
    if (s_m >= length_m || least < -2.0f * step_m) return least;
    s_m += std::max(here_m, step_m);
  }
}

float lee_spacing_m(const WakeWindow& window) {
  return static_cast<float>(window.length_m * kLeeSpacing / kWakeSamples);
}

}  // namespace

void size_lee(const terrain::ShoreMap* shore, const WakeWindow& window) {
  window.lee.clear();
  if (!shore || !shore->has_line()) return;
  const glm::dvec2 middle = window.corner_m + 0.5 * window.length_m;
  const float reach_m = 0.75f * static_cast<float>(window.length_m);
  if (shore->sample(middle.x, middle.y).signed_distance_m > reach_m) return;
  window.lee.resize(kLeePoints * kLeePoints);
}

void find_lee(const terrain::ShoreMap& shore, std::size_t j, const WakeWindow& window) {
  const float spacing_m = lee_spacing_m(window);
  for (std::size_t i = 0; i < kLeePoints; ++i) {
    const glm::vec2 p = spacing_m * glm::vec2(i, j);
    const glm::vec2 source = nearest_source(window, p);
    const glm::dvec2 from = window.corner_m + glm::dvec2(source);
    const bool is_inland = shore.sample(from.x, from.y).signed_distance_m < 0.0f;
    const glm::dvec2 to = window.corner_m + glm::dvec2(p);
    const float clear_m = is_inland ? 0.0f : least_distance_m(shore, from, to, 0.5f * spacing_m);
    window.lee[j * kLeePoints + i] = std::clamp(1.0f + clear_m / spacing_m, 0.0f, 1.0f);
  }
}

void put_in_lee(const WakeWindow& window, std::size_t j, std::span<float> row) {
  if (window.lee.empty()) return;
  constexpr float kPart = 1.0f / kLeeSpacing;
  const float y = kPart * static_cast<float>(j % kLeeSpacing);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const float x = kPart * static_cast<float>(i % kLeeSpacing);
    const float* const at = &window.lee[j / kLeeSpacing * kLeePoints + i / kLeeSpacing];
    const float low = at[0] + x * (at[1] - at[0]);
    const float high = at[kLeePoints] + x * (at[kLeePoints + 1] - at[kLeePoints]);
    row[i] *= low + y * (high - low);
  }
}

}  // namespace swell::ocean
