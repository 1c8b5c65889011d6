// Contract checks. SWELL_CHECK guards public entries (the caller's mistake: prints and aborts);
// SWELL_DCHECK guards inner code and is compiled in only with SWELL_DCHECKS.
#pragma once

#include <fmt/core.h>

#include <string>

namespace swell {

// Prints 'check failed: FILE:LINE: EXPRESSION (VALUES)' to stderr and aborts.
[[noreturn]] void check_failed(const char* file, int line, const char* expression,
                               const std::string& values);

}  // namespace swell

// SWELL_CHECK(a <= b, "a={} b={}", a, b)
#define SWELL_CHECK(condition, ...)                                                      \
  do {                                                                                   \
    if (!(condition)) [[unlikely]]                                                       \
      ::swell::check_failed(__FILE__, __LINE__, #condition, ::fmt::format(__VA_ARGS__)); \
  } while (false)

#ifdef SWELL_DCHECKS
#define SWELL_DCHECK(condition, ...) SWELL_CHECK(condition, __VA_ARGS__)
#else  // compiled, so that it cannot rot, but never run
#define SWELL_DCHECK(condition, ...)                \
  do {                                              \
    if (false) SWELL_CHECK(condition, __VA_ARGS__); \
  } while (false)
#endif
