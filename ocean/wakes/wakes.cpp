#include "ocean/wakes/wakes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/smoothstep.h"
#include "ocean/wakes/wake_lee.h"

namespace swell::ocean {
namespace {

constexpr std::size_t kWindowSide = kWakeSamples, kAll = kWindowSide * kWindowSide;

using Windows = std::span<const WakeWindow>;

// The sources' fields, as heights of the windows.
void transform_windows(WakeField field, Windows sources, Windows windows, const FftPlan& plan,
                       std::vector<float>& planes, Workers& workers) {
  std::array<FftOutput, kMostWakeWindows> outputs;
  for (std::size_t w = 0; w < windows.size(); ++w)
    outputs[w] = {windows[w].height_m.data(), nullptr};
  inverse_fft_2d(
      plan,
      [&](int transform, int column0, float* re, float* im) {
        return fill_wake(sources[static_cast<std::size_t>(transform)], field, plan, column0, re,
                         im);
      },
      {outputs.data(), windows.size()}, planes, workers);
}

// By row or column: 1 in the middle, 0 at the first and the last sample.
constexpr std::array<float, kWindowSide> kRim = [] {
  constexpr float kWidth = kWakeRim * kWakeSamples;
  std::array<float, kWindowSide> rim{};
  for (std::size_t i = 0; i < kWindowSide; ++i) {
    const auto inside = static_cast<float>(std::min(i, kWindowSide - 1 - i));
    rim[i] = smooth_blend(std::min(inside / kWidth, 1.0f));
  }
  return rim;
}();

void fade_row(std::size_t j, const WakeWindow& window) {
  const float row = kRim[j], bound_m = window.bound_m;
  const auto z = std::span(window.height_m).subspan(j * kWindowSide, kWindowSide);
  put_in_lee(window, j, z);
  for (std::size_t i = 0; i < kWindowSide; ++i)
    z[i] = std::clamp(z[i] * row * kRim[i], -bound_m, bound_m);
}

// Differences over five samples: exact to 2 % for waves of eight samples. None at the border, where
// there are no waves.
void slope_row(std::size_t j, const WakeWindow& window) {
  const float near = static_cast<float>(2.0 / 3.0 * kWakeSamples / window.length_m);
  const float far = -0.125f * near;
  float* const slope_x = window.slope_x.data() + j * kWindowSide;
  float* const slope_y = window.slope_y.data() + j * kWindowSide;
  std::fill_n(slope_x, kWindowSide, 0.0f);
  std::fill_n(slope_y, kWindowSide, 0.0f);
  if (j < 2 || j + 2 >= kWindowSide) return;
  const float* const z = window.height_m.data() + j * kWindowSide;
  const float *const z1 = z + kWindowSide, *const z2 = z1 + kWindowSide;
  const float *const z_1 = z - kWindowSide, *const z_2 = z_1 - kWindowSide;
  for (std::size_t i = 2; i + 2 < kWindowSide; ++i) {
    const float x = near * (z[i + 1] - z[i - 1]) + far * (z[i + 2] - z[i - 2]);
    const float y = near * (z1[i] - z_1[i]) + far * (z2[i] - z_2[i]);
    slope_x[i] = std::clamp(x, -kMostWakeSlope, kMostWakeSlope);
    slope_y[i] = std::clamp(y, -kMostWakeSlope, kMostWakeSlope);
  }
}

// ---- Foam

// Froude number of the hull.
float froude(const WakeWindow& window) {
  return window.hull.speed_mps / std::sqrt(window.gravity_mps2 * window.hull.length_m);
}

// The strip of turbulent water that a hull leaves: as wide as half the beam, wider with the fourth
// root of the distance, less with its age. Returns whether it may reach the row.
bool add_strip(const WakeWindow& window, const WakeStretch& s, bool is_latest, std::size_t j,
               float strength, std::span<float> foam) {
  const WakeHull& hull = window.hull;
  const float sample_m = static_cast<float>(window.length_m) / kWakeSamples;
  const float inv_speed = 1.0f / hull.speed_mps;
  const float stern_s = 0.42f * hull.length_m * inv_speed;
  const float life_s = 0.8f * static_cast<float>(window.length_m) * inv_speed;
  const float from_s = is_latest ? std::max(s.from_s, stern_s) : s.from_s;
  const float to_s = std::min(s.to_s, life_s);
  if (from_s >= to_s) return false;
  const float ahead_x = s.u_mps * inv_speed, ahead_y = s.v_mps * inv_speed;
  const float widest_m = 1.2f * hull.beam_m;
  const float y = static_cast<float>(j) * sample_m;
  const float y0 = s.y_m - from_s * s.v_mps, y1 = s.y_m - to_s * s.v_mps;
  if (y < std::min(y0, y1) - widest_m || y > std::max(y0, y1) + widest_m) return false;
  const float x0 = s.x_m - from_s * s.u_mps, x1 = s.x_m - to_s * s.u_mps;
  const auto column = [&](float x_m) {
    return static_cast<std::size_t>(std::clamp(x_m / sample_m, 0.0f, kWakeSamples - 1.0f));
  };
  const std::size_t end = column(std::max(x0, x1) + widest_m) + 1;
  for (std::size_t i = column(std::min(x0, x1) - widest_m); i < end; ++i) {
    const float dx = s.x_m - static_cast<float>(i) * sample_m, dy = s.y_m - y;
    const float age_s = std::clamp((dx * ahead_x + dy * ahead_y) * inv_speed, from_s, to_s);
    const float qx = dx - age_s * s.u_mps, qy = dy - age_s * s.v_mps;
    const float behind = std::max(age_s - stern_s, 0.0f) * hull.speed_mps / hull.length_m;
    const float half_m = hull.beam_m * (0.22f + 0.3f * std::sqrt(std::sqrt(behind)));
    const float aside = (qx * qx + qy * qy) / (half_m * half_m);
    if (aside >= 1.0f) continue;
    const float left = 1.0f - age_s / life_s;
    foam[i] = std::max(foam[i], strength * left * left * (1.0f - aside * aside));
  }
  return true;
}

// Steep water breaks: at the bow, and where waves of a wake cross.
constexpr float kLeastSteep = 0.14f, kMostSteep = 0.35f;  // slopes

float breaking(float slope_x, float slope_y, float height_m) {
  const float steep2 = slope_x * slope_x + slope_y * slope_y;
  if (height_m <= 0.0f || steep2 <= kLeastSteep * kLeastSteep) return 0.0f;
  return 0.8f * smoothstep(kLeastSteep, kMostSteep, std::sqrt(steep2));
}

// Returns whether there is any in the row.
bool add_breaking(std::size_t j, const WakeWindow& window, std::span<float> foam) {
  const float* const slope_x = window.slope_x.data() + j * kWindowSide;
  const float* const slope_y = window.slope_y.data() + j * kWindowSide;
  int steep = 0;  // without branches: few rows have any
  for (std::size_t i = 0; i < kWindowSide; ++i) {
    const float steep2 = slope_x[i] * slope_x[i] + slope_y[i] * slope_y[i];
    steep |= static_cast<int>(steep2 > kLeastSteep * kLeastSteep);
  }
  if (steep == 0) return false;
  for (std::size_t i = 0; i < kWindowSide; ++i)
    foam[i] = breaking(slope_x[i], slope_y[i], window.height_m[j * kWindowSide + i]);
  return true;
}

void foam_row(std::size_t j, const WakeWindow& window) {
  const auto row = std::span(window.foam).subspan(j * kWindowSide, kWindowSide);
  std::ranges::fill(row, 0.0f);
  if (window.stretches.empty()) return;
  bool has_foam = add_breaking(j, window, row);
  const float strength = 0.75f * smoothstep(0.08f, 0.35f, froude(window));
  for (std::size_t k = 0; k < window.stretches.size(); ++k)
    has_foam |= add_strip(window, window.stretches[k], k == 0, j, strength, row);
  if (!has_foam) return;
  const float at_row = kRim[j];
  for (std::size_t i = 0; i < kWindowSide; ++i) row[i] *= at_row * kRim[i];
  put_in_lee(window, j, row);
}

// ---- All of windows

void for_all_rows(Windows windows, Workers& workers,
                  FunctionRef<void(std::size_t, const WakeWindow&)> body) {
  constexpr std::size_t kRows = 32;  // a task
  workers.for_each(windows.size() * (kWindowSide / kRows), [&](std::size_t task, int) {
    const WakeWindow& window = windows[task / (kWindowSide / kRows)];
    const std::size_t first = task % (kWindowSide / kRows) * kRows;
    for (std::size_t j = first; j < first + kRows; ++j) body(j, window);
  });
}

void make_heights(const WakeFrame& frame, Windows windows, Workers& workers) {
  for (const WakeWindow& window : windows) size_lee(frame.shore, window);
  workers.for_each(windows.size() * kLeePoints, [&](std::size_t row, int) {
    const WakeWindow& window = windows[row / kLeePoints];
    if (!window.lee.empty()) find_lee(*frame.shore, row % kLeePoints, window);
  });
  transform_windows(WakeField::kHeight, windows, windows, frame.plan, frame.fft_planes, workers);
  for_all_rows(windows, workers, [](std::size_t j, const WakeWindow& w) { fade_row(j, w); });
}

void make_slopes_and_foam(Windows windows, Workers& workers) {
  for_all_rows(windows, workers, [](std::size_t j, const WakeWindow& window) {
    slope_row(j, window);
    foam_row(j, window);
  });
}

// ---- Sampling

// Where a point lies, in samples.
glm::dvec2 place_in_window(const WakeWindow& window, glm::dvec2 p_world) {
  return (p_world - window.corner_m) * (kWakeSamples / window.length_m);
}

bool has_samples_around(glm::dvec2 q) {
  return q.x >= 0.0 && q.y >= 0.0 && q.x < kWakeSamples - 1.0 && q.y < kWakeSamples - 1.0;
}

// Calls visit(point, texel, fractions) where a point lies in the window.
template <class Visit>
void for_points_inside(const WakeWindow& window, std::span<const glm::dvec2> p_world,
                       const Visit& visit) {
  for (std::size_t n = 0; n < p_world.size(); ++n) {
    const glm::dvec2 q = place_in_window(window, p_world[n]);
    if (!has_samples_around(q)) continue;
    const auto i = static_cast<std::size_t>(q.x), j = static_cast<std::size_t>(q.y);
    const glm::vec2 t(q - glm::dvec2(static_cast<double>(i), static_cast<double>(j)));
    visit(n, j * kWindowSide + i, t);
  }
}

// Calls visit(window) for the windows that hold some of the points, once these fields are there.
template <class Visit>
void for_windows_around(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                        WakeFields wanted, const Visit& visit) {
  for (std::size_t w = 0; w < frame.count; ++w) {
    const WakeWindow& window = frame.windows[w];
    if (!std::ranges::any_of(p_world, [&](glm::dvec2 p) { return is_inside(window, p); })) continue;
    need_wake(frame, w, wanted);
    visit(window);
  }
}

float window_value(const std::vector<float>& field, std::size_t at, glm::vec2 t) {
  const float low = field[at] + t.x * (field[at + 1] - field[at]);
  const float high =
      field[at + kWindowSide] + t.x * (field[at + kWindowSide + 1] - field[at + kWindowSide]);
  return low + t.y * (high - low);
}

}  // namespace

void advance_wakes(std::span<const Disturbance> some, std::span<const Disturbance> others,
                   double gravity_mps2, double t_s, WakeFrame& frame, Workers& workers,
                   const terrain::ShoreMap* shore, MakeWakes when) {
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  find_wake_sources(some, others, gravity_mps2, t_s, frame);
  if (frame.count == 0) return;
  if (frame.plan.size == 0) frame.plan = make_fft_plan(kWakeSamples);
  frame.shore = shore;
  for (const WakeWindow& window : frame.shown())
    for (auto* field : {&window.height_m, &window.slope_x, &window.slope_y, &window.foam})
      field->resize(kAll);
  frame.made.begin(when == MakeWakes::kNow ? WakeFields::kAll : WakeFields::kNone);
  if (when == MakeWakes::kWhenAsked) return;
  make_heights(frame, frame.shown(), workers);
  make_slopes_and_foam(frame.shown(), workers);
}

void need_wake(const WakeFrame& frame, std::size_t window, WakeFields wanted) {
  frame.made.need(window, wanted, [&](WakeFields made) {
    // Not by the caller's threads: who waits for one of them could be given a body that asks, too.
    Workers alone(1);
    const Windows one = frame.shown().subspan(window, 1);
    if (made == WakeFields::kNone) make_heights(frame, one, alone);
    if (wanted == WakeFields::kAll) make_slopes_and_foam(one, alone);
  });
}

void advance_wake_velocity(const WakeFrame& wakes, WakeField field, WakeFrame& velocity,
                           Workers& workers) {
  velocity.count = wakes.count;
  if (wakes.count == 0) return;
  if (velocity.windows.size() < wakes.count) velocity.windows.resize(wakes.count);
  for (std::size_t w = 0; w < wakes.count; ++w) {
    need_wake(wakes, w, WakeFields::kHeights);  // its lee
    velocity.windows[w].height_m.resize(kAll);
    velocity.windows[w].corner_m = wakes.windows[w].corner_m;
    velocity.windows[w].length_m = wakes.windows[w].length_m;
    velocity.windows[w].bound_m = HUGE_VALF;
    velocity.windows[w].lee = wakes.windows[w].lee;
  }
  if (velocity.plan.size == 0) velocity.plan = make_fft_plan(kWakeSamples);
  transform_windows(field, wakes.shown(), velocity.shown(), velocity.plan, velocity.fft_planes,
                    workers);
  for_all_rows(velocity.shown(), workers,
               [](std::size_t j, const WakeWindow& w) { fade_row(j, w); });
}

// Between samples heights are bilinear: steepest along the edges of a cell.
WakeBounds bounds_of_wake(const WakeWindow& window, glm::ivec2 low, glm::ivec2 high) {
  float highest_m = 0.0f, step_x_m = 0.0f, step_y_m = 0.0f;
  for (int j = low.y; j <= high.y; ++j)
    for (int i = low.x; i <= high.x; ++i) {
      const float* const z =
          &window.height_m[static_cast<std::size_t>(j) * kWindowSide + static_cast<std::size_t>(i)];
      highest_m = std::max(highest_m, std::abs(z[0]));
      if (i < high.x) step_x_m = std::max(step_x_m, std::abs(z[1] - z[0]));
      if (j < high.y) step_y_m = std::max(step_y_m, std::abs(z[kWindowSide] - z[0]));
    }
  const float per_m = kWakeSamples / static_cast<float>(window.length_m);
  return {.height_m = highest_m,
          .slope = per_m * std::sqrt(step_x_m * step_x_m + step_y_m * step_y_m)};
}

void add_window_heights(const WakeWindow& window, std::span<const glm::dvec2> p_world,
                        std::span<float> height_m) {
  for_points_inside(window, p_world, [&](std::size_t n, std::size_t at, glm::vec2 t) {
    height_m[n] += window_value(window.height_m, at, t);
  });
}

void add_wake_heights(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                      std::span<float> height_m) {
  for_windows_around(frame, p_world, WakeFields::kHeights, [&](const WakeWindow& window) {
    add_window_heights(window, p_world, height_m);
  });
}

void add_wake_slopes(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                     std::span<glm::vec2> slope) {
  for_windows_around(frame, p_world, WakeFields::kAll, [&](const WakeWindow& window) {
    for_points_inside(window, p_world, [&](std::size_t n, std::size_t at, glm::vec2 t) {
      slope[n] +=
          glm::vec2(window_value(window.slope_x, at, t), window_value(window.slope_y, at, t));
    });
  });
}

void add_wake_foam(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                   std::span<float> foam) {
  for_windows_around(frame, p_world, WakeFields::kAll, [&](const WakeWindow& window) {
    for_points_inside(window, p_world, [&](std::size_t n, std::size_t at, glm::vec2 t) {
      foam[n] = std::max(foam[n], window_value(window.foam, at, t));
    });
  });
}

bool is_inside(const WakeWindow& window, glm::dvec2 p_world) {
  return has_samples_around(place_in_window(window, p_world));
}

}  // namespace swell::ocean
