// swell-bench frame --compare: which stages of a frame took longer in one program's runs than in
// another's, where runs of both alternate on a machine whose speed changes.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/shared/json.h"

namespace swell::apps {

// What one run measured: medians over its frames.
struct RunTimes {
  std::vector<std::pair<std::string, double>> stage_ms;  // by name; the whole frame last, "frame"
  std::string picture_hash;                              // of the last frame, or empty
};

// Reads what swell-bench frame --json writes. Throws std::invalid_argument, which says what is
// missing.
RunTimes read_run_times(const std::string& report);

// Two runs one after the other.
struct RunPair {
  RunTimes before, after;
};

enum class Verdict { kSame, kSlower, kFaster, kOnlyBefore, kOnlyAfter };

struct StageComparison {
  std::string stage;
  double before_ms = 0.0, after_ms = 0.0;  // medians over the runs; 0 where there is no such stage
  // Median of the pairs' after / before, and where the true median lies with 95 % confidence: two
  // order statistics of the pairs' ratios (sign test). Times below a report's last digit count as
  // that.
  double ratio = 1.0, ratio_low = 1.0, ratio_high = 1.0;
  Verdict verdict = Verdict::kSame;
};

// Fewer pairs cannot give 95 % confidence.
inline constexpr int kFewestPairs = 6;

// One row a stage, those that only one side has last. A stage is slower (faster) where all of the
// interval lies above (below) 1, and the median by more than a hundredth of the frame. At least
// kFewestPairs pairs.
std::vector<StageComparison> compare_runs(std::span<const RunPair> pairs);

std::string comparison_text(std::span<const StageComparison> rows);
Json comparison_json(std::span<const StageComparison> rows);

// "shade 1.12 (1.09 to 1.15), frame 1.08 (1.07 to 1.1)"; empty where nothing is slower.
std::string slower_stages(std::span<const StageComparison> rows);

}  // namespace swell::apps
