#include "render/governor.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/check.h"

namespace swell::render {
namespace {

// Sizes against those of full quality.
struct Sizes {
  double lookups, picture;
};
constexpr std::array<Sizes, Governor::kSteps> kSizes = {
    {{1.0, 1.0}, {0.7, 1.0}, {0.5, 1.0}, {0.5, 0.85}, {0.5, 0.7}, {0.5, 0.6}, {0.5, 0.5}}};

// Fewer triangles than this only when there is no smaller picture.
constexpr double kLeastDetail = 0.4;
constexpr double kDown = 0.905, kUp = 1.04;  // of triangles a frame

// Shares of the budget.
constexpr double kHighestAim = 0.92, kLowestAim = 0.8;
constexpr double kSlackAbove = 0.03, kSlackBelow = 0.04;  // around the aim nothing is changed
constexpr double kSlackToRaise = 0.05;
constexpr double kBroken = 1.05;
constexpr double kMostLod = 0.15;  // of triangulating

// Frames.
constexpr std::size_t kFast = 3, kSlow = 31;
constexpr int kPatience = 60, kMostPatience = 16 * kPatience;
constexpr int kFramesToLower = 15;
constexpr int kRaiseFailed = 2 * kPatience;  // a step down so soon after one up

// Half of finding what is visible goes over triangles, half over pixels.
constexpr double kVisibilityOfTriangles = 0.5;

double lookup_pixels(int step) {
  const Sizes& s = kSizes[static_cast<std::size_t>(step)];
  return s.lookups * s.lookups * s.picture * s.picture;
}

double picture_pixels(int step) {
  const Sizes& s = kSizes[static_cast<std::size_t>(step)];
  return s.picture * s.picture;
}

double of_others(const auto& cost, int step) {
  return cost.rest + cost.lookups * lookup_pixels(step) + cost.pixels * picture_pixels(step);
}

double predicted_ms(const auto& cost, int step, double detail) {
  return of_others(cost, step) + cost.triangles * detail;
}

// The detail that makes a frame take `ms`; any real number.
double detail_for(const auto& cost, int step, double ms) {
  return cost.triangles > 0.0 ? (ms - of_others(cost, step)) / cost.triangles : 1.0;
}

}  // namespace

Governor::Governor(const GovernorSettings& settings, const FrameOptions& full_quality)
    : settings_(settings), aim_share_(kHighestAim), patience_frames_(kPatience) {
  SWELL_CHECK(settings.budget_ms > 0.0, "budget_ms={}", settings.budget_ms);
  SWELL_CHECK(settings.least_detail > 0.0 && settings.least_detail <= 1.0, "least_detail={}",
              settings.least_detail);
  set_full_quality(full_quality);
}

void Governor::set_full_quality(const FrameOptions& full_quality) {
  SWELL_CHECK(full_quality.water_triangles > 0 && full_quality.terrain_triangles > 0 &&
                  full_quality.lookup_scale > 0.0,
              "water_triangles={} terrain_triangles={} lookup_scale={}",
              full_quality.water_triangles, full_quality.terrain_triangles,
              full_quality.lookup_scale);
  full_ = full_quality;
  write_options();
}

void Governor::write_options() {
  const Sizes& sizes = kSizes[static_cast<std::size_t>(report_.step)];
  const auto share = [&](int triangles) {
    return std::max(2, static_cast<int>(std::lround(report_.detail * triangles)));
  };
  options_ = full_;
  options_.water_triangles = share(full_.water_triangles);
  options_.terrain_triangles = share(full_.terrain_triangles);
  options_.lookup_scale = full_.lookup_scale * sizes.lookups;
  options_.picture_scale = full_.picture_scale * sizes.picture;
  if (frames_ > 0) {  // the first is drawn whole
    const double lod_ms = kMostLod * settings_.budget_ms;
    options_.lod_ms = full_.lod_ms > 0.0 ? std::min(full_.lod_ms, lod_ms) : lod_ms;
  }
  options_.triangle_capacity =
      std::max({full_.triangle_capacity, full_.water_triangles, full_.terrain_triangles});
}

const FrameOptions& Governor::next(const FrameStatistics& last, double outside_ms) {
  learn(last, outside_ms);
  if (frames_ >= kFast) {  // the first frame makes storage
    const Model model = {median_cost(kFast), median_cost(kSlow)};
    choose_aim();
    choose_step(model);
    choose_detail(model);
    report_.predicted_ms = predicted_ms(model.fast, report_.step, report_.detail);
  }
  write_options();
  return options_;
}

void Governor::learn(const FrameStatistics& last, double outside_ms) {
  const auto stage = [&](Stage s) { return last.stage_ms[static_cast<std::size_t>(s)]; };
  const double visibility = stage(Stage::kVisibility);
  const double triangles =
      stage(Stage::kTriangulate) + stage(Stage::kDisplace) + kVisibilityOfTriangles * visibility;
  const double pixels = stage(Stage::kShade) + (1.0 - kVisibilityOfTriangles) * visibility;
  const double lookups = stage(Stage::kLookups);
  const double frame_ms = last.frame_ms + outside_ms;

  const std::size_t place = frames_++ % kRemembered;
  costs_[place] = {triangles / report_.detail, lookups / lookup_pixels(report_.step),
                   pixels / picture_pixels(report_.step), frame_ms - triangles - pixels - lookups};
  strays_[place] = report_.predicted_ms > 0.0 ? frame_ms / report_.predicted_ms : 1.0;
}

// Member by member, of the last `frames`.
Governor::Cost Governor::median_cost(std::size_t frames) const {
  const std::size_t count = std::min(frames, frames_);
  const auto median = [&](double Cost::*member) {
    std::array<double, kRemembered> values{};
    for (std::size_t i = 0; i < count; ++i)
      values[i] = costs_[(frames_ - 1 - i) % kRemembered].*member;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  };
  return {median(&Cost::triangles), median(&Cost::lookups), median(&Cost::pixels),
          median(&Cost::rest)};
}

// Lower, the further single frames stray: all but the worst two of those remembered should stay
// below 1.1 budgets. In small moves, so that triangles do not follow every disturbance.
void Governor::choose_aim() {
  std::array<double, kRemembered> strays = strays_;
  const auto count = static_cast<std::ptrdiff_t>(std::min(frames_, kRemembered));
  const auto third = strays.begin() + 2;
  std::nth_element(strays.begin(), third, strays.begin() + count, std::greater{});
  const double wanted = std::clamp(1.08 / std::max(*third, 1.0), kLowestAim, kHighestAim);
  aim_share_ += std::clamp(wanted - aim_share_, -0.004, 0.001);
  report_.aim_ms = aim_share_ * settings_.budget_ms;
}

double Governor::least_detail(int step) const {
  return step < kSteps - 1 ? std::max(kLeastDetail, settings_.least_detail)
                           : settings_.least_detail;
}

// The first step that fits into `ms` with few triangles, else the last.
int Governor::best_step(const Cost& cost, double ms) const {
  int step = 0;
  while (step < kSteps - 1 && predicted_ms(cost, step, least_detail(step)) > ms) ++step;
  return step;
}

void Governor::choose_step(const Model& model) {
  const double budget_ms = settings_.budget_ms, aim_ms = report_.aim_ms;
  ++frames_since_raise_;
  if (frames_since_raise_ > kMostPatience) {
    patience_frames_ = std::max(kPatience, patience_frames_ / 2);
    frames_since_raise_ = 0;
  }

  // Down: at once if the budget is broken and triangles cannot mend it by the next frame.
  const double now_ms = predicted_ms(model.fast, report_.step, report_.detail);
  int step = report_.step;
  if (now_ms > kBroken * budget_ms)
    while (step < kSteps - 1 && predicted_ms(model.fast, step, kDown * report_.detail) > aim_ms)
      ++step;
  const int fitting = best_step(model.fast, aim_ms + kSlackAbove * budget_ms);
  frames_wanting_less_ = fitting > report_.step ? frames_wanting_less_ + 1 : 0;
  if (frames_wanting_less_ > kFramesToLower) step = std::max(step, fitting);
  if (step > report_.step) {
    if (frames_since_raise_ < kRaiseFailed)
      patience_frames_ = std::min(kMostPatience, 2 * patience_frames_);
    move_to_step(step);
    return;
  }

  // Up: when triangles have made room for it.
  going_up_ = wants_more(model);
  if (going_up_ && predicted_ms(model.fast, better_step_, report_.detail) <= aim_ms) {
    frames_since_raise_ = 0;
    move_to_step(better_step_);
  }
}

// True once frames have wanted a better step for long enough: the best that all of them allow.
bool Governor::wants_more(const Model& model) {
  const double ms = report_.aim_ms - kSlackToRaise * settings_.budget_ms;
  const int allowed = std::max(best_step(model.fast, ms), best_step(model.slow, ms));
  if (allowed >= report_.step) {
    frames_wanting_more_ = 0;
    return false;
  }
  better_step_ = frames_wanting_more_ > 0 ? std::max(better_step_, allowed) : allowed;
  return ++frames_wanting_more_ >= patience_frames_;
}

void Governor::move_to_step(int step) {
  report_.step = step;
  ++report_.step_changes;
  frames_wanting_more_ = frames_wanting_less_ = 0;
  going_up_ = false;
}

void Governor::choose_detail(const Model& model) {
  const double budget_ms = settings_.budget_ms, aim_ms = report_.aim_ms;
  const int step = going_up_ ? better_step_ : report_.step;
  const double fast_ms = predicted_ms(model.fast, step, report_.detail);
  const double slow_ms = predicted_ms(model.slow, step, report_.detail);
  const double fast = detail_for(model.fast, step, aim_ms);
  const double slow = detail_for(model.slow, step, aim_ms);
  double detail = report_.detail;
  if (fast_ms > aim_ms + (going_up_ ? 0.0 : kSlackAbove * budget_ms))
    detail = std::max(fast, kDown * detail);
  else if (!going_up_ && std::max(fast_ms, slow_ms) < aim_ms - kSlackBelow * budget_ms)
    detail = std::min({fast, slow, kUp * detail});
  report_.detail = std::clamp(detail, std::min(report_.detail, least_detail(step)), 1.0);
}

}  // namespace swell::render
