// The last few seconds of frame times, for the graph.
#pragma once

#include <array>
#include <cstddef>

namespace swell::view {

inline constexpr double kBudget_ms = 17.0;  // of a frame, from the paper this renderer follows

struct FrameHistory {
  static constexpr std::size_t kLength = 240;
  std::array<float, kLength> frame_ms{};  // a ring; `next` is the oldest once it is full
  std::size_t next = 0, count = 0;
};

void add_frame(FrameHistory& history, double frame_ms);

// The value below which a share p in [0, 1] of the kept frames lie (nearest rank); 0 if empty.
double percentile_ms(const FrameHistory& history, double p);

// The share of the kept frames over a budget; 0 if empty.
double share_over_budget(const FrameHistory& history, double budget_ms = kBudget_ms);

}  // namespace swell::view
