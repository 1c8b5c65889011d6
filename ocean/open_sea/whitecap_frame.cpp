#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/check.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/open_sea/whitecap_steps.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kTexels = static_cast<std::size_t>(kFoamMapSize) * kFoamMapSize;

void make_next(const Whitecaps& whitecaps, double step, WhitecapFrame& frame, Workers& workers) {
  std::array<const PatchWaves*, kMostFoamPatches> waves{};
  for (std::size_t p = 0; p < whitecaps.patches.size(); ++p)
    waves[p] = &whitecaps.patches[p].breaking;
  break_waves(whitecaps, whitecaps.plan, {waves.data(), whitecaps.patches.size()}, step,
              {frame.breaking_a, frame.breaking_b}, frame.fft_planes, workers);
  for (std::size_t p = 0; p < whitecaps.patches.size(); ++p) {
    const FoamPatch& patch = whitecaps.patches[p];
    age_foam(p == 0 ? frame.breaking_a : frame.breaking_b, patch.threshold, patch.decay,
             frame.patches[p].after);
  }
  if (frame.trains) age_train_foam(whitecaps, step, frame.breaking_a, frame.trains_codes, workers);
}

void start(const Whitecaps& whitecaps, WhitecapFrame& frame) {
  const std::size_t count = whitecaps.patches.size();
  frame.patches.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    frame.patches[p].length_m = whitecaps.patches[p].length_m;
    frame.patches[p].wave_samples = whitecaps.sea.resolution;
    frame.patches[p].before.resize(kTexels);
    frame.patches[p].after.assign(kTexels, 0);
  }
  frame.trains = whitecaps.trains;
  frame.trains_codes.assign(frame.trains ? kTexels : 0, 0);
  frame.trains_before.resize(frame.trains_codes.size());
  frame.trains_after.resize(frame.trains_codes.size());
  frame.breaking_a.resize(count > 0 ? kTexels : 0);
  frame.breaking_b.resize(count > 1 ? kTexels : 0);
  if (frame.sea != whitecaps.sea) frame.sea = whitecaps.sea;
  frame.crest_per_m = whitecaps.crest_per_m;
  frame.is_filled = true;
}

// is_shown: the frame's, or the one before that.
void take_step(const Whitecaps& whitecaps, double step, bool is_shown, WhitecapFrame& frame,
               Workers& workers) {
  for (WhitecapFrame::Patch& patch : frame.patches)
    std::ranges::copy(patch.after, patch.before.begin());
  make_next(whitecaps, step, frame, workers);
  if (!frame.trains || !is_shown) return;
  std::swap(frame.trains_before, frame.trains_after);
  smooth_train_foam(frame.trains_codes, frame.trains_after, workers);
}

// Fills `frame` with the foam before and after a step.
void make_step(const Whitecaps& whitecaps, double step, bool is_known, WhitecapFrame& frame,
               Workers& workers) {
  const bool has_foam = !whitecaps.patches.empty();
  if (has_foam && is_known && step == frame.step + 1.0) {
    take_step(whitecaps, step + 1.0, true, frame, workers);
  } else {
    // What was white before the first of these steps has gone when the last is made.
    int life = 0;
    for (const FoamPatch& patch : whitecaps.patches) life = std::max(life, steps_of_life(patch));
    start(whitecaps, frame);
    if (has_foam)
      for (int n = -life; n <= 1; ++n) take_step(whitecaps, step + n, n >= 0, frame, workers);
  }
  frame.step = step;
}

}  // namespace

double time_of_step(const Whitecaps& whitecaps, double step) {
  if (whitecaps.steps_in_loop == 0) return step * whitecaps.step_s;
  const double loop = whitecaps.steps_in_loop;
  return (step - loop * std::floor(step / loop)) * whitecaps.step_s;
}

void break_waves(const Whitecaps& whitecaps, const FftPlan& plan,
                 std::span<const PatchWaves* const> waves, double step,
                 const std::array<std::span<float>, kMostFoamPatches>& breaking,
                 std::vector<float>& planes, Workers& workers) {
  const double t_s = time_of_step(whitecaps, step);
  const PatchWaves* const other = waves.size() > 1 ? waves[1] : nullptr;
  const FftOutput output{breaking[0].data(), other ? breaking[1].data() : nullptr};
  inverse_fft_2d(
      plan,
      [&](int, int column0, float* re, float* im) {
        return fill_heights(*waves[0], other, plan, t_s, column0, re, im);
      },
      {&output, 1}, planes, workers);
}

void advance_whitecaps(const Whitecaps& whitecaps, double t_s, WhitecapFrame& frame,
                       Workers& workers) {
  const ScopedFloatEnvironment ieee;
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  const double steps = wave_time_s(whitecaps.sea, t_s) / whitecaps.step_s;
  const double step = std::floor(steps);
  frame.past = static_cast<float>(steps - step);
  const bool is_known =
      frame.is_filled && frame.sea == whitecaps.sea && frame.trains == whitecaps.trains;
  if (!is_known || frame.step != step) make_step(whitecaps, step, is_known, frame, workers);
  for (std::size_t p = 0; p < frame.patches.size(); ++p)
    frame.patches[p].tiling = tiling_of_patch(whitecaps.sea, p);
}

}  // namespace swell::ocean
