// The frame governor: picks how much of a frame to draw so that frames take no longer than a
// budget. For programs with a clock to keep; a picture that others should get again needs fixed
// options instead.
//
//   Governor governor({.budget_ms = 17.0}, with_scene_defaults({}, world.scene()));
//   for (;;) {
//     const FrameStatistics done =
//         render_frame(world, view, t_s, governor.options(), workspace, target, workers);
//     governor.next(done, presentation_ms);
//   }
//
// What gives, in this order:
//   1. triangles of water and land together, down to 0.4 of full quality;
//   2. size of the planar maps, in two steps: mirrored land gets softer;
//   3. size of the picture, by 3 % a step down to half, enlarged to the full size. On two cores
//      shading is three quarters of a frame at 1280x720, so nothing else can halve a frame; a step
//      costs sharpness everywhere alike. (Fewer layers of ripples far away would leave a line on
//      the sea where they end, and save less.);
//   4. at the smallest picture, triangles again, down to `least_detail`.
// It all comes back in the opposite order. Full quality is what the caller gives, never more.
// Triangulating may take a part of the budget at most: where the camera jumps, triangles follow
// over a few frames, the most important first.
//
// Triangles change by at most 10 % from frame to frame, which no eye sees (a triangle that goes
// covered a few pixels), so they follow two late frames in three. Steps of size are seen: five late
// frames in nine bring the first step that fits once triangles have followed; a step up waits until
// the model has said for 0.6 s that it fits, and twice as long each time that it turned out not
// to. Frames that other work makes late, up to four in a row, cost no size; after more of them it
// is back in two seconds.
//
// The model of a frame's cost: ms a triangle, a row of the planar maps, a picture pixel and what
// is left, each the median over the last frames of what the stages took by what they had to do; so
// what a change will cost is known before it is made, and a single frame that the machine disturbed
// changes nothing. How far most frames stray from the model sets how far below the budget to aim:
// 5 % where they stray little. A picture that is whole stays so while it takes no more than the
// budget, by a median over half a second.
#pragma once

#include <array>
#include <cstddef>

#include "render/frame.h"
#include "render/frame/options.h"

namespace swell::render {

struct GovernorSettings {
  double budget_ms = 17.0;     // over 0
  double least_detail = 0.15;  // share of full quality's triangles, (0, 1]
};

// Decisions, for panels and traces.
struct GovernorReport {
  double detail = 1.0;        // share of full quality's triangles
  int step = 0;               // of the sizes: 0 is full quality
  double aim_ms = 0.0;        // what it steers for, below the budget
  double predicted_ms = 0.0;  // of the next frame
  double whole_ms = 0.0;      // a frame at full quality is expected to take
  int step_changes = 0;       // since the start
};

class Governor {
 public:
  // Full quality: triangles and scales, none of them 0; the other options pass through.
  Governor(const GovernorSettings& settings, const FrameOptions& full_quality);

  // What to draw the next frame with. After the first, with a bound on the time of triangulating (a
  // smaller one of full quality stays).
  const FrameOptions& options() const { return options_; }

  // Takes what the last frame took, drawn with options(); `outside_ms` is what the frame took
  // besides render_frame (presentation). Depends on the numbers it was given alone.
  const FrameOptions& next(const FrameStatistics& last, double outside_ms = 0.0);

  // New limits; what was learnt stays.
  void set_budget_ms(double budget_ms) { settings_.budget_ms = budget_ms; }
  void set_full_quality(const FrameOptions& full_quality);

  const GovernorSettings& settings() const { return settings_; }
  const GovernorReport& report() const { return report_; }

  static constexpr int kSteps = 26;
  static constexpr double kMostChange = 0.1;  // of triangles, from frame to frame

 private:
  // The cost of a frame at full quality [ms]: of its triangles, planar maps, picture pixels, and
  // the rest.
  struct Cost {
    double triangles = 0.0, planar_maps = 0.0, pixels = 0.0, rest = 0.0;
  };
  // The model over few frames, quick to see that frames got slower, and over many, hard to fool.
  struct Model {
    Cost fast, firm, slow;
  };
  static constexpr std::size_t kRemembered = 32, kStraysRemembered = 240;

  void learn(const FrameStatistics& last, double outside_ms);
  Cost median_cost(std::size_t frames) const;
  void choose_aim();
  void choose_step(const Model& model);
  void choose_detail(const Model& model);
  bool fits_whole(const Model& model) const;
  int step_wanted(const Model& model);
  void move_to_step(int step);
  void write_options();
  double least_detail(int step) const;
  int best_step(const Cost& cost, double detail, double ms, double whole_ms) const;

  GovernorSettings settings_;
  FrameOptions full_, options_;
  GovernorReport report_;
  std::array<Cost, kRemembered> costs_{};           // of the last frames, a ring
  std::array<double, kStraysRemembered> strays_{};  // their times over the model's
  std::size_t frames_ = 0;
  double aim_share_;                           // of the budget
  int better_step_ = 0;                        // the one to go up to
  bool going_up_ = false;                      // triangles make room for it
  std::array<int, kSteps> frames_allowing_{};  // each step, in a row; not fewer for a worse one
  int frames_wanting_less_ = 0;
  int patience_frames_, frames_since_raise_ = 0;
  int frames_kept_since_raise_;  // that took no longer than the budget
};

}  // namespace swell::render
