#include "lod/roam.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>

#include "lod/priority.h"
#include "lod/tree.h"
#include "math/check.h"

namespace swell::lod {
namespace {

// Not by the clock before the first few steps, so that every call gets on.
bool is_over(const AdaptLimits& limits, int operations, int step) {
  using Clock = std::chrono::steady_clock;
  constexpr int kStepsPerLook = 16;  // at the clock
  if (operations >= limits.max_operations) return true;
  return limits.deadline != Clock::time_point::max() && step % kStepsPerLook == 0 &&
         Clock::now() >= limits.deadline;
}

bool is_limited(const AdaptLimits& limits) {
  return limits.max_operations != AdaptLimits{}.max_operations ||
         limits.deadline != AdaptLimits{}.deadline || limits.priority_groups > 1;
}

PriorityKey scaled(PriorityKey key, float factor) {
  if (key >= kCulledKey) return key;
  return std::bit_cast<PriorityKey>(std::min(std::bit_cast<float>(key) * factor, kLastKey));
}

// Where most would be merged, as after a turn of the camera: begins at the two root triangles, and
// splits in no order what lies clearly before where the last target ended, so that move_to_target()
// has few left to order.
AdaptStatistics begin_anew(Roam::Tree& tree, int budget) {
  Queue &splits = tree.split_queue, &merges = tree.merge_queue;
  int leaving = 0;
  for (int i = 0; i < merges.size(); ++i) leaving += merges.key_at(i) >= tree.border;
  if (2 * leaving <= merges.size()) return {};
  reset_tree(tree);
  AdaptStatistics done = {.anew = true};
  const PriorityKey clearly = std::min(scaled(tree.border, 0.95f), tree.frame.end_key);
  for (int i = 0; i < splits.size() && tree.triangles + 2 <= budget;) {
    if (splits.key_at(i) >= clearly) {
      ++i;
      continue;
    }
    split(tree, splits.node_at(i));
    ++done.splits;
  }
  return done;
}

// The target is the longest prefix of the total order of diamonds (highest priority first, then
// level, then place) that keeps the budget and holds no diamond of priority 0. Parents come before
// children in that order, so every prefix is a valid mesh, the best diamond that is not split is
// always splittable, and the worst that is split always mergeable.
//
// Each diamond moves at most once. One that is split was the first of all unsplit ones and had
// room, so whatever is unsplit later comes after it, and it is not merged again. One that is
// merged was the last of all split ones, and these with the best unsplit one do not fit together,
// so no prefix that keeps the budget reaches to it.
//
// After begin_anew() each moves at most twice.
//
// With groups of priorities some keys are old. An operation renews those of the diamonds it
// touches, and among renewed ones the above holds: each moves at most twice.
AdaptStatistics move_to_target(Roam::Tree& tree, int budget, const AdaptLimits& limits,
                               AdaptStatistics done) {
  const int operation_cap = (limits.priority_groups > 1 || done.anew ? 4 : 2) * tree.max_triangles;
  for (int step = 1;; ++step) {
    const std::optional<QueueMember> best = tree.split_queue.first();
    const bool wanted = best && best->key < tree.frame.end_key;
    const bool fits = wanted && tree.triangles + added_triangles(tree, best->node) <= budget;
    const std::optional<QueueMember> worst = fits ? std::nullopt : tree.merge_queue.first();
    const bool too_much = worst && (tree.triangles > budget || worst->key >= tree.frame.end_key ||
                                    (wanted && *best < *worst));
    if (!fits && !too_much) break;

    done.stopped = tree.triangles <= budget && is_over(limits, done.splits + done.merges, step);
    if (done.stopped) break;
    done.operation_cap_hit = done.splits + done.merges >= operation_cap;
    if (done.operation_cap_hit) break;
    if (fits) {
      done.splits += force_split(tree, best->node);
    } else {
      merge(tree, worst->node);
      ++done.merges;
    }
  }
  done.triangles = tree.triangles;
  return done;
}

// Where the diamonds that are not split begin. Of a mesh that is not finished, where those that are
// split end.
PriorityKey border_of(Roam::Tree& tree, bool stopped) {
  const std::optional<QueueMember> border =
      stopped ? tree.merge_queue.first() : tree.split_queue.first();
  return border ? border->key : kCulledKey;
}

double reach_of(const Roam::Tree& tree) {
  const double steps = distance_of_largest(tree.frame, tree.border);
  return std::max(steps, 1.0) * tree.domain.step_m();
}

void check_domain(const Domain& domain) {
  SWELL_CHECK(domain.lattice_bits >= 1 && domain.lattice_bits <= 24, "lattice_bits={}",
              domain.lattice_bits);
  SWELL_CHECK(std::isfinite(domain.size_m) && domain.size_m > 0.0, "size_m={}", domain.size_m);
  SWELL_CHECK(std::isfinite(domain.min_world.x) && std::isfinite(domain.min_world.y),
              "min_world=({}, {})", domain.min_world.x, domain.min_world.y);
}

}  // namespace

Roam::Roam(const Domain& domain, int max_triangles) {
  check_domain(domain);
  SWELL_CHECK(max_triangles >= 2 && max_triangles <= 1 << 28, "max_triangles={}", max_triangles);
  tree_ = std::make_unique<Tree>(domain, max_triangles);
}

Roam::~Roam() = default;
Roam::Roam(Roam&&) noexcept = default;
Roam& Roam::operator=(Roam&&) noexcept = default;

const Domain& Roam::domain() const { return tree_->domain; }

void Roam::set_origin(glm::dvec2 min_world) {
  SWELL_CHECK(std::isfinite(min_world.x) && std::isfinite(min_world.y), "min_world=({}, {})",
              min_world.x, min_world.y);
  tree_->domain.min_world = min_world;
}

void Roam::set_domain(const Domain& domain) {
  check_domain(domain);
  const Domain old = tree_->domain;
  tree_->domain = domain;
  if (old.lattice_bits == domain.lattice_bits && old.size_m == domain.size_m) return;
  tree_->frame = {};
  tree_->frame.lattice_bits = domain.lattice_bits;
  tree_->border = kCulledKey;
  reset_tree(*tree_);
}

AdaptStatistics Roam::adapt(const AdaptRequest& request) {
  SWELL_CHECK(request.triangle_budget >= 2 && request.triangle_budget <= tree_->max_triangles,
              "triangle_budget={} max_triangles={}", request.triangle_budget, tree_->max_triangles);
  SWELL_CHECK(request.limits.max_operations >= 0 && request.limits.priority_groups >= 1,
              "max_operations={} priority_groups={}", request.limits.max_operations,
              request.limits.priority_groups);
  set_priorities(*tree_, make_priority_frame(request, tree_->domain),
                 request.limits.priority_groups);
  const bool limited = is_limited(request.limits);
  const AdaptStatistics begun =
      limited ? AdaptStatistics{} : begin_anew(*tree_, request.triangle_budget);
  AdaptStatistics done = move_to_target(*tree_, request.triangle_budget, request.limits, begun);
  tree_->border = border_of(*tree_, done.stopped);
  done.reach_m = reach_of(*tree_);
  return done;
}

AdaptStatistics Roam::rebuild(const AdaptRequest& request) {
  reset_tree(*tree_);
  return adapt(request);
}

}  // namespace swell::lod
