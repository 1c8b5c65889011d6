// Other programs, run to their end.
#pragma once

#include <string>
#include <vector>

namespace swell::apps {

struct ChildOutcome {
  int exit_code = 0;     // -signal if a signal ended it
  std::string out, err;  // all that it wrote
};

// Runs the program at a path, without a shell, with these arguments and nothing to read, and waits
// for it. Throws std::system_error if it cannot be started: no such file, not executable, no
// program.
ChildOutcome run_child(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace swell::apps
