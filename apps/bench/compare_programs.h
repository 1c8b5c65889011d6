// swell-bench frame --compare: an older swell-bench against this one.
#pragma once

#include <string>
#include <vector>

namespace swell::apps {

struct ProgramComparison {
  std::string old_program;             // a path
  std::vector<std::string> arguments;  // of `frame`, for both programs
  int pairs = 7;                       // of runs, at least kFewestPairs
  std::string json;                    // where the comparison goes: as --json
};

// Runs both by turns and prints how they compare. Throws OptionError where the old program cannot
// be run or compared with, and std::runtime_error where a stage is slower now.
void compare_programs(const ProgramComparison& comparison);

}  // namespace swell::apps
