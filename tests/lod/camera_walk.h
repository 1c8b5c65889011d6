// Random requests: smooth flights with jumps, from inside the waves, below them, far off, looking
// away, with changing budgets, heights and focuses. A pure function of the seed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lod/roam.h"
#include "math/random.h"

namespace swell::lod {

class CameraWalk {
 public:
  CameraWalk(std::uint64_t seed, const Domain& domain, int max_budget)
      : seed_(seed), domain_(domain), max_budget_(max_budget), budget_(std::min(100, max_budget)) {
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
    request.view = make_view(position_, heading_, pitch, 0.3 + 1.5 * uniform(), 0.1f, 64, 48);
    request.frustum_margin = uniform() < 0.5 ? 0.0f : 0.2f;
    if (uniform() < 0.2) budget_ = new_budget();
    request.triangle_budget = budget_;
    if (uniform() < 0.1) height_ = static_cast<float>(domain_.size_m * 0.05 * uniform());
    request.min_height_m = -height_;
    request.max_height_m = height_;
    if (uniform() < 0.1) priority_ = other(priority_);
    request.priority = priority_;
    if (uniform() < 0.2) focuses_.clear();
    if (uniform() < 0.3) add_focuses();
    for (Focus& f : focuses_) f.centre_m += 0.3 * f.radius_m * glm::dvec2(centred(), centred());
    request.focuses = focuses_;  // until the next call
    request.factors.focus_nearer = uniform() < 0.5 ? 4.0f : 11.7f;
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
    heading_ = 7.0 * uniform();
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
  int budget_;
  glm::dvec3 position_{0.0};
  double heading_ = 0.0;
  float height_ = 0.0f;
  std::vector<Focus> focuses_;
  Priority priority_ = Priority::kProjectedSize;
};

}  // namespace swell::lod
