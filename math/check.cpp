#include "math/check.h"

#include <cstdio>
#include <cstdlib>

namespace swell {

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  std::fprintf(stderr, "check failed: %s:%d: %s (%s)\n", file, line, expression, values.c_str());
  std::abort();
}

}  // namespace swell
