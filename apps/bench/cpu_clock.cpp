#include "apps/bench/cpu_clock.h"

#include <sched.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

#include "apps/bench/bench.h"

namespace swell::apps {

double measure_clock_ghz() {
  constexpr int kSquarings = 1 << 15;
  constexpr double kCycles = 3.0 * kSquarings;
  // Squares cannot be reordered into a shorter chain; volatile: neither known before nor left out.
  volatile std::uint64_t ends = 3;
  std::uint64_t x = ends;
  const Stopwatch clock;
  for (int i = 0; i < kSquarings; ++i) x *= x;
  ends = x;
  return kCycles / (clock.elapsed_ms() * 1e6);
}

void stay_on_this_cpu() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  if (sched_setaffinity(0, sizeof(one), &one) != 0)
    throw std::system_error(errno, std::generic_category(), "keeping the thread on one CPU");
}

}  // namespace swell::apps
