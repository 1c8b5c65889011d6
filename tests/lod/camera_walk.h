// Random requests: smooth flights with jumps, from inside the waves, below them, far off, looking
// away, with changing budgets, heights, focuses and factors. A pure function of the seed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lod/relief_bounds.h"
#include "lod/roam.h"
#include "math/random.h"

namespace swell::lod {

// Heights for a lattice of 2^bits steps of one metre: noise, flat, one spike, a cliff or hills.
inline std::vector<float> make_heights(int bits, std::uint64_t seed) {
  const int n = 1 << bits;
  std::vector<float> height_m;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const double noise = random_uniform(seed, static_cast<std::uint64_t>(y * (n + 1) + x));
      const double u = 2.0 * x / n - 1.0, v = 2.0 * y / n - 1.0;
      const double hills = n * (0.5 * u * u - 0.3 * v + u * v * v);
      const std::array<double, 5> kinds = {noise, 0.0, x == n / 2 && y == n / 4 ? n : 0.0,
                                           x < n / 3 ? 0.2 * n : 0.0, hills};
      height_m.push_back(static_cast<float>(kinds[seed % 5]));
    }
  }
  return height_m;
}

class CameraWalk {
 public:
  // `relief` outlives the walk's requests, or is null.
  CameraWalk(std::uint64_t seed, const Domain& domain, int max_budget, const ReliefBounds* relief)
      : seed_(seed),
        domain_(domain),
        max_budget_(max_budget),
        relief_(relief),
        budget_(std::min(100, max_budget)) {
    jump();
  }

  AdaptRequest next() {
    const double kind = uniform();
    if (kind < 0.12) {
      jump();
    } else {
      position_ += domain_.size_m * 0.01 * glm::dvec3(centred(), centred(), 0.3 * centred());
      heading_ += 0.3 * centred();
    }
    AdaptRequest request;
    const double pitch = kind > 0.95 ? 1.5 : kind > 0.9 ? -1.5 : -0.3 + 0.2 * centred();
    const double fov = kind < 0.02 ? 0.001 : kind < 0.04 ? 3.1 : 0.3 + 1.5 * uniform();
    request.view = make_view(position_, heading_, pitch, fov, 0.1f, 64, 48);
    request.frustum_margin = uniform() < 0.5 ? 0.0f : 0.2f;
    if (uniform() < 0.2) budget_ = new_budget();
    request.triangle_budget = budget_;
    if (uniform() < 0.1) height_ = static_cast<float>(domain_.size_m * 0.05 * uniform());
    request.min_height_m = -height_;
    request.max_height_m = height_;
    if (uniform() < 0.1) priority_ = other(priority_);
    request.priority = priority_;
    if (uniform() < 0.1) largest_size_m_ = 2.0 * domain_.size_m * std::pow(uniform(), 4.0);
    if (uniform() < 0.05) largest_size_m_ = std::numeric_limits<double>::infinity();
    request.largest_size_m = largest_size_m_;
    if (uniform() < 0.2) focuses_.clear();
    if (uniform() < 0.3) add_focuses();
    for (Focus& f : focuses_) f.centre_m += 0.3 * f.radius_m * glm::dvec2(centred(), centred());
    request.focuses = focuses_;  // until the next call
    if (uniform() < 0.15) choose_factors();
    request.factors = factors_;
    request.relief = uniform() < 0.8 ? relief_ : nullptr;
    request.max_slope = static_cast<float>(2.0 * uniform());
    if (uniform() < 0.1) earth_radius_m_ = domain_.size_m * std::pow(1000.0, uniform());
    if (uniform() < 0.1) earth_radius_m_ = std::numeric_limits<double>::infinity();
    request.earth_radius_m = earth_radius_m_;
    return request;
  }

 private:
  static Priority other(Priority p) {
    return p == Priority::kProjectedSize ? Priority::kInverseDistance : Priority::kProjectedSize;
  }
  double uniform() { return random_uniform(seed_, counter_++); }
  double centred() { return 2.0 * uniform() - 1.0; }

  void jump() {
    const double spread = uniform() < 0.1 ? 1e7 : uniform() < 0.2 ? 3.0 : 1.0;
    const double size = domain_.size_m;
    position_ = glm::dvec3(domain_.min_world + 0.5 * size, 0.0) +
                0.5 * size * spread * glm::dvec3(centred(), centred(), 0.2 * centred());
    if (uniform() < 0.1) position_.z = 40000.0;
    heading_ = 7.0 * uniform();
  }

  // None, each alone, or all together.
  void choose_factors() {
    const int which = static_cast<int>(8.0 * uniform());
    const auto is_on = [&](int factor) { return which == factor || which == 7; };
    const auto times = [&] { return static_cast<float>(1.0 + 15.0 * uniform() * uniform()); };
    factors_ = {.focus_nearer = is_on(1) ? times() : 1.0f,
                .back_facing = is_on(2) ? times() : 1.0f,
                .flat = is_on(3) ? times() : 1.0f,
                .off_silhouette = is_on(4) ? times() : 1.0f,
                .sunken = is_on(6) ? times() : 1.0f};
    if (is_on(5)) factors_.haze_distance_m = static_cast<float>(domain_.size_m * uniform());
  }

  void add_focuses() {
    const int count = uniform() < 0.1 ? kMaxFocuses : 1 + static_cast<int>(4.0 * uniform());
    focuses_.clear();
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 place(uniform() * 1.2 - 0.1, uniform() * 1.2 - 0.1);
      const double size = uniform() < 0.1 ? 100.0 : uniform() < 0.5 ? 0.01 : 0.1;
      focuses_.push_back(
          {domain_.min_world + domain_.size_m * place, domain_.size_m * size * (0.01 + uniform())});
    }
  }

  int new_budget() {
    const double kind = uniform();
    if (kind < 0.2) return 2 + static_cast<int>(4.0 * uniform());
    if (kind < 0.4) return max_budget_;
    return 2 + static_cast<int>((max_budget_ - 2) * uniform());
  }

  std::uint64_t seed_, counter_ = 0;
  Domain domain_;
  int max_budget_;
  const ReliefBounds* relief_;
  int budget_;
  glm::dvec3 position_{0.0};
  double heading_ = 0.0;
  float height_ = 0.0f;
  PriorityFactors factors_;
  std::vector<Focus> focuses_;
  Priority priority_ = Priority::kProjectedSize;
  double largest_size_m_ = std::numeric_limits<double>::infinity();
  double earth_radius_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace swell::lod
