// How a fuzz target says that what it found is wrong.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace swell::fuzz {

// Ends the process, which libFuzzer and ctest take for a finding.
inline void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "finding: not so: %s\n", what);
  std::abort();
}

}  // namespace swell::fuzz
