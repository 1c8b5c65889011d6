#include "apps/bench/run_comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "math/check.h"
#include "math/enum_table.h"

namespace swell::apps {
namespace {

constexpr double kResolution_ms = 1e-4;  // the last digit of a report
constexpr double kSmallPart = 0.01;      // of the frame: what a verdict takes at least
constexpr double kConfidence = 0.95;
constexpr const char* kFrame = "frame";

// In JSON.
constexpr auto kVerdictWords = enum_table<Verdict, const char*>({
    {Verdict::kSame, "same"},
    {Verdict::kSlower, "slower"},
    {Verdict::kFaster, "faster"},
    {Verdict::kOnlyBefore, "only_old"},
    {Verdict::kOnlyAfter, "only_new"},
});

const double* find_stage(const RunTimes& run, const std::string& stage) {
  const auto at = std::ranges::find(run.stage_ms, stage, &std::pair<std::string, double>::first);
  return at == run.stage_ms.end() ? nullptr : &at->second;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// The largest k for which the median lies between the k-th value from below and the k-th from above
// with the confidence: of n values, more than n - k lie on one side of it with the probability of
// as many heads of n coins.
std::size_t interval_rank(std::size_t n) {
  double probability = 1.0;  // of exactly i heads
  for (std::size_t i = 0; i < n; ++i) probability *= 0.5;
  double outside = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    outside += 2.0 * probability;
    if (outside > 1.0 - kConfidence) return i;
    probability *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return n / 2;
}

// Compares a stage that both sides have.
StageComparison compare_stage(std::span<const RunPair> pairs, const std::string& stage,
                              double frame_ms) {
  std::vector<double> before, after, ratio;
  for (const RunPair& pair : pairs) {
    const double *b = find_stage(pair.before, stage), *a = find_stage(pair.after, stage);
    SWELL_CHECK(a && b, "stage={} not in all runs", stage);
    before.push_back(std::max(*b, kResolution_ms));
    after.push_back(std::max(*a, kResolution_ms));
    ratio.push_back(after.back() / before.back());
  }
  StageComparison row{stage, median(before), median(after), median(ratio)};
  std::ranges::sort(ratio);
  const std::size_t rank = interval_rank(ratio.size());
  SWELL_CHECK(rank >= 1, "pairs={}", ratio.size());
  row.ratio_low = ratio[rank - 1];
  row.ratio_high = ratio[ratio.size() - rank];
  const double more_ms = row.before_ms * (row.ratio - 1.0);
  if (row.ratio_low > 1.0 && more_ms > kSmallPart * frame_ms) row.verdict = Verdict::kSlower;
  if (row.ratio_high < 1.0 && -more_ms > kSmallPart * frame_ms) row.verdict = Verdict::kFaster;
  return row;
}

std::vector<double> times_of(std::span<const RunPair> pairs, RunTimes RunPair::*side,
                             const std::string& stage) {
  std::vector<double> times;
  for (const RunPair& pair : pairs)
    if (const double* ms = find_stage(pair.*side, stage)) times.push_back(*ms);
  return times;
}

const char* verdict_name(Verdict verdict) {
  using enum Verdict;
  constexpr auto kNames = enum_table<Verdict, const char*>({
      {kSame, "same"},
      {kSlower, "SLOWER"},
      {kFaster, "faster"},
      {kOnlyBefore, "only in the old one"},
      {kOnlyAfter, "only in the new one"},
  });
  return kNames[verdict];
}

bool in_both(const StageComparison& row) {
  return row.verdict != Verdict::kOnlyBefore && row.verdict != Verdict::kOnlyAfter;
}

double number_at(const Json& json, const std::string& name) {
  if (!json.contains(name) || !json[name].is_number())
    throw std::invalid_argument(fmt::format("without a number '{}'", name));
  return json[name].get<double>();
}

}  // namespace

RunTimes read_run_times(const std::string& report) {
  const Json json = Json::parse(report, nullptr, false);
  if (!json.is_object()) throw std::invalid_argument("that is no JSON object");
  for (const char* name : {"stages_ms", "frame_ms"})
    if (!json.contains(name) || !json[name].is_object())
      throw std::invalid_argument(fmt::format("without an object '{}'", name));
  RunTimes times;
  for (const auto& [name, ms] : json["stages_ms"].items())
    times.stage_ms.emplace_back(name, number_at(json["stages_ms"], name));
  times.stage_ms.emplace_back(kFrame, number_at(json["frame_ms"], "median"));
  if (json.contains("hash") && json["hash"].is_string()) times.picture_hash = json["hash"];
  return times;
}

std::vector<StageComparison> compare_runs(std::span<const RunPair> pairs) {
  SWELL_CHECK(std::ssize(pairs) >= kFewestPairs, "pairs={}", pairs.size());
  const RunPair& first = pairs.front();
  const double frame_ms = median(times_of(pairs, &RunPair::before, kFrame));
  std::vector<StageComparison> rows, lone;
  for (const auto& [stage, ms] : first.after.stage_ms) {
    if (find_stage(first.before, stage))
      rows.push_back(compare_stage(pairs, stage, frame_ms));
    else
      lone.push_back({.stage = stage,
                      .after_ms = median(times_of(pairs, &RunPair::after, stage)),
                      .verdict = Verdict::kOnlyAfter});
  }
  for (const auto& [stage, ms] : first.before.stage_ms)
    if (!find_stage(first.after, stage))
      lone.push_back({.stage = stage,
                      .before_ms = median(times_of(pairs, &RunPair::before, stage)),
                      .verdict = Verdict::kOnlyBefore});
  rows.insert(rows.end(), lone.begin(), lone.end());
  return rows;
}

std::string comparison_text(std::span<const StageComparison> rows) {
  std::string text = fmt::format("{:<12} {:>8} {:>8} {:>7}  {:<14} {}\n", "stage, ms", "old", "new",
                                 "ratio", "95 % of it", "verdict");
  for (const StageComparison& row : rows) {
    const auto ms = [&](double value, Verdict missing) {
      return row.verdict == missing ? std::string("-") : fmt::format("{:.3f}", value);
    };
    text += fmt::format(
        "{:<12} {:>8} {:>8} {:>7}  {:<14} {}\n", row.stage, ms(row.before_ms, Verdict::kOnlyAfter),
        ms(row.after_ms, Verdict::kOnlyBefore),
        in_both(row) ? fmt::format("{:.3f}", row.ratio) : "",
        in_both(row) ? fmt::format("{:.3f} to {:.3f}", row.ratio_low, row.ratio_high) : "",
        verdict_name(row.verdict));
  }
  return text;
}

Json comparison_json(std::span<const StageComparison> rows) {
  Json stages = Json::array();
  for (const StageComparison& row : rows) {
    Json stage = {{"stage", row.stage}};
    if (row.verdict != Verdict::kOnlyAfter) stage["old_ms"] = row.before_ms;
    if (row.verdict != Verdict::kOnlyBefore) stage["new_ms"] = row.after_ms;
    if (in_both(row)) {
      stage["ratio"] = row.ratio;
      stage["ratio_95"] = {row.ratio_low, row.ratio_high};
    }
    stage["verdict"] = kVerdictWords[row.verdict];
    stages.push_back(std::move(stage));
  }
  return stages;
}

std::string slower_stages(std::span<const StageComparison> rows) {
  std::string text;
  for (const StageComparison& row : rows)
    if (row.verdict == Verdict::kSlower)
      text += fmt::format("{}{} {:.3g} ({:.3g} to {:.3g})", text.empty() ? "" : ", ", row.stage,
                          row.ratio, row.ratio_low, row.ratio_high);
  return text;
}

}  // namespace swell::apps
