// What swell-bench frame found: numbers over frames, as a table for people and JSON for programs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/frame.h"

namespace swell::apps {

// Spread describes a set of samples. Percentiles are by nearest rank, so each is one of them.
struct Spread {
  double median = 0.0, p95 = 0.0, p99 = 0.0, max = 0.0;
};
Spread spread(std::vector<double> samples);  // at least one

// What the frame governor did, over the frames after the first second.
struct GovernedReport {
  double share_within = 0.0;    // of frames within 1.1 x budget, [0, 1]
  double largest_change = 0.0;  // of the drawn triangles, water and terrain, from frame to frame
  int least_triangles = 0, most_triangles = 0;
  double least_lookup_scale = 0.0, most_lookup_scale = 0.0;
  double least_picture_scale = 0.0, most_picture_scale = 0.0;
  int step_changes = 0;  // of the scales, from the first frame on
};

struct FrameReport {
  std::string scene;  // its name
  int width_px = 0, height_px = 0;
  int frames = 0, threads = 0;
  std::string cpu, simd;
  double budget_ms = 0.0;
  double world_ms = 0.0, first_frame_ms = 0.0;  // before there was a picture: made once
  Spread frame_ms;
  int over_budget = 0;  // frames slower than the budget
  std::array<Spread, render::kStages> stage_ms;
  render::FrameStatistics last;  // of the last frame
  std::uint64_t hash = 0;        // of the last frame's picture
  double peak_rss_mb = 0.0;
  std::int64_t involuntary_switches = 0;  // while measuring: how busy the machine was otherwise
  std::optional<GovernedReport> governed;
};

// The whole of the JSON file.
std::string frame_json(const FrameReport& report);

// One row a stage, one for the frame, and the verdict against the budget.
std::string stage_table(const FrameReport& report);

// Writes to standard output for "-", else to a file (whole or not there; texture::FileError).
void write_text(const std::string& path, const std::string& text);

// Throws texture::FileError if write_text could not write there; fine if `path` is empty or "-".
void check_text_place(const std::string& path);

}  // namespace swell::apps
