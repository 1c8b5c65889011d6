// What every program does around its work: the CPU check, exit codes, one-line errors.
#pragma once

#include <stdexcept>
#include <string>

#include "math/parallel.h"

namespace swell::apps {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailure = 1;   // anything but the next one
inline constexpr int kExitBadInput = 2;  // bad options, scene or file

// A bad option; what() is 'command line: what, got what, allowed what'.
class OptionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The body of main: refuses a CPU without AVX2, runs `work`, checks that standard output took
// everything, and returns the exit code. Exceptions become one line 'error: ...' on stderr. File
// size limits and closed pipes are reported as errors as well; they do not kill the process.
int run_program(FunctionRef<void()> work);

// `text` without line breaks and other control characters.
std::string one_line(std::string text);

}  // namespace swell::apps
