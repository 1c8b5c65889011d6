#include "render/quality/governor.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/check.h"
#include "render/frame/stages.h"

namespace swell::render {
namespace {

// Sizes against those of full quality.
struct Sizes {
  double planar_maps, picture;
};
constexpr double kLeastPicture = 0.5;
// A step of the picture's side changes its pixels by 6 %: so little that a picture which just does
// not fit leaves no more of the budget unused than a tenth.
constexpr double kPictureStep = 0.97;

constexpr std::array<Sizes, Governor::kSteps> all_sizes() {
  std::array<Sizes, Governor::kSteps> sizes = {{{1.0, 1.0}, {0.7, 1.0}, {0.5, 1.0}}};
  double picture = 1.0;
  for (std::size_t i = 3; i < sizes.size(); ++i) {
    picture *= kPictureStep;
    const int percent = static_cast<int>(100.0 * picture + 0.5);
    sizes[i] = {0.5, percent / 100.0};
  }
  sizes.back().picture = kLeastPicture;
  return sizes;
}
constexpr std::array<Sizes, Governor::kSteps> kSizes = all_sizes();
static_assert(kSizes[Governor::kSteps - 2].picture > kLeastPicture);

// Fewer triangles than this only when there is no smaller picture.
constexpr double kLeastDetail = 0.4;
// A better size has to fit with so many, so that fewer of them can make up for what comes next: at
// 0.4 a flight whose load varied by a tenth changed size 10 times instead of 5.
constexpr double kDetailToRaise = 0.55;
constexpr double kDown = 0.905, kUp = 1.04;  // of triangles a frame

// Shares of the budget.
constexpr double kBar = 1.08;  // a frame that takes longer is late
constexpr double kHighestAim = 0.95, kLowestAim = 0.8;
constexpr double kSlackAbove = 0.03, kSlackBelow = 0.02;  // around the aim nothing is changed
constexpr double kSlackToRaise = 0.015;
constexpr double kBroken = 1.05, kFarOver = 1.15;
constexpr double kWhole = 1.02,
                 kWholeAgain = 0.985;  // full quality stays to here, and is back from here
constexpr double kMostLod = 0.15;      // of triangulating

// Frames.
constexpr std::size_t kFast = 3, kFirm = 9, kSlow = 31;
constexpr int kPatience = 36, kMostPatience = 960;
constexpr int kFramesToLower = 15;
constexpr std::size_t kFramesAStray = 20;
constexpr int kFramesLost = 6;    // of the wait for a step up, by one that does not allow it
constexpr int kRaiseProven = 60;  // within the budget since a step up, so that it has not failed

// Half of finding what is visible goes over triangles, half over pixels.
constexpr double kVisibilityOfTriangles = 0.5;

// Time for the planar maps goes by their side, not by their pixels: at a lagoon 3.0 ms, 1.5 at
// half and 0.7 at a quarter. Taken by pixels, 8 ms too much were expected of the way back up.
double planar_sides(int step) {
  const Sizes& s = kSizes[static_cast<std::size_t>(step)];
  return s.planar_maps * s.picture;
}

double picture_pixels(int step) {
  const Sizes& s = kSizes[static_cast<std::size_t>(step)];
  return s.picture * s.picture;
}

double of_others(const auto& cost, int step) {
  return cost.rest + cost.planar_maps * planar_sides(step) + cost.pixels * picture_pixels(step);
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
    : settings_(settings),
      aim_share_(kHighestAim),
      patience_frames_(kPatience),
      frames_kept_since_raise_(kRaiseProven) {
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
  options_.lookup_scale = full_.lookup_scale * sizes.planar_maps;
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
    const Model model = {median_cost(kFast), median_cost(kFirm), median_cost(kSlow)};
    choose_aim();
    if (frames_ >= kFirm) choose_step(model);
    choose_detail(model);
    report_.predicted_ms = predicted_ms(model.fast, report_.step, report_.detail);
    report_.whole_ms = predicted_ms(model.slow, 0, 1.0);
  }
  write_options();
  return options_;
}

void Governor::learn(const FrameStatistics& last, double outside_ms) {
  const auto stage = [&](Stage s) { return last.stage_ms[static_cast<std::size_t>(s)]; };
  const double visibility = stage(Stage::kVisibility), rays = stage(Stage::kRays);
  const double triangles =
      stage(Stage::kTriangulate) + stage(Stage::kDisplace) + kVisibilityOfTriangles * visibility;
  const double pixels = stage(Stage::kShade) + stage(Stage::kClouds) + rays +
                        (1.0 - kVisibilityOfTriangles) * visibility;
  const double planar_maps = stage(Stage::kPlanarMaps);
  const double frame_ms = last.frame_ms + outside_ms;

  const std::size_t place = frames_++ % kRemembered;
  costs_[place] = {triangles / report_.detail, planar_maps / planar_sides(report_.step),
                   pixels / picture_pixels(report_.step),
                   frame_ms - triangles - pixels - planar_maps};
  strays_[(frames_ - 1) % kStraysRemembered] =
      report_.predicted_ms > 0.0 ? frame_ms / report_.predicted_ms : 1.0;
  frames_kept_since_raise_ += frame_ms <= settings_.budget_ms;
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
  return {median(&Cost::triangles), median(&Cost::planar_maps), median(&Cost::pixels),
          median(&Cost::rest)};
}

// Lower, the further frames stray: all but one in twenty of those remembered should stay below the
// bar. Fewer disturbed frames than that are late whatever is drawn, and would blur all others (by
// the worst three of 240 a machine that was idle aimed at 0.7 of the budget). Frames that the
// lowest aim would not have saved do not count. In small moves, so that triangles do not follow
// every disturbance.
void Governor::choose_aim() {
  std::array<double, kStraysRemembered> strays{};
  const std::size_t count = std::min(frames_, kStraysRemembered);
  const auto last =
      std::copy_if(strays_.begin(), strays_.begin() + static_cast<std::ptrdiff_t>(count),
                   strays.begin(), [](double stray) { return stray <= kBar / kLowestAim; });
  const auto far = strays.begin() + static_cast<std::ptrdiff_t>(count / kFramesAStray);
  if (far < last) std::nth_element(strays.begin(), far, last, std::greater{});
  const double wanted = std::clamp(kBar / std::max(*far, 1.0), kLowestAim, kHighestAim);
  aim_share_ += std::clamp(wanted - aim_share_, -0.004, 0.001);
  report_.aim_ms = aim_share_ * settings_.budget_ms;
}

double Governor::least_detail(int step) const {
  return step < kSteps - 1 ? std::max(kLeastDetail, settings_.least_detail)
                           : settings_.least_detail;
}

// The first step that fits into `ms` with few triangles, but `detail` at least, else the last. Full
// quality may take `whole_ms`.
int Governor::best_step(const Cost& cost, double detail, double ms, double whole_ms) const {
  int step = 0;
  if (predicted_ms(cost, 0, 1.0) <= whole_ms) return step;
  while (step < kSteps - 1 && predicted_ms(cost, step, std::max(detail, least_detail(step))) > ms)
    ++step;
  return step;
}

void Governor::choose_step(const Model& model) {
  const double budget_ms = settings_.budget_ms, aim_ms = report_.aim_ms;
  ++frames_since_raise_;
  if (frames_since_raise_ > kMostPatience) {
    patience_frames_ = std::max(kPatience, patience_frames_ / 2);
    frames_since_raise_ = 0;
  }

  // Down: to what fits once triangles have followed; at once if the budget is broken.
  const int fitting =
      best_step(model.firm, kLeastDetail, aim_ms + kSlackAbove * budget_ms, kWhole * budget_ms);
  const double now_ms = predicted_ms(model.firm, report_.step, report_.detail);
  frames_wanting_less_ = fitting > report_.step ? frames_wanting_less_ + 1 : 0;
  if (frames_wanting_less_ > (now_ms > kBroken * budget_ms ? 0 : kFramesToLower)) {
    if (frames_kept_since_raise_ < kRaiseProven)
      patience_frames_ = std::min(kMostPatience, 2 * patience_frames_);
    frames_kept_since_raise_ = kRaiseProven;
    move_to_step(fitting);
    return;
  }

  // Up: when triangles have made room for it.
  better_step_ = step_wanted(model);
  going_up_ = better_step_ < report_.step;
  if (going_up_ && predicted_ms(model.firm, better_step_, report_.detail) <= aim_ms) {
    frames_since_raise_ = frames_kept_since_raise_ = 0;
    move_to_step(better_step_);
  }
}

// The best step that all of the last frames allowed, for long enough, else the present one.
int Governor::step_wanted(const Model& model) {
  const double ms = report_.aim_ms - kSlackToRaise * settings_.budget_ms;
  const double whole_ms = kWholeAgain * settings_.budget_ms;
  const int allowed = std::max(best_step(model.firm, kDetailToRaise, ms, whole_ms),
                               best_step(model.slow, kDetailToRaise, ms, whole_ms));
  for (int step = 0; step < kSteps; ++step) {
    int& frames = frames_allowing_[static_cast<std::size_t>(step)];
    // A disturbed frame or two do not start the wait anew.
    frames = step >= allowed ? frames + 1 : std::max(0, frames - kFramesLost);
  }
  const auto enough = [&](int frames) {
    return std::ranges::lower_bound(frames_allowing_, frames) - frames_allowing_.begin();
  };
  // Where a better one is half way there, one change of size instead of two.
  const auto wanted = enough(patience_frames_);
  if (enough(patience_frames_ / 2) < wanted) return report_.step;
  return std::min(static_cast<int>(wanted), report_.step);
}

void Governor::move_to_step(int step) {
  if (step > report_.step) frames_allowing_.fill(0);
  report_.step = step;
  ++report_.step_changes;
  frames_wanting_less_ = 0;
  going_up_ = false;
}

// Whether frames at full quality, as they are drawn now, may go on: with a long look at what is
// near the budget and a short one at what is far above it.
bool Governor::fits_whole(const Model& model) const {
  const auto share = [&](const Cost& cost) {
    return predicted_ms(cost, 0, 1.0) / settings_.budget_ms;
  };
  const bool seen_long = frames_ >= kSlow;
  return (!seen_long || share(model.slow) <= kWhole) && share(model.firm) <= kBroken &&
         share(model.fast) <= kFarOver;
}

void Governor::choose_detail(const Model& model) {
  const double budget_ms = settings_.budget_ms, aim_ms = report_.aim_ms;
  const int step = going_up_ ? better_step_ : report_.step;
  const double fast_ms = predicted_ms(model.fast, step, report_.detail);
  const double slow_ms = predicted_ms(model.slow, step, report_.detail);
  const bool is_whole = report_.step == 0 && report_.detail == 1.0;
  const double whole_ms = predicted_ms(model.slow, 0, 1.0);
  double detail = report_.detail;
  if (is_whole && fits_whole(model)) {
    // Stays.
  } else if (fast_ms > aim_ms + (going_up_ ? 0.0 : kSlackAbove * budget_ms)) {
    detail = std::max(detail_for(model.fast, step, aim_ms), kDown * detail);
  } else if (report_.step == 0 && whole_ms <= kWholeAgain * budget_ms) {
    detail = kUp * detail;
  } else if (!going_up_ && std::max(fast_ms, slow_ms) < aim_ms - kSlackBelow * budget_ms) {
    detail = std::min(
        {detail_for(model.fast, step, aim_ms), detail_for(model.slow, step, aim_ms), kUp * detail});
  }
  report_.detail = std::clamp(detail, std::min(report_.detail, least_detail(step)), 1.0);
}

}  // namespace swell::render
