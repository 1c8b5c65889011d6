// swell-bench scaling: what recorded frames say of more threads, as a table and as JSON.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "apps/bench/work_record.h"
#include "apps/shared/json.h"

namespace swell::apps {

inline constexpr std::array kPredictedThreads = {1, 2, 4, 8, 16, 32};

// Medians over the frames.
struct SerialPart {
  std::string stage, name;
  bool beside = false;  // other work runs at the same time: a side of run_both
  double ms = 0.0;      // a frame's
};
struct LoopWork {
  std::string stage, name;
  double items = 0.0;  // of all its runs in a frame
  double ms = 0.0,
         largest_ms = 0.0;  // together; the longest body, below which no thread count gets
};
struct ScalingReport {
  std::array<double, kPredictedThreads.size()> frame_ms{};
  double checked_ms = 0.0;         // with as many threads as were measured
  std::vector<SerialPart> serial;  // longest first
  std::vector<LoopWork> loops;     // in the order of a frame
  double serial_ms() const;        // of those with nothing beside
};

// At least one frame.
ScalingReport predict_scaling(std::span<const std::vector<WorkPart>> frames, int checked_threads);

// What frames took, medians.
struct MeasuredTimes {
  int threads = 1;
  double one_ms = 0.0, threads_ms = 0.0;  // with one thread, with `threads`
};

std::string scaling_text(const ScalingReport& report, const MeasuredTimes& measured);
Json scaling_json(const ScalingReport& report, const MeasuredTimes& measured);

}  // namespace swell::apps
