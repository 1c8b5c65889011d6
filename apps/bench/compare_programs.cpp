#include "apps/bench/compare_programs.h"

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>
#include <system_error>

#include "apps/bench/run_comparison.h"
#include "apps/shared/child_process.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/program.h"
#include "apps/shared/report.h"

namespace swell::apps {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";

[[noreturn]] void refuse(const std::string& program, const std::string& what) {
  throw OptionError(fmt::format("command line: --compare: got '{}', {}", program, what));
}

// What a program said at its end, without what run_program() puts before it.
std::string last_words(const std::string& err) {
  constexpr std::string_view kPrefix = "error: ";
  if (err.empty()) return "no message";
  return one_line(err.starts_with(kPrefix) ? err.substr(kPrefix.size()) : err);
}

RunTimes measure_run(const std::string& program, const std::vector<std::string>& frame_arguments) {
  std::vector<std::string> arguments = {"frame", "--json", "-"};
  arguments.insert(arguments.end(), frame_arguments.begin(), frame_arguments.end());
  try {
    const ChildOutcome outcome = run_child(program, arguments);
    if (outcome.exit_code == 0) return read_run_times(outcome.out);
    if (program == kThisProgram)
      throw OptionError(last_words(outcome.err));  // as without --compare
    refuse(program,
           fmt::format("which ended with {}: {}", outcome.exit_code, last_words(outcome.err)));
  } catch (const std::system_error& error) {
    refuse(program, "which cannot be started: " + error.code().message());
  } catch (const std::invalid_argument& error) {
    refuse(program, fmt::format("which printed a report {}", error.what()));
  }
}

// This program first and last, so that a machine that grows slower steadily is no difference.
std::vector<RunPair> measure_pairs(const ProgramComparison& comparison) {
  std::vector<RunPair> pairs(static_cast<std::size_t>(comparison.pairs));
  const auto run = [&](const std::string& program) {
    return measure_run(program, comparison.arguments);
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool this_first = i % 2 == 0;
    if (this_first) pairs[i].after = run(kThisProgram);
    pairs[i].before = run(comparison.old_program);
    if (!this_first) pairs[i].after = run(kThisProgram);
  }
  return pairs;
}

// Empty where one of them has no hash.
std::string picture_verdict(const RunPair& pair) {
  if (pair.before.picture_hash.empty() || pair.after.picture_hash.empty()) return "";
  return pair.before.picture_hash == pair.after.picture_hash ? "same" : "different";
}

}  // namespace

void compare_programs(const ProgramComparison& comparison) {
  const std::vector<RunPair> pairs = measure_pairs(comparison);
  const std::vector<StageComparison> rows = compare_runs(pairs);
  const std::string pictures = picture_verdict(pairs.front());
  if (comparison.json != "-") {
    fmt::print("{} pairs of runs on {}\n{}", pairs.size(), cpu_name(), comparison_text(rows));
    if (!pictures.empty()) fmt::print("pictures of the last frame: {}\n", pictures);
  }
  if (!comparison.json.empty()) {
    Json json = {{"old", comparison.old_program}, {"arguments", comparison.arguments}};
    json["pairs"] = pairs.size();
    json["cpu"] = cpu_name();
    json["stages"] = comparison_json(rows);
    if (!pictures.empty()) json["pictures"] = pictures;
    write_text(comparison.json, json.dump(2) + "\n");
  }
  if (const std::string slower = slower_stages(rows); !slower.empty())
    throw std::runtime_error("slower than " + comparison.old_program + ": " + slower);
}

}  // namespace swell::apps
